#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace solidnoise {

// A text with the letters A to Z as small ones.
std::string lowered(std::string_view text);

// The end of a file's name, from its last dot on, in small letters: ".vdb" of "cloud.VDB". Empty where there
// is none.
std::string extension_of(const std::filesystem::path& path);

}  // namespace solidnoise
