#include "common/flag_completion.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace solidnoise {
namespace {

// Those that the flag has, or those of "box|sphere|FILE", which stands for others by what is not in lower
// case.
std::vector<std::string> words_of(const Flag& flag) {
  std::vector<std::string> words(flag.words.begin(), flag.words.end());
  if (!words.empty() || flag.value_names.find('|') == std::string::npos) return words;
  std::istringstream names(flag.value_names);
  for (std::string name; std::getline(names, name, '|');) {
    const bool stands_for_others = std::any_of(name.begin(), name.end(), [](unsigned char letter) {
      return std::isupper(letter) != 0 || letter == ' ' || letter == '[';
    });
    if (!stands_for_others) words.push_back(name);
  }
  return words;
}

}  // namespace

std::string completions(const std::vector<std::string>& words, const std::string& part,
                        const std::deque<Argument>& arguments, const std::deque<Flag>& flags) {
  std::string text;
  const std::string before = words.empty() ? std::string() : words.back();
  const auto flag =
      std::find_if(flags.begin(), flags.end(), [&](const Flag& one) { return one.name == before; });
  if (flag != flags.end() && !flag->value_names.empty()) {
    for (const std::string& word : words_of(*flag)) {
      if (word.starts_with(part)) text += word + '\n';
    }
    return text;
  }

  // A file, where the command takes one and nothing says that a flag is wanted.
  if (part.empty() && !arguments.empty()) return text;
  const auto list = [&](const std::string& name, const std::string& help) {
    if (!name.starts_with(part) || std::find(words.begin(), words.end(), name) != words.end()) return;
    text += name + "  " + help + '\n';
  };
  for (const Flag& one : flags) list(one.name, one.help);
  list("--help", "Print the most useful flags");
  list("--help-all", "Print all flags");
  return text;
}

}  // namespace solidnoise
