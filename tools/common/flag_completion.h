#pragma once

#include <deque>
#include <string>
#include <vector>

#include "common/flag_help.h"

namespace solidnoise {

// What shells give between the words before the cursor and the part of a word at it.
inline constexpr char kCompletionFlag[] = "--complete";

// What may stand in the place of `part` after `words`, a line each: flags that are not given yet, with two
// spaces and their help, or the words that a flag takes. Nothing: a number, or a file.
std::string completions(const std::vector<std::string>& words, const std::string& part,
                        const std::deque<Argument>& arguments, const std::deque<Flag>& flags);

}  // namespace solidnoise
