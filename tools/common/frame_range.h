#pragma once

#include <string>
#include <vector>

namespace solidnoise {

// Reads frames such as "1001-1048", "1001-1100x2" (every second one) or "1001" (one). Throws UsageError that
// names the flag, the text and what is allowed: frames from 0, the last not before the first, at most a
// million.
std::vector<int> parse_frames(const std::string& flag, const std::string& text);

// Whether a file's name has a place for a frame's number: a run of #, or %d, %4d or %04d.
bool has_frame_number(const std::string& path);

// The name of a frame's file: `pattern` with the number in its place, padded with zeros to the run's length
// or the given width, and longer where it needs to be (frame 1000 of ### is 1000). Throws UsageError that
// names the flag unless there is one such place, in the file's name and right before its extension.
std::string frame_path(const std::string& flag, const std::string& pattern, int frame);

}  // namespace solidnoise
