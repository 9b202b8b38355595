#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace solidnoise {

// A flag of a command.
struct Flag {
  enum class Numbers { none, any, whole };

  std::string name;  // "--seed"
  std::string
      value_names;   // what stands for its values: "X Y Z [T]", where T may be left out; empty: a toggle
  std::string help;  // one line, without the default
  std::function<void(const std::vector<std::string>& values)> action{};  // none: whoever declared it asks
  Numbers numbers = Numbers::none;                                       // what its values are
  std::function<std::string()> standard{};                               // its default; none: not to be told
  std::string group{};
  std::vector<std::string_view> words{};            // what may be given, where value_names does not list it
  bool may_vary = false;                            // its numbers may be curves over frames
  std::optional<std::vector<std::string>> given{};  // the values of the command line
};

// An argument without a flag.
struct Argument {
  std::string name;
  std::string help;
  std::size_t fewest = 1;
  std::size_t most = 1;
  std::function<void(const std::string&)> action;  // for each
};

// A command line asks for a text instead of a run: --help, --version.
struct TextRequested {
  std::string text;
};

// What help says beside the flags, and which of them it shows.
struct HelpPage {
  enum class Asked { nothing, first, all, word };

  std::string command;
  std::string description;
  std::string footer;
  std::vector<std::string> first;  // names of the flags of the short page; empty: all
  Asked asked = Asked::nothing;
  std::string word{};  // that is searched for
};

// The page that was asked for. Throws UsageError if no flag has the word.
std::string help_text(const HelpPage& page, const std::deque<Argument>& arguments,
                      const std::deque<Flag>& flags);

}  // namespace solidnoise
