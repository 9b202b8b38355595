#pragma once

#include <string>
#include <vector>

#include "solidnoise/core/image.h"
#include "solidnoise/image/drawing.h"

namespace solidnoise {

// A line, or dots with error bars, in a plot.
struct PlotSeries {
  enum class Style { line, dots };

  std::string label;
  Style style = Style::line;
  Color color{0.0f};           // sRGB
  std::vector<Point> points;   // in the axes' units; those that are not finite, or outside, are left out
  std::vector<double> errors;  // half the length of a bar per point, for dots; or none
};

struct PlotAxis {
  enum class Scale { linear, logarithmic };

  std::string label;
  double lower = 0.0;  // > 0 if logarithmic
  double upper = 1.0;  // > lower
  Scale scale = Scale::linear;
};

struct LinePlot {
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotSeries> series;
  double text_height = 9.0;  // of a capital letter, pixels
};

// Draws axes with ticks, series and legend. `area` is where the data go; labels take some 4 text heights
// below it, and numbers some 6 to its left.
void draw_line_plot(Image& image, const Rectangle& area, const LinePlot& plot);

// 1, 2 or 5 times a power of ten: the largest that is at most `value` > 0.
double round_length(double value);

// A number as a person writes it: up to 3 digits, no trailing zeros.
std::string short_number(double value);

}  // namespace solidnoise
