#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/core/output_file.h"

namespace solidnoise {

// An output of a run, and the inputs that it may take the place of, where they are files of its kind.
struct OutputPath {
  OutputPath(std::string output_path, std::vector<std::string> replaceable = {})
      : path(std::move(output_path)), may_replace(std::move(replaceable)) {}

  std::string path;
  std::vector<std::string> may_replace;
};

// Refuses files that could not be written in the end, before any work. "-" always passes; empty paths are
// none. Throws std::runtime_error naming the path, and --force where that would help; UsageError if two of
// them are one file, links followed, or if one is an input.
void require_outputs(const std::vector<OutputPath>& outputs, Existing existing,
                     const std::vector<std::string>& inputs = {});

// Throws UsageError unless a flag's path, if there is one, has one of these extensions; "-", which some
// outputs may be, passes.
enum class StandardOutput { allowed, refused };
void require_extension(const std::string& flag, const std::string& path,
                       std::initializer_list<std::string_view> extensions, StandardOutput standard_output);

// The .usda beside an output, and a refusal of outputs that can have none: UsageError.
std::string usd_path(const std::string& out);
void require_usd(const std::string& out);

// Throws UsageError if an output is "-" and the standard output is a terminal.
void require_no_terminal(const std::string& flag, const std::string& path);

// Writes a text, all or nothing, as write_output does.
void write_text_file(const std::filesystem::path& path, const std::string& text,
                     const OutputOptions& options);

}  // namespace solidnoise
