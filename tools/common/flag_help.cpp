#include "common/flag_help.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "common/run_tool.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/printable.h"

namespace solidnoise {
namespace {

constexpr std::size_t kTextColumn = 36;  // characters
constexpr std::size_t kWidth = 118;

std::string text_of(const Flag& flag) {
  const std::string standard = flag.standard ? flag.standard() : std::string();
  return flag.help + (standard.empty() ? "" : fmt::format(" (default {})", standard));
}

// Two columns: what is written, and what it does.
std::string row(const std::string& left, const std::string& right) {
  std::string text = "  " + left;
  std::size_t column = text.size();
  if (column + 2 > kTextColumn) {
    text += "  ";
    column += 2;
  }
  std::istringstream words(right);
  for (std::string word; words >> word;) {
    if (column < kTextColumn) {
      text.append(kTextColumn - column, ' ');
      column = kTextColumn;
    } else if (column > kTextColumn && column + 1 + word.size() > kWidth) {
      text += '\n' + std::string(kTextColumn, ' ');
      column = kTextColumn;
    } else if (text.back() != ' ') {
      text += ' ';
      ++column;
    }
    text += word;
    column += word.size();
  }
  return text + '\n';
}

std::string row(const Flag& flag) {
  return row(flag.value_names.empty() ? flag.name : flag.name + ' ' + flag.value_names, text_of(flag));
}

// Flags of one group stand together, in the order of their first ones.
std::string rows_by_group(const std::deque<Flag>& flags) {
  std::vector<std::string> groups;
  for (const Flag& flag : flags) {
    if (std::find(groups.begin(), groups.end(), flag.group) == groups.end()) groups.push_back(flag.group);
  }
  std::string text;
  for (const std::string& group : groups) {
    text += '\n' + (group.empty() ? "Flags" : group) + ":\n";
    for (const Flag& flag : flags) {
      if (flag.group == group) text += row(flag);
    }
  }
  return text;
}

std::string usage(const HelpPage& page, const std::deque<Argument>& arguments) {
  std::string text = "Usage: " + page.command;
  for (const Argument& argument : arguments) {
    text += argument.fewest > 0 ? " " + argument.name : " [" + argument.name + "]";
  }
  text += " [FLAG...]\n";
  for (const Argument& argument : arguments) text += row(argument.name, argument.help);
  return text;
}

std::string found_rows(const std::string& word, const std::deque<Flag>& flags) {
  std::string text;
  for (const Flag& flag : flags) {
    if (lowered(flag.name + ' ' + text_of(flag)).find(lowered(word)) != std::string::npos) text += row(flag);
  }
  return text;
}

}  // namespace

std::string help_text(const HelpPage& page, const std::deque<Argument>& arguments,
                      const std::deque<Flag>& flags) {
  if (page.asked == HelpPage::Asked::word) {
    const std::string text = found_rows(page.word, flags);
    if (!text.empty()) return text;
    throw UsageError(fmt::format("--help is {}; it must be a word that a flag of {} has in its name or text",
                                 printable(page.word), page.command));
  }
  std::string text = page.description + '\n' + usage(page, arguments);
  if (page.asked == HelpPage::Asked::all || page.first.empty()) {
    text += rows_by_group(flags);
  } else {
    text += '\n';
    for (const std::string& name : page.first) {
      for (const Flag& flag : flags) {
        if (flag.name == name) text += row(flag);
      }
    }
    text += fmt::format("\n--help-all lists all {} flags, --help WORD those with a word in name or text.\n",
                        flags.size());
  }
  return page.footer.empty() ? text : text + '\n' + page.footer + '\n';
}

}  // namespace solidnoise
