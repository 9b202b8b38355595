#include "common/flag_set.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/core/choices.h"
#include "solidnoise/core/printable.h"

namespace solidnoise {
namespace {

using Values = std::vector<std::string>;

// --help in two columns: flags with what their values stand for, and what they do.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_type_name().empty() ? std::string() : " " + option->get_type_name();
  }
  std::string make_usage(const CLI::App* app, std::string) const override {
    std::string usage = "Usage: " + app->get_name();
    for (const CLI::Option* option : app->get_options()) {
      if (!option->get_positional()) continue;
      usage += option->get_required() ? " " + option->get_name() : " [" + option->get_name() + "]";
    }
    return usage + " [FLAG...]\n";
  }
};

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// The parsing library takes "-.5" for a flag, though not "-0.5".
std::string with_leading_digit(const std::string& argument) {
  const bool is_number = argument.size() > 2 && argument.starts_with("-.") &&
                         std::isdigit(static_cast<unsigned char>(argument[2])) != 0;
  return is_number ? "-0" + argument.substr(1) : argument;
}

}  // namespace

struct FlagSet::Parser {
  struct Flag {
    std::string name;
    CLI::Option* option = nullptr;
    std::shared_ptr<Values> values;
    std::function<void(const Values&)> action;
  };

  CLI::App app;
  std::string group;
  std::vector<Flag> flags;
  std::vector<std::vector<std::string>> exclusions;

  Parser(const std::string& command, const std::string& description) : app(description, command) {
    app.formatter(std::make_shared<HelpFormatter>());
    constexpr std::size_t kFlagColumn = 36;  // characters
    app.get_formatter()->column_width(kFlagColumn);
    app.set_help_flag("--help,-h", "Print this and exit")->group("General");
  }

  void add(const std::string& name, const std::string& value_names, std::size_t fewest,
           const std::string& help, std::function<void(const Values&)> action) {
    Flag flag{name, nullptr, std::make_shared<Values>(), std::move(action)};
    const int most = static_cast<int>(words_of(value_names).size());
    flag.option = app.add_option(name, *flag.values, help)
                      ->expected(static_cast<int>(fewest), most)
                      ->type_name(value_names)
                      ->group(group);
    flags.push_back(std::move(flag));
  }

  const Flag* find(const std::string& name) const {
    const auto found =
        std::find_if(flags.begin(), flags.end(), [&](const Flag& f) { return f.name == name; });
    return found == flags.end() ? nullptr : &*found;
  }

  // The flag that a message of the parsing library is about.
  const Flag* find_in(const std::string& message) const {
    const Flag* longest = nullptr;
    for (const Flag& flag : flags) {
      if (message.find(flag.name.substr(2)) == std::string::npos) continue;
      if (!longest || flag.name.size() > longest->name.size()) longest = &flag;
    }
    return longest;
  }

  UsageError unexpected(const std::string& argument) const {
    if (!argument.starts_with("-")) {
      return UsageError(fmt::format("{} is not expected here: it follows no flag", printable(argument)));
    }
    const std::string name = argument.substr(0, argument.find('='));
    std::vector<std::string_view> names;
    for (const Flag& flag : flags) names.push_back(flag.name);
    const std::string_view nearest = nearest_word(name, names);
    const std::string hint = nearest.empty() ? std::string() : fmt::format("; did you mean {}?", nearest);
    return UsageError(fmt::format("{} is not a flag of {}{}", printable(name), app.get_name(), hint));
  }

  UsageError wrong_count(const std::string& message) const {
    const Flag* const flag = find_in(message);
    if (!flag) return UsageError(message);
    const std::string value_names = flag->option->get_type_name();
    const Values given = flag->option->results();
    if (value_names.empty()) return UsageError(flag->name + " is given a value; it takes none");
    if (given.size() <= words_of(value_names).size()) {
      return UsageError(fmt::format("{} lacks a value; it takes {}", flag->name, value_names));
    }
    return UsageError(fmt::format("{} is given {} values ({}); it takes {}", flag->name, given.size(),
                                  printable(fmt::format("{}", fmt::join(given, " "))), value_names));
  }

  // A flag is no value: the one before it lacks its own.
  void refuse_flags_as_values() const {
    for (const Flag& flag : flags) {
      if (!flag.values) continue;
      for (const std::string& value : *flag.values) {
        if (value.starts_with("--")) {
          throw UsageError(
              fmt::format("{} lacks a value; it takes {}", flag.name, flag.option->get_type_name()));
        }
      }
    }
  }

  void refuse_contradictions() const {
    for (const auto& names : exclusions) {
      std::vector<std::string> present;
      for (const std::string& name : names) {
        if (find(name)->option->count() > 0) present.push_back(name);
      }
      if (present.size() > 1) {
        throw UsageError(
            fmt::format("{} contradict each other; give one of them", fmt::join(present, " and ")));
      }
    }
  }
};

