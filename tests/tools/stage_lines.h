#pragma once

#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace solidnoise {

// The names in what --timings prints, whose seconds, rounded to thousandths, are expected to add up to those
// of the last line, "all".
inline std::vector<std::string> stage_names(const std::string& printed) {
  static const std::regex line(R"((\w+) +(\d+\.\d{3}) s +(\d+\.\d{3}) s of processor +(\d+) %\n)");
  std::vector<std::string> names;
  double wall = 0.0;
  double processor = 0.0;
  std::string rest = printed;
  for (std::smatch match; std::regex_search(rest, match, line, std::regex_constants::match_continuous);
       rest = match.suffix()) {
    names.push_back(match[1]);
    const double tolerance = 0.0005 * static_cast<double>(names.size()) + 1e-9;
    if (names.back() == "all") {
      EXPECT_NEAR(std::stod(match[2]), wall, tolerance) << printed;
      EXPECT_NEAR(std::stod(match[3]), processor, tolerance) << printed;
      EXPECT_EQ(match[4], "100") << printed;
    }
    wall += std::stod(match[2]);
    processor += std::stod(match[3]);
  }
  EXPECT_EQ(rest, "") << printed;
  return names;
}

}  // namespace solidnoise
