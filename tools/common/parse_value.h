#pragma once

#include <cstdint>
#include <string>

namespace solidnoise {

// Values of flags, read strictly: the whole text must be the value. Each throws UsageError, which names the
// flag, the text and what is allowed. Not-a-number, infinity and hexadecimal are refused.
double parse_number(const std::string& flag, const std::string& text);
int parse_integer(const std::string& flag, const std::string& text);
std::uint64_t parse_unsigned(const std::string& flag, const std::string& text);

// Bytes: a number and an optional unit, K, M, G or T (powers of 1024; "GiB" and "GB" are the same here).
std::uint64_t parse_bytes(const std::string& flag, const std::string& text);

}  // namespace solidnoise
