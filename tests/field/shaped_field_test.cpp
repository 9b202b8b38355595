#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/field/shaping.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise::shaped_field_test {
namespace {

// A "noise" whose value is the position's x.
class Ramp final : public Noise<3> {
 public:
  using Noise<3>::evaluate;

  std::unique_ptr<FieldBlock<3>> block(const Box<3>&) const override { return std::make_unique<Block>(); }
  void evaluate(const Points<3>&, const Samples<3>&) const override {}
  double variance() const override { return 1.0; }
  Vec<3> gradient_variance() const override { return {1.0, 0.0, 0.0}; }
  double power_spectrum(const Vec<3>&) const override { return 0.0; }
  double excess_kurtosis() const override { return 0.0; }
  Band band() const override { return {}; }

 private:
  struct Block final : FieldBlock<3> {
    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      std::size_t sample = 0;
      for (int i = 0; i < lattice.count.x; ++i) {
        for (int jk = 0; jk < lattice.count.y * lattice.count.z; ++jk) {
          samples.values[sample++] = static_cast<float>(lattice.coordinate(0, i));
        }
      }
    }
  };
};

const Box<3> kWorld{{-10.0, -10.0, -10.0}, {10.0, 10.0, 10.0}};

float value_at(const Field<3>& field, double x, double y = 0.0, double z = 0.0) {
  Lattice<3> lattice;
  lattice.origin = {x, y, z};
  std::array<float, 1> value{};
  field.block(kWorld)->evaluate(lattice, {value, {}});
  return value[0];
}

TEST(ShapedField, RangesMapThreeSigmasToTheirEnds) {
  const FieldPtr noise = std::make_shared<Ramp>();
  const auto raw = shape(noise, RawShaping{RawShaping::Range::raw});
  const auto both_signs = shape(noise, RawShaping{RawShaping::Range::signed_values});
  const auto unit = shape(noise, RawShaping{RawShaping::Range::unit});
  EXPECT_EQ(value_at(*raw, 7.5), 7.5f);
  EXPECT_EQ(value_at(*both_signs, 1.5), 0.5f);
  EXPECT_EQ(value_at(*both_signs, -3.0), -1.0f);
  EXPECT_EQ(value_at(*both_signs, 9.0), 1.0f);
  EXPECT_EQ(value_at(*unit, 0.0), 0.5f);
  EXPECT_EQ(value_at(*unit, 3.0), 1.0f);
  EXPECT_EQ(value_at(*unit, -9.0), 0.0f);
}

TEST(ShapedField, RemapIsASoftThreshold) {
  const FieldPtr noise = std::make_shared<Ramp>();
  RemapShaping shaping{.threshold = 1.0, .softness = 2.0};
  const auto field = shape(noise, shaping, kWorld);
  EXPECT_EQ(value_at(*field, 1.0), 0.0f);
  EXPECT_EQ(value_at(*field, 2.0), 0.5f);
  EXPECT_EQ(value_at(*field, 3.0), 1.0f);
  EXPECT_NEAR(value_at(*field, 1.5), 0.25 * 0.25 * 2.5, 1e-6);  // smoothstep(1/4) = t^2 (3 - 2 t)
  shaping.power = 3.0;
  EXPECT_NEAR(value_at(*shape(noise, shaping, kWorld), 2.0), 0.125, 1e-6);
  shaping.power = 1.0;
  shaping.floor = 0.2;
  EXPECT_NEAR(value_at(*shape(noise, shaping, kWorld), -5.0), 0.2, 1e-6);
  EXPECT_NEAR(value_at(*shape(noise, shaping, kWorld), 2.0), 0.6, 1e-6);
}

TEST(ShapedField, FoldsAreSymmetric) {
  const FieldPtr noise = std::make_shared<Ramp>();
  const auto ridged =
      shape(noise, RemapShaping{.fold = RemapShaping::Fold::ridged, .threshold = -1.0}, kWorld);
  const auto billow = shape(noise, RemapShaping{.fold = RemapShaping::Fold::billow}, kWorld);
  EXPECT_EQ(value_at(*ridged, 0.0), 1.0f);
  EXPECT_EQ(value_at(*billow, 0.0), 0.0f);
  for (const double x : {0.25, 0.5, 2.0}) {
    EXPECT_EQ(value_at(*ridged, x), value_at(*ridged, -x));
    EXPECT_EQ(value_at(*billow, x), value_at(*billow, -x));
  }
}

// What empty() skips must be 0 everywhere, or clouds would have holes of the size of a block.
TEST(ShapedField, WhatIsCalledEmptyIsZero) {
  const Box<3> box{{-4.0, -2.0, -4.0}, {4.0, 2.0, 4.0}};
  const FieldPtr noise = std::make_shared<Ramp>();
  int empty_blocks = 0;
  for (const auto fold : {RemapShaping::Fold::none, RemapShaping::Fold::ridged, RemapShaping::Fold::billow}) {
    const auto field = shape(noise, RemapShaping{.fold = fold, .threshold = -0.5, .edge = 3.0}, box);
    for (double x = -4.0; x < 4.0; x += 1.0) {
      for (double y = -2.0; y < 2.0; y += 0.5) {
        const Box<3> block{{x, y, 0.0}, {x + 1.0, y + 0.5, 1.0}};
        if (!field->empty(block)) continue;
        ++empty_blocks;
        for (int corner = 0; corner < 8; ++corner) {
          EXPECT_EQ(value_at(*field, corner & 1 ? block.upper.x : block.lower.x,
                             corner & 2 ? block.upper.y : block.lower.y, corner & 4 ? 1.0 : 0.0),
                    0.0f);
        }
      }
    }
  }
  EXPECT_GT(empty_blocks, 0);
}

TEST(ShapedField, VeinsAreLayersThatTheNoiseBends) {
  const FieldPtr noise = std::make_shared<Ramp>();
  constexpr double kFloatError = 1e-5;  // of a cosine in floats, to the fourth power
  const VeinShaping straight{.direction = {0.0, 2.0, 0.0}, .spacing = 0.5, .turbulence = 0.0, .floor = 0.2};
  const auto layers = shape(noise, straight);
  EXPECT_NEAR(value_at(*layers, 3.0, 1.0), 1.0, kFloatError);
  EXPECT_NEAR(value_at(*layers, 3.0, 1.25), 0.2, kFloatError);
  EXPECT_NEAR(value_at(*layers, 3.0, 1.125), 0.2 + 0.8 * 0.0625, kFloatError);  // (1/2)^4
  // The noise is x here: with a turbulence of 1/4 spacing, one unit of x shifts the layers by a quarter.
  VeinShaping bent = straight;
  bent.turbulence = 0.25;
  const auto shifted = shape(noise, bent);
  EXPECT_NEAR(value_at(*shifted, 1.0, 0.375), 1.0, kFloatError);
  EXPECT_FALSE(shifted->empty(kWorld));
}

}  // namespace
}  // namespace solidnoise::shaped_field_test
