#pragma once

#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/paths.h"

namespace solidnoise {

// A file of golden values (tests/golden/README.md says what is in it).
inline nlohmann::json golden(const std::string& file) {
  std::ifstream stream(in_source("tests/golden/" + file));
  EXPECT_TRUE(stream) << file;
  return nlohmann::json::parse(stream);
}

// Runs check<n>(case) for every case of golden/gabor.json, n its number of dimensions.
template <typename Check>
void for_each_gabor_case(const Check& check) {
  int count = 0;
  const nlohmann::json file = golden("gabor.json");
  for (const nlohmann::json& golden_case : file["cases"]) {
    const int n = golden_case["n"];
    SCOPED_TRACE(testing::Message() << "n = " << n << ", a = " << golden_case["a"]);
    if (n == 1) check.template operator()<1>(golden_case);
    if (n == 2) check.template operator()<2>(golden_case);
    if (n == 3) check.template operator()<3>(golden_case);
    if (n == 4) check.template operator()<4>(golden_case);
    ++count;
  }
  EXPECT_EQ(count, 16);
}

}  // namespace solidnoise
