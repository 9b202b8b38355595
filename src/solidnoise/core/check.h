#pragma once

#include <string_view>

namespace solidnoise {

// Checks of options. Each throws std::invalid_argument with one line: the field, its value, what is allowed.
// `field` is the option's name as the user knows it; `unit` is added in parentheses where it is not empty.
// Not-a-number and infinity are always refused.
void require_finite(std::string_view field, double value);
void require_positive(std::string_view field, double value, std::string_view unit = {});
void require_at_least(std::string_view field, double value, double lowest, std::string_view unit = {});
void require_in_range(std::string_view field, double value, double lowest, double highest,
                      std::string_view unit = {});

}  // namespace solidnoise
