#include "solidnoise/core/memo.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace solidnoise::memo_test {
namespace {

TEST(Memo, MakesWhatIsKnownOnceAndForgetsTheOldest) {
  Memo<int, int, 2> squares;
  int made = 0;
  const auto square = [&](int x) {
    return *squares.get(x, [&] {
      ++made;
      return x * x;
    });
  };
  EXPECT_EQ(square(2), 4);
  EXPECT_EQ(square(3), 9);
  EXPECT_EQ(square(2), 4);
  EXPECT_EQ(made, 2);
  EXPECT_EQ(square(4), 16);  // in the place of 2
  EXPECT_EQ(square(3), 9);
  EXPECT_EQ(made, 3);
  EXPECT_EQ(square(2), 4);
  EXPECT_EQ(made, 4);
}

TEST(Memo, KeepsNothingOfWhatFails) {
  Memo<int, int> memo;
  const auto fail = []() -> int { throw std::invalid_argument("no"); };
  EXPECT_THROW(memo.get(1, fail), std::invalid_argument);
  EXPECT_EQ(*memo.get(1, [] { return 7; }), 7);
}

}  // namespace
}  // namespace solidnoise::memo_test
