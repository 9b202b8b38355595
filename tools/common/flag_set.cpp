#include "common/flag_set.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/flag_completion.h"
#include "common/frame_curve.h"
#include "common/parse_value.h"
#include "solidnoise/core/printable.h"

namespace solidnoise {
namespace {

using Values = std::vector<std::string>;

bool is_digit(char letter) {
  return std::isdigit(static_cast<unsigned char>(letter)) != 0;
}

// "-" and "-:GRID" are files, and -1 and -.5 are numbers.
bool is_flag(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word[1] != '.' && word[1] != ':' && !is_digit(word[1]);
}

// What a value that may be left out has to begin like, so that it is not taken for one when it is a file.
bool is_like_number(const std::string& word) {
  const std::size_t first = word.find_first_not_of("+-.");
  return first != std::string::npos && is_digit(word[first]);
}

// How many values the names stand for: at least, at most. Those from the first bracket on may be left out.
std::pair<std::size_t, std::size_t> counts_of(const std::string& value_names) {
  if (value_names.empty()) return {0, 0};
  const auto first_optional =
      value_names.begin() + static_cast<std::ptrdiff_t>(std::min(value_names.find(" ["), value_names.size()));
  const auto fewest = std::count(value_names.begin(), first_optional, ' ') + 1;
  const auto optional = std::count(first_optional, value_names.end(), ' ');
  return {static_cast<std::size_t>(fewest), static_cast<std::size_t>(fewest + optional)};
}

}  // namespace

FlagSet::FlagSet(std::string command, std::string description) {
  page_.command = std::move(command);
  page_.description = std::move(description);
}

Flag& FlagSet::add(Flag flag) {
  flag.group = group_;
  flag.may_vary = may_vary_ && flag.numbers != Flag::Numbers::none;
  return flags_.emplace_back(std::move(flag));
}

Flag& FlagSet::toggle(const std::string& flag, const std::string& help, const std::function<void()>& action) {
  return add({flag, {}, help, [action](const Values&) { action(); }});
}

Flag& FlagSet::text(const std::string& flag, const std::string& value_name, const std::string& help,
                    const std::function<void(const std::string&)>& action) {
  return add({flag, value_name, help, [action](const Values& values) { action(values[0]); }});
}

Flag& FlagSet::number(const std::string& flag, const std::string& value_name, const std::string& help,
                      const std::function<void(double)>& action) {
  return numbers(flag, value_name, help, [action](const std::vector<double>& v) { action(v[0]); });
}

Flag& FlagSet::integer(const std::string& flag, const std::string& value_name, const std::string& help,
                       const std::function<void(int)>& action) {
  const auto read = [flag, action](const Values& values) { action(parse_integer(flag, values[0])); };
  return add({flag, value_name, help, read, Flag::Numbers::whole});
}

Flag& FlagSet::numbers(const std::string& flag, const std::string& value_names, const std::string& help,
                       const std::function<void(const std::vector<double>&)>& action) {
  const auto read = [flag, action](const Values& values) { action(parse_numbers(flag, values)); };
  return add({flag, value_names, help, read, Flag::Numbers::any});
}

Flag& FlagSet::choice(const std::string& flag, const std::vector<std::string_view>& words,
                      const std::string& help, const std::function<void(std::size_t)>& action) {
  return text(flag, fmt::format("{}", fmt::join(words, "|")), help,
              [flag, words, action](const std::string& text) { action(parse_word(flag, text, words)); });
}

Flag& FlagSet::keep(const std::string& flag, const std::string& value_name, const std::string& help,
                    std::string& target) {
  return text(flag, value_name, help, [flag, &target](const std::string& text) {
    if (text.empty()) throw UsageError(flag + " is empty; it must be a name");
    target = text;
  });
}

void FlagSet::argument(const std::string& name, const std::string& help, std::string& value) {
  arguments_.push_back({name, help, 1, 1, [&value](const std::string& text) { value = text; }});
}

void FlagSet::optional_argument(const std::string& name, const std::string& help, std::string& value) {
  argument(name, help, value);
  arguments_.back().fewest = 0;
}

void FlagSet::arguments(const std::string& name, const std::string& help, std::vector<std::string>& values) {
  const auto add = [&values](const std::string& text) { values.push_back(text); };
  arguments_.push_back({name, help, 1, std::string::npos, add});
}

void FlagSet::version(const std::string& text) {
  toggle("--version", "Print the version and exit", [text] { throw TextRequested{text + '\n'}; });
}

void FlagSet::parse(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = arguments;
  if (words.size() > 1 && words[words.size() - 2] == kCompletionFlag) {
    throw TextRequested{completions({words.begin(), words.end() - 2}, words.back(), arguments_, flags_)};
  }
  take_help_request(words);
  if (page_.asked == HelpPage::Asked::nothing) {
    read(words);
    if (given("--version")) find("--version")->action({});
    return check();
  }
  try {
    read(words);  // as far as it goes: a preset has its own defaults
  } catch (const UsageError&) {
  }
}

void FlagSet::take_help_request(std::vector<std::string>& words) {
  using Asked = HelpPage::Asked;
  for (auto word = words.begin(); word != words.end(); ++word) {
    if (*word == "--") return;
    if (*word != "--help" && *word != "-h" && *word != "--help-all") continue;
    page_.asked = *word == "--help-all" ? Asked::all : Asked::first;
    auto end = word + 1;
    if (page_.asked == Asked::first && end != words.end() && !is_flag(*end)) {
      page_.asked = Asked::word;
      page_.word = *end++;
    }
    words.erase(word, end);
    return;
  }
}

const Flag* FlagSet::find(std::string_view name) const {
  const auto found =
      std::find_if(flags_.begin(), flags_.end(), [&](const Flag& flag) { return flag.name == name; });
  return found == flags_.end() ? nullptr : &*found;
}

// The flag that a word of the command line begins with.
Flag* FlagSet::find_given(const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  for (Flag& flag : flags_) {
    if (flag.name != name) continue;
    if (flag.given) throw UsageError(name + " is given twice");
    return &flag;
  }
  std::vector<std::string_view> names;
  for (const Flag& flag : flags_) names.push_back(flag.name);
  const std::string_view nearest = nearest_word(name, names);
  const std::string hint = nearest.empty() ? std::string() : fmt::format("; did you mean {}?", nearest);
  throw UsageError(fmt::format("{} is not a flag of {}{}", printable(name), page_.command, hint));
}

void FlagSet::read(const std::vector<std::string>& words) {
  Values without_flag;
  bool has_flags = true;  // until --
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (has_flags && words[i] == "--") {
      has_flags = false;
      continue;
    }
    if (!has_flags || !is_flag(words[i])) {
      without_flag.push_back(words[i]);
      continue;
    }
    Flag* const flag = find_given(words[i]);
    const auto [fewest, most] = counts_of(flag->value_names);
    Values& values = flag->given.emplace();
    if (const std::size_t equals = words[i].find('='); equals != std::string::npos) {
      if (most == 0) throw UsageError(flag->name + " is given a value; it takes none");
      values.push_back(words[i].substr(equals + 1));
    }
    while (values.size() < most && i + 1 < words.size() && !is_flag(words[i + 1])) {
      if (values.size() >= fewest && !is_like_number(words[i + 1])) break;
      values.push_back(words[++i]);
    }
    if (values.size() < fewest) {
      throw UsageError(fmt::format("{} lacks a value; it takes {}", flag->name, flag->value_names));
    }
  }
  take_arguments(without_flag);
}

