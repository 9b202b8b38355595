#pragma once

#include <string>

#include "common/flag_set.h"
#include "common/usage_error.h"
#include "solidnoise/core/choices.h"

namespace solidnoise {

// Declares a flag whose value is one of an enumeration's words and is kept in `target`.
template <typename Enum, std::size_t Count>
void declare_choice(FlagSet& flags, const std::string& flag, const Choices<Enum, Count>& choices,
                    const std::string& help, Enum& target) {
  flags.choice(flag, names_of(choices), help,
               [&target, choices](std::size_t index) { target = choices[index].value; });
}

// Declares a flag whose text, which may not be empty, is kept in `target`.
inline void keep(FlagSet& flags, const std::string& flag, const std::string& value_name,
                 const std::string& help, std::string& target) {
  flags.text(flag, value_name, help, [flag, &target](const std::string& text) {
    if (text.empty()) throw UsageError(flag + " is empty; it must be a name");
    target = text;
  });
}

}  // namespace solidnoise
