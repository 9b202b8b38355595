#pragma once

#include <string>
#include <vector>

#include "common/flag_set.h"

namespace solidnoise {

// Declares --frames and --fps. `example` is a name of an output with a place for the number of a frame.
void declare_frame_flags(FlagSet& flags, const std::string& example, std::vector<int>& frames, double& fps);

// When a frame is, at so many frames per unit of time, in a sequence that repeats after `loop` units of time
// (0: never): frames that a loop apart are the same have the same time. Throws UsageError unless a loop is a
// whole number of frames.
double frame_time(int frame, double fps, double loop);

// What is said of a noise's period in time, of the loop that was given.
std::string name_loop(const FlagSet& flags, const std::string& message);

// Throws UsageError if a file's name has a place for the number of a frame.
void refuse_frame_number(const std::string& flag, const std::string& path);

}  // namespace solidnoise
