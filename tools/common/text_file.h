#pragma once

#include <filesystem>
#include <string>

namespace solidnoise {

// The whole of a file, which may be a few megabytes at most. Throws std::runtime_error naming the path.
std::string read_text_file(const std::filesystem::path& path);

// Writes a file, all or nothing, as write_output does. An existing file is replaced. "-" is the standard
// output. Throws std::runtime_error naming the path.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace solidnoise
