#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/flag_help.h"
#include "common/run_tool.h"
#include "solidnoise/core/choices.h"

namespace solidnoise {

// The flags of a command, in groups, and what each does. Parsing and applying are two steps, so that a
// command can load what the flags then override: parse() checks the command line, apply() runs the actions of
// the flags that were given, in the order in which they were declared. Where help was asked for apply()
// gives it instead, with the defaults of what was loaded. For shells, `WORD... --complete PART` lists what
// may stand in the place of PART (flag_completion.h). Read here, not by CLI11: that takes the file of
// `--period 2 2 2 cloud.vdb` for a period, a flag for the value that the one before it lacks and `-:GRID` for
// a flag.
class FlagSet {
 public:
  FlagSet(std::string command, std::string description);
  FlagSet(const FlagSet&) = delete;
  FlagSet& operator=(const FlagSet&) = delete;

  // The heading under which --help-all lists the flags declared from here on.
  void group(const std::string& name) { group_ = name; }
  // Whether numbers of flags declared from here on may be curves over frames.
  void may_vary(bool may) { may_vary_ = may; }
  // The flags that --help shows, the most useful ones; without these, all.
  void show_first(std::vector<std::string> names) { page_.first = std::move(names); }

  Flag& add(Flag flag);
  // A flag without a value.
  Flag& toggle(const std::string& flag, const std::string& help, const std::function<void()>& action);
  // Flags with a value. `value_name` stands for it in help: a unit where there is one.
  Flag& text(const std::string& flag, const std::string& value_name, const std::string& help,
             const std::function<void(const std::string&)>& action);
  Flag& number(const std::string& flag, const std::string& value_name, const std::string& help,
               const std::function<void(double)>& action);
  Flag& integer(const std::string& flag, const std::string& value_name, const std::string& help,
                const std::function<void(int)>& action);
  // A flag with several numbers: as many as `value_names` has words, those in brackets at will.
  Flag& numbers(const std::string& flag, const std::string& value_names, const std::string& help,
                const std::function<void(const std::vector<double>&)>& action);
  // A flag whose value is one of some words.
  Flag& choice(const std::string& flag, const std::vector<std::string_view>& words, const std::string& help,
               const std::function<void(std::size_t index)>& action);
  // A flag whose text, which may not be empty, is kept in `target`.
  Flag& keep(const std::string& flag, const std::string& value_name, const std::string& help,
             std::string& target);

  // An argument without a flag: one that must be there, one that may be missing (`value` then stays), or one
  // or more.
  void argument(const std::string& name, const std::string& help, std::string& value);
  void optional_argument(const std::string& name, const std::string& help, std::string& value);
  void arguments(const std::string& name, const std::string& help, std::vector<std::string>& values);

  // Flags of which at most one may be given.
  void exclude(std::vector<std::string> flags) { exclusions_.push_back(std::move(flags)); }
  // The text after the flags in help, and that of --version.
  void footer(const std::string& text) { page_.footer = text; }
  void version(const std::string& text);

  // Throws UsageError, or TextRequested for --version and --complete.
  void parse(const std::vector<std::string>& arguments);
  // Throws UsageError, TextRequested where help was asked for, and what the actions throw. Curves are taken
  // at a frame.
  void apply(int frame = 0) const;
  // The frames at which the curves that were given have their keys; empty: there are no curves.
  std::vector<int> curve_frames() const;
  // Throws UsageError, the flag, its value and `why`, if one is a curve.
  void refuse_curves(const std::string& why) const;

  bool given(const std::string& flag) const;
  // The value of a flag that takes one, as it was written.
  std::optional<std::string> value_of(const std::string& flag) const;
  // Throws UsageError, the flag and `why`, if one of these was given.
  void refuse(std::initializer_list<std::string_view> flags, const std::string& why) const;
  // A message of the library about one of its fields ("optical_depth is -1; ..."), with the field's name as
  // the flag where it was given as one ("--optical-depth is -1; ...").
  std::string name_flag(const std::string& message) const;
  // Runs what may refuse the value of such a field (std::invalid_argument); it becomes a UsageError.
  template <typename Run>
  auto explained(const Run& run) const {
    try {
      return run();
    } catch (const std::invalid_argument& error) {
      throw UsageError(name_flag(error.what()));
    }
  }

 private:
  const Flag* find(std::string_view name) const;
  Flag* find_given(const std::string& word);
  void take_help_request(std::vector<std::string>& words);
  void read(const std::vector<std::string>& words);
  void take_arguments(const std::vector<std::string>& values);
  void check() const;

  HelpPage page_;
  std::string group_;
  bool may_vary_ = false;
  std::deque<Flag> flags_;
  std::deque<Argument> arguments_;
  std::vector<std::vector<std::string>> exclusions_;
};

}  // namespace solidnoise
