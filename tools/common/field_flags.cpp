#include "common/field_flags.h"

#include <cmath>

namespace solidnoise {

std::string flag_of(std::string_view field) {
  std::string flag = "--" + std::string(field);
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::string help_of(std::string_view help, std::string_view unit, const Interval& allowed) {
  std::string range(unit);
  if (std::isfinite(allowed.most)) {
    range += fmt::format("{}{:.7g} to {:.7g}", unit.empty() ? "" : "; ", allowed.least, allowed.most);
  }
  return range.empty() ? std::string(help) : fmt::format("{} [{}]", help, range);
}

}  // namespace solidnoise
