#include <array>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/core/choices.h"

namespace solidnoise::nearest_word_test {
namespace {

TEST(NearestWord, IsWithinTwoMistakesOrOneInShortWords) {
  const std::array<std::string_view, 4> words{"frequency", "grid", "gain", "box"};
  EXPECT_EQ(nearest_word("frequncy", words), "frequency");    // too few
  EXPECT_EQ(nearest_word("freequency", words), "frequency");  // too many
  EXPECT_EQ(nearest_word("frequenzi", words), "frequency");   // two wrong
  EXPECT_EQ(nearest_word("gird", words), "grid");             // swapped
  EXPECT_EQ(nearest_word("gian", words), "gain");
  EXPECT_EQ(nearest_word("b", words), "");
  EXPECT_EQ(nearest_word("frequ", words), "");
  EXPECT_EQ(nearest_word("", words), "");
  EXPECT_EQ(nearest_word(std::string(100000, 'x'), words), "");
}

}  // namespace
}  // namespace solidnoise::nearest_word_test