void FlagSet::take_arguments(const std::vector<std::string>& values) {
  std::size_t next = 0;
  for (const Argument& argument : arguments_) {
    const std::size_t count = std::min(argument.most, values.size() - next);
    for (std::size_t i = 0; i < count; ++i) argument.action(values[next++]);
    if (count < argument.fewest && page_.asked == HelpPage::Asked::nothing && !given("--version")) {
      throw UsageError(fmt::format("{} is missing: {}", argument.name, argument.help));
    }
  }
  if (next == values.size()) return;
  throw UsageError(fmt::format("{} is not expected here: it follows no flag", printable(values[next])));
}

void FlagSet::check() const {
  for (const std::vector<std::string>& names : exclusions_) {
    std::vector<std::string> present;
    for (const std::string& name : names) {
      if (given(name)) present.push_back(name);
    }
    if (present.size() < 2) continue;
    throw UsageError(fmt::format("{} contradict each other; give one of them", fmt::join(present, " and ")));
  }
}

void FlagSet::apply(int frame) const {
  if (page_.asked != HelpPage::Asked::nothing) throw TextRequested{help_text(page_, arguments_, flags_)};
  for (const Flag& flag : flags_) {
    if (!flag.given || !flag.action) continue;
    Values values = *flag.given;
    for (std::string& value : values) {
      if (!flag.may_vary || !is_curve(value)) continue;
      const FrameCurve curve(flag.name, value);
      value = flag.numbers == Flag::Numbers::whole ? fmt::format("{:.0f}", curve.at(frame))
                                                   : fmt::format("{}", curve.at(frame));
    }
    try {
      flag.action(values);
    } catch (const std::invalid_argument& error) {
      const std::string message = name_flag(error.what());
      throw UsageError(message.find(flag.name) == std::string::npos ? flag.name + ": " + message : message);
    }
  }
}

std::vector<int> FlagSet::curve_frames() const {
  std::vector<int> frames;
  for (const Flag& flag : flags_) {
    if (!flag.given || !flag.may_vary) continue;
    for (const std::string& value : *flag.given) {
      if (!is_curve(value)) continue;
      const std::vector<int> of_curve = FrameCurve(flag.name, value).frames();
      frames.insert(frames.end(), of_curve.begin(), of_curve.end());
    }
  }
  return frames;
}

void FlagSet::refuse_curves(const std::string& why) const {
  for (const Flag& flag : flags_) {
    if (!flag.given || !flag.may_vary) continue;
    const auto curve = std::find_if(flag.given->begin(), flag.given->end(), is_curve);
    if (curve == flag.given->end()) continue;
    throw UsageError(fmt::format("{} is {}, a curve over frames; {}", flag.name, printable(*curve), why));
  }
}

bool FlagSet::given(const std::string& flag) const {
  const Flag* const found = find(flag);
  return found && found->given;
}

std::optional<std::string> FlagSet::value_of(const std::string& flag) const {
  return given(flag) ? std::optional(find(flag)->given->front()) : std::nullopt;
}

void FlagSet::refuse(std::initializer_list<std::string_view> flags, const std::string& why) const {
  for (const std::string_view flag : flags) {
    if (given(std::string(flag))) throw UsageError(fmt::format("{} {}", flag, why));
  }
}

std::string FlagSet::name_flag(const std::string& message) const {
  std::string flag = "--" + message.substr(0, message.find(' '));
  const std::size_t length_of_field = flag.size() - 2;
  for (const char separator : {'_', '.'}) std::replace(flag.begin(), flag.end(), separator, '-');
  return given(flag) ? flag + message.substr(length_of_field) : message;
}

}  // namespace solidnoise
