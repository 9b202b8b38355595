#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace solidnoise {

// The whole of a file, or of what comes through a pipe. Throws std::runtime_error naming the path: what the
// system says, a folder, a device, which may have no end, more than so many bytes.
std::string read_file(const std::filesystem::path& path, std::uint64_t most_bytes);

}  // namespace solidnoise
