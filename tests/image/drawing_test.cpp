#include "solidnoise/image/drawing.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace solidnoise::drawing_test {
namespace {

double ink(const Image& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / 3.0;
}

// The first and the one after the last column that has something drawn in it.
struct Columns {
  int first = 0;
  int end = 0;
};

Columns inked_columns(const Image& image) {
  Columns columns{image.width, 0};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) == 0.0f) continue;
      columns = {std::min(columns.first, x), std::max(columns.end, x + 1)};
    }
  }
  return columns;
}

TEST(Drawing, ARectangleCoversThePixelsThatItsCornersAreIn) {
  Image image(20, 20, 3);
  fill_rectangle(image, {2.25, 3.5, 10.5, 12.0}, Color(0.5f, 1.0f, 0.0f));
  EXPECT_EQ(ink(image), 8.0 * 9.0 * 1.5 / 3.0);
  EXPECT_EQ(image.at(2, 3, 0), 0.5f);
  EXPECT_EQ(image.at(9, 11, 1), 1.0f);
  EXPECT_EQ(image.at(10, 11, 1), 0.0f);
}

TEST(Drawing, AFrameIsWithinItsRectangle) {
  Image image(20, 20, 3);
  draw_frame(image, {2.0, 3.0, 12.0, 9.0}, Color(1.0f));
  EXPECT_EQ(ink(image), 2.0 * 10.0 + 2.0 * 4.0);
  EXPECT_EQ(image.at(11, 8), 1.0f);
}

TEST(Drawing, ALineIsAsWideAsItsPen) {
  for (const int width : {1, 2, 3}) {
    Image image(100, 100, 3);
    draw_line(image, {20.0, 20.0}, {79.5, 20.5}, {Color(1.0f), width});
    EXPECT_EQ(ink(image), width * (59.0 + width));
  }
}

TEST(Drawing, WhatFallsOutsideIsLeftOut) {
  const Rectangle all{-5.0, -5.0, 30.0, 30.0};
  Image image(10, 10, 3);
  fill_rectangle(image, {-5.0, -5.0, 30.0, -1.0}, Color(1.0f));
  draw_line(image, {-50.0, 20.0}, {60.0, 30.0}, {Color(1.0f), 2});
  draw_frame(image, all, Color(1.0f));
  paste(image, Image(4, 4, 3), -10, 3);
  for (const Point at : {Point{200.0, 5.0}, Point{-200.0, 5.0}, Point{2.0, -30.0}, Point{2.0, 60.0}}) {
    draw_text(image, "far away", at, {.outline = 2});
  }
  EXPECT_EQ(ink(image), 0.0);

  fill_rectangle(image, all, Color(1.0f));
  EXPECT_EQ(ink(image), 100.0);
  Image white(8, 8, 3);
  fill_rectangle(white, all, Color(1.0f));
  Image black(10, 10, 3);
  paste(black, white, 6, -5);
  EXPECT_EQ(ink(black), 4.0 * 3.0);
}

TEST(Drawing, TextThatIsCutByAnEdgeShowsItsRest) {
  for (const Point at : {Point{-20.0, 12.0}, Point{20.0, 12.0}, Point{2.0, 4.0}, Point{2.0, 26.0}}) {
    Image image(40, 20, 3);
    draw_text(image, "MMMMMM", at, {.height = 10.0, .color = Color(1.0f)});
    EXPECT_GT(ink(image), 20.0) << at.x << ", " << at.y;
  }
}

TEST(Drawing, CapitalsAreAsHighAsTheyAreAsked) {
  for (const double height : {8.0, 12.0, 24.0}) {
    Image image(60, 60, 3);
    draw_text(image, "H", {20.0, 40.0}, {.height = height, .color = Color(1.0f)});
    double rows = 0.0;
    for (int y = 0; y < 60; ++y) {
      float darkest = 0.0f;
      for (int x = 0; x < 60; ++x) darkest = std::max(darkest, image.at(x, y));
      rows += darkest;
    }
    EXPECT_NEAR(rows, height, 1.0);  // fonts are set in whole pixels
  }
}

TEST(Drawing, TextIsAlignedByItsEnds) {
  const auto columns = [](TextAlignment alignment) {
    Image image(300, 60, 3);
    draw_text(image, "Noise 12", {150.0, 40.0}, {24.0, Color(1.0f), alignment});
    return inked_columns(image);
  };
  const Columns left = columns(TextAlignment::left);
  const Columns centre = columns(TextAlignment::centre);
  const Columns right = columns(TextAlignment::right);
  EXPECT_NEAR(left.first, 150, 4);  // a letter has room on its left
  EXPECT_NEAR(0.5 * (centre.first + centre.end), 150.0, 1.0);
  EXPECT_NEAR(right.end, 150, 1);
  EXPECT_EQ(left.end - left.first, right.end - right.first);
}

TEST(Drawing, AnOutlineIsBlack) {
  Image image(60, 40, 3);
  fill_rectangle(image, {0.0, 0.0, 60.0, 40.0}, Color(0.5f));
  draw_text(image, "H", {20.0, 30.0}, {.height = 20.0, .color = Color(1.0f), .outline = 2});
  int black = 0;
  int white = 0;
  for (int x = 0; x < 60; ++x) {
    black += image.at(x, 14) < 0.1f;
    white += image.at(x, 14) > 0.9f;
  }
  // Two stems with an edge on each side; pixels that are partly covered are neither.
  EXPECT_GE(black, 4);
  EXPECT_GE(white, 2);
}

TEST(Drawing, OtherThanAsciiIsAQuestionMark) {
  Image image(60, 40, 3);
  Image question(60, 40, 3);
  draw_text(image, "\xe9", {20.0, 30.0}, {.color = Color(1.0f)});
  draw_text(question, "?", {20.0, 30.0}, {.color = Color(1.0f)});
  EXPECT_EQ(image.pixels, question.pixels);
}

// In a process of its own: the font is looked for once.
TEST(DrawingDeathTest, AMissingFontIsNamed) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        setenv("SOLIDNOISE_FONT", "/nowhere/font.ttf", 1);
        Image image(20, 20, 3);
        try {
          draw_text(image, "a", {5.0, 15.0}, {});
        } catch (const std::runtime_error& error) {
          std::_Exit(std::string(error.what()).find("/nowhere/font.ttf") != std::string::npos ? 0 : 1);
        }
        std::_Exit(2);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace solidnoise::drawing_test
