#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/image/color.h"

namespace solidnoise::color_ramp_test {
namespace {

// Single precision, and powers: some 10 roundings of 2^-24 relative.
constexpr float kTolerance = 1e-6f;

std::string complaint_about(std::string_view text) {
  try {
    parse_color_ramp(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Color, TransferFunctionsAreInverse) {
  for (int i = -20; i <= 300; ++i) {
    const float value = static_cast<float>(i) / 200.0f;
    EXPECT_NEAR(linear_from_srgb(srgb_from_linear(value)), value, 2 * kTolerance) << value;
  }
}

TEST(Color, TransferFunctionHasTheStandardsValues) {
  EXPECT_EQ(srgb_from_linear(0.0f), 0.0f);
  EXPECT_NEAR(srgb_from_linear(1.0f), 1.0f, kTolerance);
  EXPECT_NEAR(srgb_from_linear(0.001f), 0.01292f, kTolerance);
  // The formula of IEC 61966-2-1 at 0.5: ((0.5 + 0.055) / 1.055)^2.4.
  EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404114f, kTolerance);
}

TEST(ColorRamp, BlendsInLinearLight) {
  const ColorRamp ramp = parse_color_ramp("0:#000,1:#fff");

  EXPECT_NEAR(ramp.linear(0.25f).x, 0.25f, kTolerance);
  EXPECT_NEAR(ramp.srgb(0.21404114f).y, 0.5f, kTolerance);
}

TEST(ColorRamp, HitsItsStopsAndIsConstantBeyond) {
  const ColorRamp ramp = parse_color_ramp("-1:#ff8000,0.5:#123456,3:#00f");

  EXPECT_NEAR(ramp.srgb(0.5f).x, 0x12 / 255.0f, kTolerance);
  EXPECT_NEAR(ramp.srgb(0.5f).y, 0x34 / 255.0f, kTolerance);
  EXPECT_NEAR(ramp.srgb(0.5f).z, 0x56 / 255.0f, kTolerance);
  EXPECT_NEAR(ramp.srgb(-7.0f).y, 0x80 / 255.0f, kTolerance);
  EXPECT_NEAR(ramp.srgb(9.0f).z, 1.0f, kTolerance);
  EXPECT_NEAR(ramp.srgb(std::numeric_limits<float>::quiet_NaN()).x, 1.0f, kTolerance);
}

TEST(ColorRamp, TwoStopsAtOnePositionMakeAnEdge) {
  const ColorRamp ramp = parse_color_ramp("0:#000,0.5:#000,0.5:#fff,1:#fff");

  EXPECT_EQ(ramp.linear(std::nextafter(0.5f, 0.0f)).x, 0.0f);
  EXPECT_NEAR(ramp.linear(0.5f).x, 1.0f, kTolerance);
}

TEST(ColorRamp, EveryNamedRampCoversTheUnitInterval) {
  ASSERT_EQ(ramp_names().size(), 5u);
  for (const std::string_view name : ramp_names()) {
    const ColorRamp ramp = parse_color_ramp(name);
    EXPECT_EQ(ramp.stops().front().position, 0.0f) << name;
    EXPECT_EQ(ramp.stops().back().position, 1.0f) << name;
  }
}

TEST(ColorRamp, KnowsTheSpellingOfOldRecipes) {
  EXPECT_EQ(parse_color_ramp("gray").srgb(0.3f), parse_color_ramp("grey").srgb(0.3f));
}

TEST(ColorRamp, ViridisBecomesLighterAllTheWay) {
  const ColorRamp ramp = parse_color_ramp("viridis");
  float last = -1.0f;
  for (int i = 0; i <= 100; ++i) {
    const Color color = ramp.linear(static_cast<float>(i) / 100.0f);
    const float luminance = 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z;
    EXPECT_GT(luminance, last) << i;
    last = luminance;
  }
}

TEST(ColorRamp, RefusesBadTextAndQuotesIt) {
  EXPECT_EQ(complaint_about("virids"),
            "ramp is \"virids\"; it must be one of viridis, grey, marble, rust, scales, or stops as in "
            "0:#000,1:#fff");
  EXPECT_EQ(complaint_about("0:#000,1:#ggg"),
            "ramp stop \"1:#ggg\": colour \"#ggg\" must be #RGB or #RRGGBB");
  EXPECT_EQ(complaint_about("0:#000,1:#ffff"),
            "ramp stop \"1:#ffff\": colour \"#ffff\" must be #RGB or #RRGGBB");
  EXPECT_EQ(complaint_about("0:#000,1x:#fff"),
            "ramp stop \"1x:#fff\": position \"1x\" must be a finite number");
  EXPECT_EQ(complaint_about("0:#000,nan:#fff"),
            "ramp stop \"nan:#fff\": position \"nan\" must be a finite number");
  EXPECT_EQ(complaint_about("0:#000,1"), "ramp stop \"1\" must be POSITION:#RRGGBB, as in 0.5:#ff8000");
  EXPECT_EQ(complaint_about("0:#000,"), "ramp stop \"\" must be POSITION:#RRGGBB, as in 0.5:#ff8000");
  EXPECT_EQ(complaint_about("0:#000"), "ramp has 1 stop(s); it must have at least 2");
  EXPECT_EQ(complaint_about("1:#000,0:#fff"), "ramp position 0 comes after 1; positions must not decrease");
}

}  // namespace
}  // namespace solidnoise::color_ramp_test
