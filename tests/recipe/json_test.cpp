#include "solidnoise/recipe/json.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace solidnoise::json_test {
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
  EXPECT_EQ(message_of("{\"a\": 1,\n \"b\" 2}"), "line 2, column 6: this is no JSON, after ' \"b\" '");
  EXPECT_EQ(message_of("solid"), "line 1, column 1: this is no JSON");
  EXPECT_EQ(message_of(""), "line 1, column 1: the JSON is not complete");
  EXPECT_EQ(message_of("{\n"), "line 2, column 1: the JSON is not complete");
  EXPECT_NE(message_of("{\"a\": nan}"), "accepted");
  EXPECT_EQ(message_of("{\"a\":\n[0, 1e400\n]}"),
            "line 2: 1e400 is no number that fits; it must be between -1.7976931348623157e+308 and "
            "1.7976931348623157e+308");
  EXPECT_NE(message_of("{} {}"), "accepted");
}

TEST(Json, MessagesAreOfOneLine) {
  for (const char* text : {"{\n\n", "\"\n\"", "{\"a\": \"\xff\"}", "\x01\x02"}) {
    EXPECT_EQ(message_of(text).find('\n'), std::string::npos) << message_of(text);
  }
}

TEST(Json, IgnoresCommentsAndCountsTheirLines) {
  const std::string text = "// {\n{\"a\": /* [\n\" */ [1, // }\n 2], \"b\": 3}";
  EXPECT_EQ(parse_json(text)["a"].size(), 2U);
  EXPECT_EQ(with_line(text, "b is 3"), "line 4: b is 3");
  EXPECT_NE(message_of("{\"a\": 1 /* }"), "accepted");
}

TEST(Json, RefusesAKeyGivenTwice) {
  EXPECT_EQ(message_of("{\"a\": {\"b\": 1,\n\"b\"\n: 2}}"), "line 2: the key \"b\" is given twice");
  EXPECT_EQ(message_of(R"({"a": {"b": 1}, "c": {"b": 2}})"), "accepted");
}

TEST(Json, RefusesTreesTooDeepForARecipe) {
  EXPECT_EQ(message_of(std::string(100000, '[')), "line 1: nested too deeply to be a recipe");
}

TEST(Json, RefusesMoreKeysInOneObjectThanARecipeHas) {
  std::string text = "{\"k\": 0";
  for (int i = 0; i < 100000; ++i) text += ", \"" + std::to_string(i) + "\": 0";
  EXPECT_EQ(message_of(text + "}"), "line 1: too many keys in one object to be a recipe");
}

TEST(Json, RefusesMoreObjectsThanARecipeHas) {
  std::string text = "[{}";
  for (int i = 0; i < 80000; ++i) text += ", {}";
  EXPECT_EQ(message_of(text + "]"), "line 1: too many objects to be a recipe");
}

TEST(Json, AMessageAboutAPathGetsTheLineOfIt) {
  const std::string text =
      "{\n"
      "  \"a\": {\"b\": [1,\n"
      "    {\"c\": \"}] \\\" ,\",\n"
      "     \"d\": -1}]},\n"
      "  \"e\": 2\n"
      "}\n";
  EXPECT_EQ(with_line(text, "e is 2; no"), "line 5: e is 2; no");
  EXPECT_EQ(with_line(text, "a.b is [1]; no"), "line 2: a.b is [1]; no");
  EXPECT_EQ(with_line(text, "a.b[1] is {}; no"), "line 3: a.b[1] is {}; no");
  EXPECT_EQ(with_line(text, "a.b[1].d is -1; no"), "line 4: a.b[1].d is -1; no");
  EXPECT_EQ(with_line(text, "a.b[1].x is missing"), "line 3: a.b[1].x is missing");
  EXPECT_EQ(with_line(text, "a.b[7].d is -1"), "line 2: a.b[7].d is -1");
  EXPECT_EQ(with_line(text, "the whole is wrong"), "the whole is wrong");
  EXPECT_EQ(with_line("{\"a\": [", "a[3].b is wrong"), "line 1: a[3].b is wrong");
}

TEST(Json, MessagesShowLittleOfALongValueAndNoControlCharacters) {
  EXPECT_EQ(shown(std::string("a\nb\x1b")), "\"a\\nb\\u001b\"");
  // 39 letters of two bytes and the quote are 79 bytes; the next letter would end at 81.
  std::string umlauts;
  for (int i = 0; i < 100; ++i) umlauts += "\u00fc";
  EXPECT_EQ(shown(umlauts), std::string(1, '"').append(umlauts, 0, 78).append("..."));
  const std::string value(5000, 'x');
  EXPECT_LT(message_of("{\"a\": " + value + "}").size(), 250u);
  EXPECT_LT(message_of("{\"a\": \"" + value).size(), 250u);
}

TEST(ParseJson, RefusesTextsThatWouldEndOrBreakNames) {
  const std::string message = message_of("{\n\"name\": \"a\\u0000b\"}");
  EXPECT_NE(message.find("line 2"), std::string::npos) << message;
  EXPECT_NE(message.find("\"a\\x00b\" has a control character"), std::string::npos) << message;
  EXPECT_EQ(parse_json("{\"description\": \"two\\nlines\"}").at("description"), "two\nlines");
}

}  // namespace
}  // namespace solidnoise::json_test
