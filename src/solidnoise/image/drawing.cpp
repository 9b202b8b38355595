#include "solidnoise/image/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "solidnoise/image/stroke_font.h"

namespace solidnoise {
namespace {

// The pixels that a rectangle touches.
struct PixelRange {
  int left, top, right, bottom;
};

PixelRange pixels_in(const Image& image, const Rectangle& box) {
  const auto within = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
  };
  return {within(std::floor(box.left), image.width), within(std::floor(box.top), image.height),
          within(std::ceil(box.right), image.width), within(std::ceil(box.bottom), image.height)};
}

void blend(Image& image, int x, int y, const Color& color, double coverage) {
  const float share = static_cast<float>(std::clamp(coverage, 0.0, 1.0));
  for (int channel = 0; channel < 3; ++channel) {
    float& value = image.at(x, y, channel);
    value += share * (color[channel] - value);
  }
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double along =
      squared == 0.0 ? 0.0 : std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0);
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

// Covers with one colour what lies within half a pen's width of any of the polylines: overlaps count once.
void draw_strokes(Image& image, const std::vector<std::vector<Point>>& strokes, const Pen& pen) {
  Rectangle box{1e9, 1e9, -1e9, -1e9};
  for (const std::vector<Point>& stroke : strokes) {
    for (const Point& point : stroke) {
      box = {std::min(box.left, point.x), std::min(box.top, point.y), std::max(box.right, point.x),
             std::max(box.bottom, point.y)};
    }
  }
  const double margin = 0.5 * pen.width + 1.0;
  box = {box.left - margin, box.top - margin, box.right + margin, box.bottom + margin};
  const PixelRange range = pixels_in(image, box);
  if (range.left >= range.right || range.top >= range.bottom) return;

  const int columns = range.right - range.left;
  std::vector<double> coverage(static_cast<std::size_t>(columns) *
                               static_cast<std::size_t>(range.bottom - range.top));
  const auto cover = [&](const Point& a, const Point& b) {
    const PixelRange part = pixels_in(image, {std::min(a.x, b.x) - margin, std::min(a.y, b.y) - margin,
                                              std::max(a.x, b.x) + margin, std::max(a.y, b.y) + margin});
    for (int y = part.top; y < part.bottom; ++y) {
      for (int x = part.left; x < part.right; ++x) {
        const double distance = distance_to_segment({x + 0.5, y + 0.5}, a, b);
        double& covered = coverage[static_cast<std::size_t>((y - range.top) * columns + x - range.left)];
        covered = std::max(covered, 0.5 + 0.5 * pen.width - distance);
      }
    }
  };
  for (const std::vector<Point>& stroke : strokes) {
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i) cover(stroke[i], stroke[i + 1]);
  }
  // A line thinner than a pixel covers a part of each.
  const double most = std::min(1.0, pen.width);
  for (int y = range.top; y < range.bottom; ++y) {
    for (int x = range.left; x < range.right; ++x) {
      const double covered = coverage[static_cast<std::size_t>((y - range.top) * columns + x - range.left)];
      if (covered > 0.0) blend(image, x, y, pen.color, std::min(covered, most));
    }
  }
}

}  // namespace

void fill_rectangle(Image& image, const Rectangle& rectangle, const Color& color) {
  const PixelRange range = pixels_in(image, rectangle);
  for (int y = range.top; y < range.bottom; ++y) {
    const double rows = std::min(rectangle.bottom, y + 1.0) - std::max(rectangle.top, y + 0.0);
    for (int x = range.left; x < range.right; ++x) {
      const double columns = std::min(rectangle.right, x + 1.0) - std::max(rectangle.left, x + 0.0);
      blend(image, x, y, color, rows * columns);
    }
  }
}

void draw_line(Image& image, const Point& from, const Point& to, const Pen& pen) {
  draw_polyline(image, std::array<Point, 2>{from, to}, pen);
}

void draw_polyline(Image& image, std::span<const Point> points, const Pen& pen) {
  draw_strokes(image, {std::vector<Point>(points.begin(), points.end())}, pen);
}

void draw_frame(Image& image, const Rectangle& r, const Pen& pen) {
  const std::array<Point, 5> corners{
      {{r.left, r.top}, {r.right, r.top}, {r.right, r.bottom}, {r.left, r.bottom}, {r.left, r.top}}};
  draw_polyline(image, corners, pen);
}

void draw_disc(Image& image, const Point& center, double radius, const Color& color) {
  draw_line(image, center, center, {color, 2.0 * radius});
}

void draw_text(Image& image, std::string_view text, const Point& at, const TextStyle& style) {
  double x = at.x;
  if (style.alignment == TextAlignment::center) x -= 0.5 * text_width(text, style.height);
  if (style.alignment == TextAlignment::right) x -= text_width(text, style.height);
  const double scale = style.height / kCapitalHeight;
  for (const char character : text) {
    const StrokeGlyph glyph = stroke_glyph(character);
    std::vector<std::vector<Point>> strokes = glyph.strokes;
    for (std::vector<Point>& stroke : strokes) {
      for (Point& point : stroke) point = {x + scale * point.x, at.y - scale * point.y};
    }
    draw_strokes(image, strokes, {style.color, style.weight * style.height});
    x += scale * (glyph.width + kLetterSpacing);
  }
}

double text_width(std::string_view text, double height) {
  if (text.empty()) return 0.0;
  double width = -kLetterSpacing;
  for (const char character : text) width += stroke_glyph(character).width + kLetterSpacing;
  return width * height / kCapitalHeight;
}

void paste(Image& image, const Image& part, int x, int y) {
  for (int row = std::max(0, -y); row < std::min(part.height, image.height - y); ++row) {
    for (int column = std::max(0, -x); column < std::min(part.width, image.width - x); ++column) {
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x + column, y + row, channel) = part.at(column, row, channel);
      }
    }
  }
}

}  // namespace solidnoise
