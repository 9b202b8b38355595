#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace solidnoise {

// Values of flags, read strictly: the whole text must be the value. Each throws UsageError, which names the
// flag, the text and what is allowed. Not-a-number, infinity and hexadecimal are refused.
[[noreturn]] void refuse_value(const std::string& flag, const std::string& text, std::string_view allowed);
double parse_number(const std::string& flag, const std::string& text);
int parse_integer(const std::string& flag, const std::string& text);
std::uint64_t parse_unsigned(const std::string& flag, const std::string& text);
std::vector<double> parse_numbers(const std::string& flag, const std::vector<std::string>& texts);

// The place of a text among some words.
std::size_t parse_word(const std::string& flag, const std::string& text,
                       const std::vector<std::string_view>& words);

// Bytes: a number and an optional unit, K, M, G or T (powers of 1024; "GiB" and "GB" are the same here).
std::uint64_t parse_bytes(const std::string& flag, const std::string& text);

// Reads frames such as "1001-1048", "1001-1100x2" (every second one) or "1001" (one). Throws UsageError that
// names the flag, the text and what is allowed: frames from 0, the last not before the first, at most a
// million.
std::vector<int> parse_frames(const std::string& flag, const std::string& text);

// Whether a file's name has a place for a frame's number right before its extension: a run of #, or %d, %4d
// or %04d.
bool has_frame_number(const std::string& path);

// The name of a frame's file: `pattern` with the number in its place, padded with zeros to the run's length
// or the given width, and longer where it needs to be (frame 1000 of ### is 1000). Throws UsageError that
// names the flag where there is no such place.
std::string frame_path(const std::string& flag, const std::string& pattern, int frame);

}  // namespace solidnoise
