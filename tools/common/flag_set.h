#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/run_tool.h"
#include "solidnoise/core/choices.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// A command line asks for a text instead of a run: --help, --version.
struct TextRequested {
  std::string text;
};

// The flags of a command, in groups, and what each does. Parsing and applying are two steps, so that a
// command can load what the flags then override: parse() checks the command line, apply() runs the actions of
// the flags that were given, in the order in which they were declared.
class FlagSet {
 public:
  FlagSet(std::string command, std::string description);
  ~FlagSet();
  FlagSet(const FlagSet&) = delete;
  FlagSet& operator=(const FlagSet&) = delete;

  // The heading under which --help lists the flags declared from here on.
  void group(const std::string& name);

  // A flag without a value.
  void toggle(const std::string& flag, const std::string& help, std::function<void()> action);
  // Flags with a value. `value_name` stands for it in --help: a unit where there is one.
  void text(const std::string& flag, const std::string& value_name, const std::string& help,
            std::function<void(const std::string&)> action);
  void number(const std::string& flag, const std::string& value_name, const std::string& help,
              std::function<void(double)> action);
  void integer(const std::string& flag, const std::string& value_name, const std::string& help,
               std::function<void(int)> action);
  // Flags with several numbers: at least `fewest`, as many as `value_names` has words at most.
  void numbers(const std::string& flag, const std::string& value_names, std::size_t fewest,
               const std::string& help, std::function<void(const std::vector<double>&)> action);
  // A flag whose value is one of some words.
  void choice(const std::string& flag, const std::vector<std::string_view>& words, const std::string& help,
              std::function<void(std::size_t index)> action);
  // An argument without a flag, which must be there.
  void argument(const std::string& name, const std::string& help, std::string& value);

  // One or more of them.
  void arguments(const std::string& name, const std::string& help, std::vector<std::string>& values);

  // The same as argument(), but it may be missing: `value` then stays.
  void optional_argument(const std::string& name, const std::string& help, std::string& value);

  // Flags of which at most one may be given.
  void exclude(std::vector<std::string> flags);
  // The text after the flags in --help, and that of --version.
  void footer(const std::string& text);
  void version(const std::string& text);

  // Throws UsageError or TextRequested.
  void parse(const std::vector<std::string>& arguments);
  // Throws UsageError, and what the actions throw.
  void apply() const;

  bool given(const std::string& flag) const;
  // A message of the library about one of its fields ("optical_depth is -1; ..."), with the field's name as
  // the flag where it was given as one ("--optical-depth is -1; ...").
  std::string name_flag(const std::string& message) const;
  // The value of a flag that takes one, as it was written.
  std::optional<std::string> value_of(const std::string& flag) const;

 private:
  struct Parser;  // keeps the parsing library out of every command

  std::unique_ptr<Parser> parser_;
};

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
