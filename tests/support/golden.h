#pragma once

#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace solidnoise {

// A file of golden values (tests/golden/README.md says what is in it).
inline nlohmann::json golden(const std::string& file) {
  std::ifstream stream(std::string(SOLIDNOISE_TEST_DATA) + "/golden/" + file);
  EXPECT_TRUE(stream) << file;
  return nlohmann::json::parse(stream);
}

}  // namespace solidnoise
