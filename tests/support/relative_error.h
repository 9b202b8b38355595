#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace solidnoise {

// For EXPECT_TRUE: whether a value is expected, within a relative tolerance.
inline testing::AssertionResult within(double tolerance, double value, double expected) {
  const double difference = std::abs(value - expected);
  if (difference <= tolerance * std::abs(expected)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << value << " is not " << expected << " to a relative " << tolerance;
}

}  // namespace solidnoise
