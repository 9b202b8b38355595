#include "solidnoise/volume/output.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

namespace solidnoise {
namespace {

struct Description {
  std::string_view word;
  std::string_view grid;
  int components;
  int family;  // outputs of one family are made together
};

// In the order of Output.
constexpr std::array<Description, 6> kDescriptions{{
    {"value", "density", 1, 0},
    {"gradient", "gradient", 3, 0},
    {"curl", "vel", 3, 1},
    {"color", "color", 3, 2},
    {"phase", "phase", 1, 3},
    {"intensity", "intensity", 1, 3},
}};

const Description& describe(Output output) {
  return kDescriptions[static_cast<std::size_t>(output)];
}

[[noreturn]] void refuse(std::string_view text) {
  throw std::invalid_argument(fmt::format(
      "output is {}; it must be value, gradient or value,gradient; curl; color; phase, intensity or "
      "phase,intensity",
      text));
}

}  // namespace

std::string_view default_grid_name(Output output) {
  return describe(output).grid;
}

int components_of(Output output) {
  return describe(output).components;
}

std::vector<int> components_of(const std::vector<Output>& outputs) {
  std::vector<int> components;
  for (const Output output : outputs) components.push_back(components_of(output));
  return components;
}

void set_vector_type(openvdb::GridBase& grid, Output output) {
  switch (output) {
    case Output::gradient:
      grid.setVectorType(openvdb::VEC_COVARIANT);
      break;
    case Output::curl:
      grid.setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
      break;
    case Output::color:
      grid.setVectorType(openvdb::VEC_INVARIANT);
      break;
    case Output::value:
    case Output::phase:
    case Output::intensity:
      return;
  }
  grid.setIsInWorldSpace(true);
}

std::vector<Output> parse_outputs(std::string_view text) {
  std::vector<Output> outputs;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    const auto found = std::find_if(kDescriptions.begin(), kDescriptions.end(),
                                    [&](const Description& known) { return known.word == word; });
    if (found == kDescriptions.end()) refuse(text);
    outputs.push_back(static_cast<Output>(found - kDescriptions.begin()));
    begin = end + 1;
  }
  validate_outputs(outputs);
  return outputs;
}

std::string format_outputs(const std::vector<Output>& outputs) {
  std::string text;
  for (const Output output : outputs) {
    if (!text.empty()) text += ',';
    text += describe(output).word;
  }
  return text;
}

void validate_outputs(const std::vector<Output>& outputs) {
  bool usable = outputs.size() == 1 || (outputs.size() == 2 && outputs[0] != outputs[1]);
  for (const Output output : outputs) {
    usable = usable && describe(output).family == describe(outputs.front()).family;
  }
  if (!usable) refuse(format_outputs(outputs));
}

}  // namespace solidnoise
