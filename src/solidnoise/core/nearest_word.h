#pragma once

#include <span>
#include <string_view>

namespace solidnoise {

// The one of `words` that `typed` was probably meant to be: the nearest within two mistakes, one in words of
// up to four letters. A mistake is a letter too many, too few or wrong, or two that are swapped. Empty if
// there is none.
std::string_view nearest_word(std::string_view typed, std::span<const std::string_view> words);

}  // namespace solidnoise
