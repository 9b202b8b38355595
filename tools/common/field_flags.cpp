#include "common/field_flags.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace solidnoise {

std::string flag_of(std::string_view field) {
  std::string flag = "--" + std::string(field);
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::string number_name(std::string_view unit) {
  if (unit.starts_with("world units")) return "UNITS";
  std::string name(unit.substr(0, unit.find(" per ")));
  if (name.empty() || name.find(' ') != std::string::npos) return "NUMBER";
  for (char& letter : name) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return name;
}

std::string help_of(std::string_view help, std::string_view unit, const Interval& allowed,
                    const std::string& default_value) {
  std::string range(unit);
  if (std::isfinite(allowed.most)) {
    range += fmt::format("{}{:g} to {:g}", unit.empty() ? "" : "; ", allowed.least, allowed.most);
  }
  std::string text(help);
  if (!range.empty()) text += fmt::format(" [{}]", range);
  if (!default_value.empty()) text += fmt::format(" (default {})", default_value);
  return text;
}

std::string format_numbers(std::vector<double> numbers) {
  while (numbers.size() > 3 && numbers.back() == 0.0) numbers.pop_back();
  return fmt::format("{:g}", fmt::join(numbers, " "));
}

}  // namespace solidnoise
