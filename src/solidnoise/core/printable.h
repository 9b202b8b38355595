#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace solidnoise {

// A text of others as a message may quote it: control characters, those that turn the direction of writing
// too, and what is no UTF-8 as \x1b, and no more than `most` bytes, then "...".
std::string printable(std::string_view text, std::size_t most = 80);

}  // namespace solidnoise
