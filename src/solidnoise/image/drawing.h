#pragma once

#include <string>

#include "solidnoise/core/image.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

// Words, lines and boxes on a picture of three channels, by OpenImageIO. Positions are in pixels from the top
// left corner of the picture, y downwards, and fall on the pixel that they are in; edges are not smoothed.
// Colours are set as the numbers they are. What falls outside of the picture is left out. Each function
// throws std::runtime_error if the image module is not installed.

struct Point {
  double x = 0.0;
  double y = 0.0;
};

struct Rectangle {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;  // the first pixel beyond it, and so is `bottom`
  double bottom = 0.0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

struct Pen {
  Color color{0.0f};
  int width = 1;  // pixels
};

enum class TextAlignment { left, centre, right };

struct TextStyle {
  double height = 12.0;  // of a capital letter, pixels
  Color color{0.0f};
  TextAlignment alignment = TextAlignment::left;
  int outline = 0;  // width of a black line around the letters, pixels
};

void fill_rectangle(Image& image, const Rectangle& rectangle, const Color& color);
void draw_frame(Image& image, const Rectangle& rectangle, const Color& color);
void draw_line(Image& image, const Point& from, const Point& to, const Pen& pen);

// Printable ASCII, one line, in DejaVu Sans; `at` is the left end (or the middle, or the right end) of the
// base line. Any other byte becomes a question mark. The font's file is $SOLIDNOISE_FONT, or where Linux
// systems have it; if there is none, the std::runtime_error says what to install.
void draw_text(Image& image, const std::string& text, const Point& at, const TextStyle& style);

// Copies a picture of three channels so that its top left corner comes to (x, y).
void paste(Image& image, const Image& part, int x, int y);

}  // namespace solidnoise
