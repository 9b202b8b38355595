#include "solidnoise/analysis/four_panel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "analysis/synthetic_fields.h"
#include "solidnoise/analysis/field_picture.h"
#include "solidnoise/analysis/line_plot.h"
#include "support/welch_spectrum.h"

namespace solidnoise::four_panel_test {
namespace {

DenseField<2> wave(const Vec<2>& frequency, const glm::ivec2& count, double step) {
  DenseField<2> field(count, Vec<2>(step));
  const ArrayShape<2> shape{count};
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const Vec<2> x = Vec<2>(shape.position(i)) * step;
    field.values[i] =
        static_cast<float>(std::cos(2.0 * std::numbers::pi * (frequency.x * x.x + frequency.y * x.y)));
  }
  return field;
}

TEST(FieldPicture, ShowsAxis0ToTheRightAndAxis1Up) {
  DenseField<2> field({2, 2}, {1.0, 1.0});
  field.values = {0.0f, 0.25f, 0.5f, 1.0f};  // (0, 0), (0, 1), (1, 0), (1, 1)

  const Image image = field_picture(field, 2, parse_color_ramp("grey"), 0.0, 1.0);

  EXPECT_EQ(image.at(0, 1), 0.0f);
  EXPECT_NEAR(image.at(0, 0), srgb_from_linear(0.25f), 1e-6f);
  EXPECT_NEAR(image.at(1, 1), srgb_from_linear(0.5f), 1e-6f);
  EXPECT_NEAR(image.at(1, 0), 1.0f, 1e-6f);
}

TEST(FieldPicture, AveragesWhenItReduces) {
  DenseField<2> field({64, 64}, {0.1, 0.1});
  for (std::size_t i = 0; i < field.values.size(); ++i) field.values[i] = static_cast<float>(i % 2);
  const Image image = field_picture(field, 8, parse_color_ramp("grey"), 0.0, 1.0);
  for (const float value : image.pixels) EXPECT_NEAR(linear_from_srgb(value), 0.5f, 0.05f);
}

TEST(FieldPicture, ShowsTheMiddleSquareOfALongField) {
  DenseField<2> field({30, 10}, {1.0, 1.0});
  for (int i = 10; i < 20; ++i) {
    for (int j = 0; j < 10; ++j) field.values[static_cast<std::size_t>(i * 10 + j)] = 1.0f;
  }
  const Image image = field_picture(field, 10, parse_color_ramp("grey"), 0.0, 1.0);
  for (const float value : image.pixels) EXPECT_NEAR(value, 1.0f, 1e-6f);
}

TEST(SpectrumMagnitude, OfAWaveIsHighestAtItsFrequencyAndItsNegative) {
  const DenseField<2> field = wave({5.0, -2.5}, {64, 48}, 0.05);
  const DenseField<2> spectrum = spectrum_magnitude(field, SpectrumWindow::hann);

  ASSERT_EQ(spectrum.count, glm::ivec2(65, 49));
  const ArrayShape<2> shape{spectrum.count};
  const glm::ivec2 zero = spectrum.count / 2;
  // 5 and -2.5 cycles per unit over 3.2 and 2.4 units: 16 and -6 frequency steps.
  EXPECT_NEAR(spectrum.values[shape.index(zero + glm::ivec2(16, -6))], 1.0f, 1e-6f);
  EXPECT_NEAR(spectrum.values[shape.index(zero + glm::ivec2(-16, 6))], 1.0f, 1e-6f);
  EXPECT_LT(spectrum.values[shape.index(zero)], 0.01f);
  EXPECT_NEAR(spectrum.step.x, 1.0 / 3.2, 1e-12);
}

TEST(SpectrumMagnitude, PaddingKeepsTheFrequencies) {
  const DenseField<2> field = wave({5.0, 0.0}, {40, 40}, 0.05);
  const DenseField<2> spectrum = spectrum_magnitude(field, SpectrumWindow::hann, 160);
  const auto highest = std::max_element(spectrum.values.begin(), spectrum.values.end());
  const glm::ivec2 at =
      ArrayShape<2>{spectrum.count}.position(static_cast<std::size_t>(highest - spectrum.values.begin()));
  EXPECT_NEAR(std::abs((at.x - spectrum.count.x / 2) * spectrum.step.x), 5.0, 1e-9);
  EXPECT_EQ(at.y, spectrum.count.y / 2);
}

TEST(MiddlePart, KeepsTheMiddleInTheMiddle) {
  for (const int count : {9, 10}) {
    DenseField<2> field({count, count}, {0.5, 0.5});
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        field.values[static_cast<std::size_t>(i * count + j)] = static_cast<float>(2 * i - count + 1);
      }
    }
    const DenseField<2> part = middle_part(field, 2.0);
    EXPECT_EQ(part.count.x % 2, count % 2);
    EXPECT_NEAR(part.count.x * part.step.x, 2.0, 0.5);
    EXPECT_EQ(part.values.front(), -part.values.back());
    EXPECT_EQ(middle_part(field, 100.0).values, field.values);
  }
}

