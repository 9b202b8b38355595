#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace solidnoise {

// 64 bits that tell files apart which differ by accident, as 16 hexadecimal digits: FNV-1a (Fowler, Noll, Vo)
// of the bytes. It is no protection against intent.
std::string digest(std::string_view bytes);

// That of a file's bytes; empty for what is no regular file, such as a pipe, which could not be read again.
// Throws std::runtime_error naming the path if it cannot be read.
std::string file_digest(const std::filesystem::path& path);

}  // namespace solidnoise
