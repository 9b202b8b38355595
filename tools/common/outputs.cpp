#include "common/outputs.h"

#include <algorithm>
#include <ostream>
#include <set>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/run_tool.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/printable.h"

namespace solidnoise {
namespace {

// Of a file that may not be there.
std::filesystem::path file_of_input(const std::string& path) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(path, error);
  return error ? std::filesystem::path() : file;
}

void require_output(const std::string& path, Existing existing) {
  try {
    require_writable(path, existing);
  } catch (const OutputExists&) {
    throw std::runtime_error(path + " exists; --force replaces it");
  }
}

}  // namespace

void require_outputs(const std::vector<OutputPath>& outputs, Existing existing,
                     const std::vector<std::string>& inputs) {
  std::set<std::filesystem::path> files;
  for (const OutputPath& output : outputs) {
    if (output.path.empty()) continue;
    const std::filesystem::path file = output.path == "-" ? "-" : output_target(output.path);
    if (!files.insert(file).second) {
      throw UsageError(fmt::format("{} is the name of two outputs; each needs its own", output.path));
    }
    const auto may_replace = [&](const std::string& input) {
      return extension_of(input) == extension_of(output.path) &&
             std::ranges::find(output.may_replace, input) != output.may_replace.end();
    };
    for (const std::string& input : inputs) {
      if (file != file_of_input(input) || may_replace(input)) continue;
      throw UsageError(fmt::format("{} is an input, which this output would replace", output.path));
    }
    require_output(output.path, existing);
  }
}

std::string usd_path(const std::string& out) {
  return std::filesystem::path(out).replace_extension(".usda").string();
}

void require_usd(const std::string& out) {
  const std::string name = std::filesystem::path(out).filename().string();
  if (printable(name, std::string::npos) != name || name.find("@@@") != std::string::npos) {
    throw UsageError(fmt::format(
        "--usd puts the name of --out into a scene, which cannot hold control characters or @@@: {}",
        printable(name)));
  }
  if (!out.empty() && out != "-" && extension_of(out) != ".usda") return;
  throw UsageError(fmt::format("--usd puts a .usda beside the file of --out, which is {}",
                               out.empty() ? "missing" : printable(out)));
}

void require_extension(const std::string& flag, const std::string& path,
                       std::initializer_list<std::string_view> extensions, StandardOutput standard_output) {
  const bool may_be_standard = standard_output == StandardOutput::allowed;
  const auto ends_path = [&](std::string_view extension) { return extension == extension_of(path); };
  if (path.empty() || (may_be_standard && path == "-")) return;
  if (std::any_of(extensions.begin(), extensions.end(), ends_path)) return;
  throw UsageError(fmt::format("{} is {}; it must end in {}{}", flag, printable(path),
                               fmt::join(extensions, " or "),
                               may_be_standard ? ", or be - for the standard output" : ""));
}

void require_no_terminal(const std::string& flag, const std::string& path) {
  if (path != "-" || isatty(STDOUT_FILENO) == 0) return;
  throw UsageError(flag + " is -, and the standard output is a terminal; send it to a file or a program");
}

void write_text_file(const std::filesystem::path& path, const std::string& text,
                     const OutputOptions& options) {
  write_output(path, options, [&](std::ostream& stream) { stream << text; });
}

}  // namespace solidnoise
