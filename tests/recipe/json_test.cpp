#include "solidnoise/recipe/json.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace solidnoise {
namespace {

std::string message_of(const std::string& text) {
  try {
    parse_json(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Json, KeepsTheOrderOfKeys) {
  EXPECT_EQ(format_json(parse_json(R"({"b": 1, "a": {"d": [1, 2.5], "c": []}})")),
            "{\n  \"b\": 1,\n  \"a\": {\n    \"d\": [1, 2.5],\n    \"c\": []\n  }\n}\n");
}

TEST(Json, SaysWhereATextIsNotJson) {
  EXPECT_NE(message_of("{\"a\": 1,\n \"b\" 2}").find("line 2, column 6"), std::string::npos);
  EXPECT_NE(message_of(""), "accepted");
  EXPECT_NE(message_of("{\"a\": nan}"), "accepted");
  EXPECT_NE(message_of("{\"a\": 1e999}"), "accepted");
  EXPECT_NE(message_of("{} {}"), "accepted");
}

TEST(Json, MessagesAreOfOneLine) {
  for (const char* text : {"{\n\n", "\"\n\"", "{\"a\": \"\xff\"}", "\x01\x02"}) {
    EXPECT_EQ(message_of(text).find('\n'), std::string::npos) << message_of(text);
  }
}

TEST(Json, RefusesAKeyGivenTwice) {
  EXPECT_EQ(message_of(R"({"a": {"b": 1, "b": 2}})"), "the key \"b\" is given twice");
  EXPECT_EQ(message_of(R"({"a": {"b": 1}, "c": {"b": 2}})"), "accepted");
}

TEST(Json, RefusesTreesTooDeepForARecipe) {
  EXPECT_EQ(message_of(std::string(100000, '[')), "nested too deeply to be a recipe");
}

}  // namespace
}  // namespace solidnoise
