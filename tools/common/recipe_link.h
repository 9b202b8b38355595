#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace solidnoise {

// The text of the recipe in a link of Solidnoise Studio, "http://.../#recipe=CODE&...", the first one if
// there are several; CODE is the text in base64 for addresses (RFC 4648, section 5), without padding. Nothing
// for what is no link. Throws std::runtime_error for a link without a recipe, or one that was cut.
std::optional<std::string> recipe_in_link(std::string_view link);

}  // namespace solidnoise
