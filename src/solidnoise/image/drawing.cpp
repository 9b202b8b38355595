#include "solidnoise/image/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "solidnoise/image/image_module.h"

namespace solidnoise {
namespace {

constexpr double kCapitalHeight = 0.729;  // of DejaVu Sans, in its size

int pixel(double position) {
  return static_cast<int>(std::floor(position));
}

SolidnoiseImageMark mark_of(int kind, const Color& color) {
  SolidnoiseImageMark mark{};
  mark.kind = kind;
  for (int channel = 0; channel < 3; ++channel) mark.color[channel] = color[channel];
  return mark;
}

void draw(Image& image, const SolidnoiseImageMark& mark) {
  std::array<char, 1024> text{};
  SolidnoiseImageError error{text.data(), text.size()};
  if (image_module().draw(image.pixels.data(), image.width, image.height, &mark, &error) != 0) {
    throw std::runtime_error(fmt::format("cannot draw: {}", text.data()));
  }
}

std::string find_font() {
  constexpr const char* kVariable = "SOLIDNOISE_FONT";
  const char* const chosen = std::getenv(kVariable);
  if (chosen != nullptr && *chosen != '\0') return chosen;
  for (const char* const folder : {"truetype/dejavu", "dejavu-sans-fonts", "TTF", "dejavu"}) {
    const std::string path = fmt::format("/usr/share/fonts/{}/DejaVuSans.ttf", folder);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path;
  }
  throw std::runtime_error(
      fmt::format("cannot draw words: there is no DejaVuSans.ttf in the folders of /usr/share/fonts; install "
                  "fonts-dejavu-core or set {} to the path of a .ttf file",
                  kVariable));
}

}  // namespace

void fill_rectangle(Image& image, const Rectangle& rectangle, const Color& color) {
  SolidnoiseImageMark mark = mark_of(kSolidnoiseImageBox, color);
  mark.x0 = std::max(0, pixel(rectangle.left));
  mark.y0 = std::max(0, pixel(rectangle.top));
  mark.x1 = std::min(image.width, pixel(rectangle.right)) - 1;
  mark.y1 = std::min(image.height, pixel(rectangle.bottom)) - 1;
  if (mark.x0 <= mark.x1 && mark.y0 <= mark.y1) draw(image, mark);
}

void draw_frame(Image& image, const Rectangle& r, const Color& color) {
  const Pen pen{color, 1};
  const double right = r.right - 1.0;
  const double bottom = r.bottom - 1.0;
  draw_line(image, {r.left, r.top}, {right, r.top}, pen);
  draw_line(image, {right, r.top}, {right, bottom}, pen);
  draw_line(image, {right, bottom}, {r.left, bottom}, pen);
  draw_line(image, {r.left, bottom}, {r.left, r.top}, pen);
}

void draw_line(Image& image, const Point& from, const Point& to, const Pen& pen) {
  // A pen with a square tip: a line for each of its pixels.
  for (int i = 0; i < pen.width * pen.width; ++i) {
    const int right = i % pen.width - pen.width / 2;
    const int down = i / pen.width - pen.width / 2;
    SolidnoiseImageMark mark = mark_of(kSolidnoiseImageLine, pen.color);
    mark.x0 = pixel(from.x) + right;
    mark.y0 = pixel(from.y) + down;
    mark.x1 = pixel(to.x) + right;
    mark.y1 = pixel(to.y) + down;
    draw(image, mark);
  }
}

void draw_text(Image& image, const std::string& text, const Point& at, const TextStyle& style) {
  if (text.empty()) return;
  static const std::string font = find_font();
  std::string printable = text;
  std::replace_if(
      printable.begin(), printable.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  SolidnoiseImageMark mark = mark_of(kSolidnoiseImageText, style.color);
  mark.x0 = pixel(at.x);
  mark.y0 = pixel(at.y);
  mark.text = printable.c_str();
  mark.font = font.c_str();
  mark.size = static_cast<int>(std::lround(style.height / kCapitalHeight));
  mark.alignment = static_cast<int>(style.alignment);
  mark.outline = style.outline;
  draw(image, mark);
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
