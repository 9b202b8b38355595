#include "common/flag_form.h"

#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace solidnoise {

std::string number_names(std::size_t count, std::string_view unit) {
  constexpr std::array kOfSeveral{"", "", "LOW HIGH", "X Y Z", "X Y Z [T]", "", "X0 Y0 Z0 X1 Y1 Z1"};
  if (count > 1) return kOfSeveral[count];
  if (unit.starts_with("world units")) return "UNITS";
  std::string name(unit.substr(0, unit.find(" per ")));
  if (name.empty() || name.find(' ') != std::string::npos) return "NUMBER";
  for (char& letter : name) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return name;
}

std::string format_numbers(std::vector<double> numbers) {
  if (numbers.size() == 4 && numbers.back() == 0.0) numbers.pop_back();
  return fmt::format("{:g}", fmt::join(numbers, " "));
}

}  // namespace solidnoise