TEST(LinePlot, RoundsLengthsDown) {
  EXPECT_DOUBLE_EQ(round_length(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_length(4.9), 2.0);
  EXPECT_DOUBLE_EQ(round_length(0.07), 0.05);
  EXPECT_DOUBLE_EQ(round_length(999.0), 500.0);
  EXPECT_EQ(short_number(0.05), "0.05");
  EXPECT_EQ(short_number(-0.0), "0");
  EXPECT_EQ(short_number(1e-6), "1e-06");
}

TEST(LinePlot, DrawsAPointWhereTheAxesSay) {
  Image image(200, 200, 3);
  LinePlot plot;
  plot.x.upper = 10.0;
  plot.y.lower = 0.01;
  plot.y.upper = 100.0;
  plot.y.scale = PlotAxis::Scale::logarithmic;
  PlotSeries series;
  series.style = PlotSeries::Style::dots;
  series.color = Color(1.0f, 0.0f, 0.0f);
  series.points = {{2.5, 10.0}, {3.0, -1.0}, {NAN, 1.0}, {20.0, 1.0}};
  plot.series.push_back(series);

  draw_line_plot(image, {50.0, 50.0, 150.0, 150.0}, plot);

  // A quarter to the right, three of four decades up.
  EXPECT_EQ(image.at(75, 74, 0), 1.0f);
  EXPECT_EQ(image.at(75, 74, 1), 0.0f);
}

TEST(FourPanels, FillTheWidthTheyAreGiven) {
  const DenseField<2> noise = white_field<2>({64, 64}, {0.1, 0.1}, 1);
  const DenseField<2> kernel = wave({2.0, 0.0}, {33, 33}, 0.02);
  const DenseField<1> line = white_field<1>(glm::vec<1, int>(512), Vec<1>(0.1), 1);
  const SpectrumPlot spectrum(radial_average(welch_spectrum(line, glm::vec<1, int>(64))));

  const Image plain = draw_four_panels(noise, kernel, {.width = 600});
  const Image with_spectrum = draw_four_panels(noise, kernel, {.title = "Noise", .width = 600}, spectrum);

  EXPECT_EQ(plain.width, 600);
  EXPECT_EQ(plain.channels, 3);
  EXPECT_GT(plain.height, 560);
  EXPECT_GT(with_spectrum.height, plain.height + 180);
  for (const float value : with_spectrum.pixels) {
    ASSERT_GE(value, 0.0f);
    ASSERT_LE(value, 1.0f);
  }
}

TEST(FourPanels, AreDrawnForOddInput) {
  DenseField<2> constant({16, 8}, {1.0, 1.0});
  for (const Image& image : {draw_four_panels(constant, {}, {}), draw_four_panels(constant, constant, {})}) {
    for (const float value : image.pixels) ASSERT_TRUE(value >= 0.0f && value <= 1.0f);
  }
  EXPECT_THROW(draw_four_panels(DenseField<2>({4, 16}, {1.0, 1.0}), {}, {}), std::invalid_argument);
  EXPECT_THROW(draw_four_panels(constant, {}, {.width = 10}), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::four_panel_test
