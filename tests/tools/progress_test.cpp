#include "common/progress.h"

#include <gtest/gtest.h>

namespace solidnoise::progress_test {
namespace {

TEST(Progress, SaysHowLongWorkWillTakeYetOnceThatCanBeTold) {
  EXPECT_EQ(time_left(2.0, 0.5), ", 2 s left");
  EXPECT_EQ(time_left(2.0, 0.45), ", 3 s left") << "rounded up: 2.4 s";
  EXPECT_EQ(time_left(90.0, 0.25), ", 5 min left") << "270 s";
  EXPECT_EQ(time_left(0.9, 0.5), "") << "too soon";
  EXPECT_EQ(time_left(9.0, 0.01), "") << "too little is done";
  EXPECT_EQ(time_left(9.0, 1.0), ", 0 s left");
}

}  // namespace
}  // namespace solidnoise::progress_test