FlagSet::FlagSet(std::string command, std::string description)
    : parser_(std::make_unique<Parser>(command, description)) {}

FlagSet::~FlagSet() = default;

void FlagSet::group(const std::string& name) {
  parser_->group = name;
}

void FlagSet::toggle(const std::string& flag, const std::string& help, std::function<void()> action) {
  Parser::Flag toggle{flag, nullptr, nullptr, [action](const Values&) { action(); }};
  toggle.option = parser_->app.add_flag(flag, help)->disable_flag_override()->group(parser_->group);
  toggle.option->type_name("");
  parser_->flags.push_back(std::move(toggle));
}

void FlagSet::text(const std::string& flag, const std::string& value_name, const std::string& help,
                   std::function<void(const std::string&)> action) {
  parser_->add(flag, value_name, 1, help, [action](const Values& values) { action(values[0]); });
}

void FlagSet::number(const std::string& flag, const std::string& value_name, const std::string& help,
                     std::function<void(double)> action) {
  text(flag, value_name, help, [flag, action](const std::string& text) { action(parse_number(flag, text)); });
}

void FlagSet::integer(const std::string& flag, const std::string& value_name, const std::string& help,
                      std::function<void(int)> action) {
  text(flag, value_name, help,
       [flag, action](const std::string& text) { action(parse_integer(flag, text)); });
}

void FlagSet::numbers(const std::string& flag, const std::string& value_names, std::size_t fewest,
                      const std::string& help, std::function<void(const std::vector<double>&)> action) {
  parser_->add(flag, value_names, fewest, help, [flag, action](const Values& values) {
    std::vector<double> numbers;
    for (const std::string& value : values) numbers.push_back(parse_number(flag, value));
    action(numbers);
  });
}

void FlagSet::choice(const std::string& flag, const std::vector<std::string_view>& words,
                     const std::string& help, std::function<void(std::size_t)> action) {
  const auto pick = [flag, words, action](const std::string& text) {
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) {
      throw UsageError(fmt::format("{} is {}; it must be one of {}", flag,
                                   text.empty() ? "empty" : printable(text), fmt::join(words, ", ")));
    }
    action(static_cast<std::size_t>(found - words.begin()));
  };
  text(flag, fmt::format("{}", fmt::join(words, "|")), help, pick);
}

void FlagSet::argument(const std::string& name, const std::string& help, std::string& value) {
  parser_->app.add_option(name, value, help)->required()->type_name("");
}

void FlagSet::arguments(const std::string& name, const std::string& help, std::vector<std::string>& values) {
  parser_->app.add_option(name, values, help)->required()->type_name("");
}

void FlagSet::optional_argument(const std::string& name, const std::string& help, std::string& value) {
  parser_->app.add_option(name, value, help)->type_name("");
}

void FlagSet::exclude(std::vector<std::string> flags) {
  parser_->exclusions.push_back(std::move(flags));
}

void FlagSet::footer(const std::string& text) {
  parser_->app.footer(text);
}

void FlagSet::version(const std::string& text) {
  parser_->app.set_version_flag("--version", text, "Print the version and exit")->group("General");
}

void FlagSet::parse(const std::vector<std::string>& arguments) {
  CLI::App& app = parser_->app;
  std::vector<std::string> reversed;  // as the parsing library wants them
  for (auto i = arguments.rbegin(); i != arguments.rend(); ++i) reversed.push_back(with_leading_digit(*i));
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    throw TextRequested{app.help()};
  } catch (const CLI::CallForVersion& version) {
    throw TextRequested{std::string(version.what()) + '\n'};
  } catch (const CLI::ExtrasError&) {
    throw parser_->unexpected(app.remaining().front());
  } catch (const CLI::ArgumentMismatch& error) {
    throw parser_->wrong_count(error.what());
  } catch (const CLI::ParseError& error) {
    throw parser_->wrong_count(error.what());
  }
  parser_->refuse_flags_as_values();
  parser_->refuse_contradictions();
}

void FlagSet::apply() const {
  for (const Parser::Flag& flag : parser_->flags) {
    if (flag.option->count() > 0) flag.action(flag.values ? *flag.values : Values());
  }
}

bool FlagSet::given(const std::string& flag) const {
  const Parser::Flag* const found = parser_->find(flag);
  return found && found->option->count() > 0;
}

std::string FlagSet::name_flag(const std::string& message) const {
  std::string flag = "--" + message.substr(0, message.find(' '));
  const std::size_t length_of_field = flag.size() - 2;
  for (const char separator : {'_', '.'}) std::replace(flag.begin(), flag.end(), separator, '-');
  return given(flag) ? flag + message.substr(length_of_field) : message;
}

std::optional<std::string> FlagSet::value_of(const std::string& flag) const {
  return given(flag) ? std::optional(parser_->find(flag)->values->front()) : std::nullopt;
}

}  // namespace solidnoise
