#include "solidnoise/analysis/line_plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <fmt/format.h>

namespace solidnoise {
namespace {

const Color kText(0.15f);
const Color kAxis(0.35f);
const Color kGrid(0.9f);

// Where a value lies between the ends of an axis, 0 to 1.
double fraction(const PlotAxis& axis, double value) {
  if (axis.scale == PlotAxis::Scale::linear) return (value - axis.lower) / (axis.upper - axis.lower);
  return std::log(value / axis.lower) / std::log(axis.upper / axis.lower);
}

std::vector<double> tick_values(const PlotAxis& axis) {
  std::vector<double> ticks;
  if (axis.scale == PlotAxis::Scale::logarithmic) {
    const double decades = std::log10(axis.upper / axis.lower);
    const int step = std::max(1, static_cast<int>(std::ceil(decades / 6.0)));
    const int first = static_cast<int>(std::ceil(std::log10(axis.lower) - 1e-9));
    for (int exponent = first; std::pow(10.0, exponent) <= axis.upper * (1.0 + 1e-9); exponent += step) {
      ticks.push_back(std::pow(10.0, exponent));
    }
    return ticks;
  }
  const double step = round_length((axis.upper - axis.lower) / 5.0);
  for (double k = std::ceil(axis.lower / step - 1e-9); k * step <= axis.upper + 1e-9 * step; ++k) {
    ticks.push_back(k * step);
  }
  return ticks;
}

class Plotter {
 public:
  Plotter(Image& image, const Rectangle& area, const LinePlot& plot)
      : image_(image), area_(area), plot_(plot) {}

  void draw() {
    draw_axes();
    for (const PlotSeries& series : plot_.series) {
      if (series.style == PlotSeries::Style::line) {
        draw_curve(series);
      } else {
        draw_dots(series);
      }
    }
    draw_legend();
  }

 private:
  TextStyle text(TextAlignment alignment) const { return {plot_.text_height, kText, alignment}; }

  double x_pixel(double x) const { return area_.left + fraction(plot_.x, x) * area_.width(); }
  double y_pixel(double y) const { return area_.bottom - fraction(plot_.y, y) * area_.height(); }

  // Where a point lies, if it is in the area.
  std::optional<Point> place(const Point& point) const {
    const double x = fraction(plot_.x, point.x);
    const double y = fraction(plot_.y, point.y);
    if (!(x >= 0.0 && x <= 1.0 && y >= 0.0 && y <= 1.0)) return std::nullopt;
    return Point{area_.left + x * area_.width(), area_.bottom - y * area_.height()};
  }

  void draw_axes() {
    const double height = plot_.text_height;
    for (const double tick : tick_values(plot_.x)) {
      const double x = x_pixel(tick);
      draw_line(image_, {x, area_.top}, {x, area_.bottom}, {kGrid});
      draw_line(image_, {x, area_.bottom}, {x, area_.bottom + 0.5 * height}, {kAxis});
      draw_text(image_, short_number(tick), {x, area_.bottom + 2.0 * height}, text(TextAlignment::centre));
    }
    for (const double tick : tick_values(plot_.y)) {
      const double y = y_pixel(tick);
      draw_line(image_, {area_.left, y}, {area_.right, y}, {kGrid});
      draw_line(image_, {area_.left - 0.5 * height, y}, {area_.left, y}, {kAxis});
      draw_text(image_, short_number(tick), {area_.left - height, y + 0.5 * height},
                text(TextAlignment::right));
    }
    draw_frame(image_, area_, kAxis);
    draw_text(image_, plot_.x.label, {0.5 * (area_.left + area_.right), area_.bottom + 4.2 * height},
              text(TextAlignment::centre));
    draw_text(image_, plot_.y.label, {area_.left, area_.top - height}, text(TextAlignment::left));
  }

  // The part of a curve between two points that is in the area's height; the ends are inside its width.
  void draw_curve(const PlotSeries& series) {
    for (std::size_t i = 0; i + 1 < series.points.size(); ++i) {
      Point a{fraction(plot_.x, series.points[i].x), fraction(plot_.y, series.points[i].y)};
      Point b{fraction(plot_.x, series.points[i + 1].x), fraction(plot_.y, series.points[i + 1].y)};
      if (!(a.x >= 0.0 && b.x <= 1.0) || !std::isfinite(a.y) || !std::isfinite(b.y)) continue;
      if (std::max(a.y, b.y) < 0.0 || std::min(a.y, b.y) > 1.0) continue;
      const auto clip = [](Point& p, const Point& q) {
        const double limit = std::clamp(p.y, 0.0, 1.0);
        if (limit == p.y) return;
        p.x += (limit - p.y) / (q.y - p.y) * (q.x - p.x);
        p.y = limit;
      };
      clip(a, b);
      clip(b, a);
      const auto pixel = [this](const Point& p) {
        return Point{area_.left + p.x * area_.width(), area_.bottom - p.y * area_.height()};
      };
      draw_line(image_, pixel(a), pixel(b), {series.color, 2});
    }
  }

  void draw_dots(const PlotSeries& series) {
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const Point& point = series.points[i];
      const std::optional<Point> centre = place(point);
      if (!centre) continue;
      if (i < series.errors.size()) {
        const double low = std::max(point.y - series.errors[i], plot_.y.lower);
        const double high = std::min(point.y + series.errors[i], plot_.y.upper);
        draw_line(image_, {centre->x, y_pixel(low)}, {centre->x, y_pixel(high)}, {series.color});
      }
      draw_dot(*centre, series.color);
    }
  }

  void draw_dot(const Point& centre, const Color& color) {
    fill_rectangle(image_, {centre.x - 2.0, centre.y - 2.0, centre.x + 3.0, centre.y + 3.0}, color);
  }

  void draw_legend() {
    const double height = plot_.text_height;
    const double end = area_.right - 1.5 * height;
    const double start = end - 2.5 * height;
    double y = area_.top + 2.2 * height;
    for (const PlotSeries& series : plot_.series) {
      draw_text(image_, series.label, {start - height, y}, text(TextAlignment::right));
      const double middle = y - 0.5 * height;
      if (series.style == PlotSeries::Style::line) {
        draw_line(image_, {start, middle}, {end, middle}, {series.color, 2});
      } else {
        draw_dot({0.5 * (start + end), middle}, series.color);
      }
      y += 2.0 * height;
    }
  }

  Image& image_;
  const Rectangle& area_;
  const LinePlot& plot_;
};

}  // namespace

void draw_line_plot(Image& image, const Rectangle& area, const LinePlot& plot) {
  Plotter(image, area, plot).draw();
}

double round_length(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0, 1.0}) {
    if (digit * power <= value * (1.0 + 1e-12)) return digit * power;
  }
  return power;
}

std::string short_number(double value) {
  return fmt::format("{:.3g}", value == 0.0 ? 0.0 : value);
}

}  // namespace solidnoise
