#include "solidnoise/image/drawing.h"

#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/image/stroke_font.h"

namespace solidnoise {
namespace {

double ink(const Image& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / 3.0;
}

TEST(Drawing, ARectangleCoversItsArea) {
  Image image(20, 20, 3);
  fill_rectangle(image, {2.25, 3.5, 10.5, 12.0}, Color(1.0f));
  EXPECT_NEAR(ink(image), 8.25 * 8.5, 1e-4);  // float pixels
  EXPECT_EQ(image.at(5, 5, 1), 1.0f);
  EXPECT_NEAR(image.at(2, 3, 2), 0.75f * 0.5f, 1e-6f);
}

TEST(Drawing, ALineCoversItsLengthTimesItsWidth) {
  for (const Point end : {Point{80.0, 20.0}, Point{20.0, 80.0}, Point{70.0, 60.0}}) {
    Image image(100, 100, 3);
    draw_line(image, {20.0, 20.0}, end, {Color(1.0f), 3.0});
    // Round ends add a disc. Coverage from the distance to the middle of a pixel is right to a few percent.
    const double expected = 3.0 * std::hypot(end.x - 20.0, end.y - 20.0) + M_PI * 1.5 * 1.5;
    EXPECT_NEAR(ink(image), expected, 0.03 * expected);
  }
}

TEST(Drawing, OverlappingStrokesOfOneLineCountOnce) {
  Image once(40, 40, 3);
  Image twice(40, 40, 3);
  const std::array<Point, 2> line{{{5.0, 5.0}, {30.0, 21.0}}};
  const std::array<Point, 3> back_and_forth{{line[0], line[1], line[0]}};
  draw_polyline(once, line, {Color(0.8f), 1.0});
  draw_polyline(twice, back_and_forth, {Color(0.8f), 1.0});
  EXPECT_EQ(once.pixels, twice.pixels);
}

TEST(Drawing, WhatFallsOutsideIsLeftOut) {
  Image image(10, 10, 3);
  fill_rectangle(image, {-5.0, -5.0, 30.0, -1.0}, Color(1.0f));
  draw_line(image, {-50.0, 20.0}, {60.0, 30.0}, {Color(1.0f), 2.0});
  draw_disc(image, {-20.0, 5.0}, 3.0, Color(1.0f));
  draw_text(image, "far away", {200.0, -30.0}, {});
  paste(image, Image(4, 4, 3), -10, 3);
  EXPECT_EQ(ink(image), 0.0);

  Image white(8, 8, 3);
  fill_rectangle(white, {0.0, 0.0, 8.0, 8.0}, Color(1.0f));
  paste(image, white, 6, -5);
  EXPECT_EQ(ink(image), 4.0 * 3.0);
}

TEST(Drawing, EveryPrintableCharacterHasAShapeOfItsOwn) {
  std::vector<std::vector<float>> seen;
  for (char character = '!'; character <= '~'; ++character) {
    Image image(32, 40, 3);
    draw_text(image, std::string(1, character), {8.0, 28.0}, {.height = 20.0, .color = Color(1.0f)});
    EXPECT_GT(ink(image), 5.0) << character;
    for (const std::vector<float>& other : seen) EXPECT_NE(image.pixels, other) << character;
    seen.push_back(image.pixels);
  }
  EXPECT_EQ(stroke_glyph('\x01').strokes.size(), 1u);
  EXPECT_TRUE(stroke_glyph(' ').strokes.empty());
}

TEST(Drawing, LettersStayWithinTheirHeightAndWidth) {
  for (char character = '!'; character <= '~'; ++character) {
    const StrokeGlyph glyph = stroke_glyph(character);
    for (const std::vector<Point>& stroke : glyph.strokes) {
      for (const Point& point : stroke) {
        EXPECT_GE(point.x, -1.1) << character;  // the tail of j
        EXPECT_LE(point.x, glyph.width + 0.4) << character;
        EXPECT_GE(point.y, -4.0) << character;
        EXPECT_LE(point.y, 14.0) << character;
      }
    }
  }
}

TEST(Drawing, TextIsAlignedByItsWidth) {
  const std::string text = "Noise 12";
  const double width = text_width(text, 24.0);
  EXPECT_NEAR(text_width(text, 12.0), 0.5 * width, 1e-9);
  EXPECT_EQ(text_width("", 12.0), 0.0);

  Image left(300, 60, 3);
  Image center(300, 60, 3);
  Image right(300, 60, 3);
  draw_text(left, text, {150.0 - width, 40.0}, {24.0, Color(1.0f), TextAlignment::left});
  draw_text(center, text, {150.0 - 0.5 * width, 40.0}, {24.0, Color(1.0f), TextAlignment::center});
  draw_text(right, text, {150.0, 40.0}, {24.0, Color(1.0f), TextAlignment::right});
  for (std::size_t i = 0; i < left.pixels.size(); ++i) {
    EXPECT_NEAR(left.pixels[i], center.pixels[i], 1e-5f);
    EXPECT_NEAR(left.pixels[i], right.pixels[i], 1e-5f);
  }
}

}  // namespace
}  // namespace solidnoise
