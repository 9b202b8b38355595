#include <algorithm>
#include <functional>
#include <optional>
#include <pybind11/stl.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "arrays.h"
#include "documentation.h"
#include "exemplar.h"
#include "solidnoise/analysis/exemplar/edit_model.h"

namespace solidnoise::python {
namespace {

// Which components an edit works on, as its keywords say.
struct Choice {
  std::optional<std::string> group;
  std::optional<int> channel;
};

// The model with an edit of the chosen components.
ExemplarModel edited(ExemplarModel model, const Choice& choice, bool makes_group,
                     const std::function<void(GaborSpectrum&, std::size_t)>& edit) {
  if (!edit_model(model, {choice.group, choice.channel, makes_group}, edit)) {
    throw std::invalid_argument(
        fmt::format("group is {}; it must be one of {}", *choice.group, fmt::join(groups_of(model), ", ")));
  }
  return model;
}

// An edit by a number.
void add_edit(ModelClass& of, const char* name, const char* argument, const char* help,
              void (*edit)(GaborSpectrum&, const GroupChoice&, double)) {
  using namespace py::literals;
  of.def(
      name,
      [edit](const ExemplarModel& model, double number, std::optional<std::string> group,
             std::optional<int> channel) {
        return edited(model, {group, channel}, false,
                      [&](GaborSpectrum& spectrum, std::size_t) { edit(spectrum, group, number); });
      },
      py::arg(argument), py::kw_only(), "group"_a = py::none(), "channel"_a = py::none(),
      document(fmt::format("{}(self, {}, *, group=None, channel=None)", name, argument), help).c_str());
}

}  // namespace

void add_edits(ModelClass& of) {
  using namespace py::literals;
  add_edit(
      of, "rotate", "degrees",
      "A model whose frequencies are turned counterclockwise, in 3D about the z axis.",
      [](GaborSpectrum& s, const GroupChoice& group, double degrees) { rotate_group(s, group, degrees); });
  add_edit(of, "scale", "factor", "A model whose frequencies are multiplied; bandwidths stay.", scale_group);
  add_edit(of, "magnitude", "factor", "A model whose amplitudes are multiplied.", scale_magnitude);
  add_edit(of, "bandwidth", "factor", "A model whose bandwidths are multiplied; variances stay.",
           scale_bandwidth);
  of.def(
      "translate",
      [](const ExemplarModel& model, py::object by, std::optional<std::string> group,
         std::optional<int> channel) {
        std::vector<double> numbers = numbers_of(by, "by");
        if (numbers.size() != 2 && numbers.size() != 3)
          throw std::invalid_argument("by must be 2 or 3 numbers");
        numbers.resize(3);
        return edited(model, {group, channel}, false, [&](GaborSpectrum& spectrum, std::size_t) {
          translate_group(spectrum, group, {numbers[0], numbers[1], numbers[2]});
        });
      },
      "by"_a, py::kw_only(), "group"_a = py::none(), "channel"_a = py::none(),
      "translate(self, by, *, group=None, channel=None)\n--\n\nA model to whose frequencies a vector is "
      "added, cycles per world unit.");
  of.def(
      "select",
      [](const ExemplarModel& model, double lower, double upper, double direction, double spread,
         const std::string& name, std::optional<std::string> group, std::optional<int> channel) {
        const ComponentSelection selection{lower, upper, direction, spread};
        int count = 0;
        const auto result = edited(model, {group, channel}, false, [&](GaborSpectrum& spectrum, std::size_t) {
          count += select_group(spectrum, group, selection, name);
        });
        if (count == 0) throw std::invalid_argument("there are no such components");
        return result;
      },
      "lower"_a, "upper"_a, py::kw_only(), "direction"_a = 0.0, "spread"_a = 180.0, "name"_a = "selected",
      "group"_a = py::none(), "channel"_a = py::none(),
      "select(self, lower, upper, *, direction=0.0, spread=180.0, name='selected', group=None, "
      "channel=None)\n--\n\nA model in which the components of frequencies from lower on and below upper, "
      "cycles per world unit, are a group of that name:\nthose of directions within spread of direction, "
      "degrees counterclockwise from the first axis.");
  of.def(
      "remove",
      [](const ExemplarModel& model, const std::string& group, std::optional<int> channel) {
        return edited(model, {group, channel}, false,
                      [&](GaborSpectrum& spectrum, std::size_t) { remove_group(spectrum, group); });
      },
      "group"_a, py::kw_only(), "channel"_a = py::none(),
      "remove(self, group, *, channel=None)\n--\n\nA model without the components of a group.");
  of.def(
      "rename",
      [](const ExemplarModel& model, const std::string& group, const std::string& name,
         std::optional<int> channel) {
        return edited(model, {group, channel}, false,
                      [&](GaborSpectrum& spectrum, std::size_t) { rename_group(spectrum, group, name); });
      },
      "group"_a, "name"_a, py::kw_only(), "channel"_a = py::none(),
      "rename(self, group, name, *, channel=None)\n--\n\nA model in which a group has another name, or has "
      "joined the group of that name.");
  of.def(
      "add",
      [](const ExemplarModel& model, double a, double variance, py::object frequency,
         const std::string& group, std::optional<int> channel) {
        SpectrumComponent component;
        component.variance = variance;
        const std::vector<double> numbers = numbers_of(frequency, "frequency");
        if (numbers.size() != 2 && numbers.size() != 3)
          throw std::invalid_argument("frequency must be 2 or 3 numbers");
        for (std::size_t i = 0; i < numbers.size(); ++i)
          component.frequency[static_cast<int>(i)] = numbers[i];
        return edited(model, {group, channel}, true, [&](GaborSpectrum& spectrum, std::size_t) {
          add_component(spectrum, a, component, group);
        });
      },
      "a"_a, "variance"_a, "frequency"_a, py::kw_only(), "group"_a = "added", "channel"_a = py::none(),
      "add(self, a, variance, frequency, *, group='added', channel=None)\n--\n\nA model with one more "
      "component: bandwidth a, variance, and "
      "frequency, 2 or 3 numbers, cycles per world unit.");
  of.def(
      "copy_from",
      [](const ExemplarModel& model, const ExemplarModel& other, std::optional<std::string> group,
         std::optional<int> channel) {
        const auto has_it = [&](const GaborSpectrum& spectrum) { return has_group(spectrum, *group); };
        if (group && std::none_of(other.channels.begin(), other.channels.end(), has_it)) {
          throw std::invalid_argument(fmt::format("group is {}; of the other model it must be one of {}",
                                                  *group, fmt::join(groups_of(other), ", ")));
        }
        return edited(model, {group, channel}, true, [&](GaborSpectrum& spectrum, std::size_t k) {
          if (k >= other.channels.size() || (group && !has_group(other.channels[k], *group))) return;
          copy_group(spectrum, other.channels[k], group);
        });
      },
      "other"_a, py::kw_only(), "group"_a = py::none(), "channel"_a = py::none(),
      "copy_from(self, other, *, group=None, channel=None)\n--\n\nA model with the components of another "
      "one, too, of a group or all, "
      "channel by channel.");
  of.def(
      "regroup",
      [](const ExemplarModel& model, std::optional<int> channel) {
        return edited(model, {std::nullopt, channel}, true,
                      [](GaborSpectrum& spectrum, std::size_t) { spectrum = group_spectrum(spectrum); });
      },
      py::kw_only(), "channel"_a = py::none(),
      "regroup(self, *, channel=None)\n--\n\nA model whose components are sorted into groups anew, after "
      "Wold.");
}

}  // namespace solidnoise::python
