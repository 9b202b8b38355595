#pragma once

#include <span>
#include <string_view>

#include "solidnoise/core/image.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

// Simple drawing on a picture of three channels, anti-aliased. Positions are in pixels from the top left
// corner of the picture, y downwards; pixel (0, 0) covers 0 to 1. Colours are mixed as the numbers they are.
// What falls outside of the picture is left out.

struct Point {
  double x = 0.0;
  double y = 0.0;
};

struct Rectangle {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

struct Pen {
  Color color{0.0f};
  double width = 1.5;  // pixels
};

enum class TextAlignment { left, center, right };

struct TextStyle {
  double height = 12.0;  // of a capital letter, pixels
  Color color{0.0f};
  TextAlignment alignment = TextAlignment::left;
  double weight = 0.13;  // width of the strokes, in heights
};

void fill_rectangle(Image& image, const Rectangle& rectangle, const Color& color);
void draw_line(Image& image, const Point& from, const Point& to, const Pen& pen);
void draw_polyline(Image& image, std::span<const Point> points, const Pen& pen);
void draw_frame(Image& image, const Rectangle& rectangle, const Pen& pen);
void draw_disc(Image& image, const Point& center, double radius, const Color& color);

// Printable ASCII, one line; `at` is the left end (or the centre, or the right end) of the base line. Any
// other character is drawn as a box.
void draw_text(Image& image, std::string_view text, const Point& at, const TextStyle& style);
double text_width(std::string_view text, double height);

// Copies a picture of three channels so that its top left corner comes to (x, y).
void paste(Image& image, const Image& part, int x, int y);

}  // namespace solidnoise
