#include "solidnoise/image/stroke_font.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>

namespace solidnoise {
namespace {

// Strokes are separated by ';', points by spaces. Plain strokes are polylines; a stroke that begins with '~'
// is an open, one with 'o' a closed quadratic B-spline of its points. A capital letter is 12 high, a small
// one 8, and tails go to -4.
struct Letter {
  char character;
  double width;
  std::string_view strokes;
};

constexpr std::array kLetters{
    Letter{' ', 3.0, ""},
    Letter{'A', 8.0, "0,0 4,12 8,0;1.3,4 6.7,4"},
    Letter{'B', 7.5, "0,12 0,0;~0,12 4,12 7,12 7,6.5 4,6.5 0,6.5;~0,6.5 4,6.5 7.5,6.5 7.5,0 4,0 0,0"},
    Letter{'C', 8.0, "~8,9.7 7.2,12 4.5,12 0,12 0,0 4.5,0 7.2,0 8,2.3"},
    Letter{'D', 8.0, "0,12 0,0;~0,12 3,12 8,12 8,0 3,0 0,0"},
    Letter{'E', 6.5, "6.5,12 0,12 0,0 6.5,0;0,6.5 5.5,6.5"},
    Letter{'F', 6.5, "6.5,12 0,12 0,0;0,6.5 5.5,6.5"},
    Letter{'G', 8.5, "~8.3,9.7 7.2,12 4.5,12 0,12 0,0 4.5,0 8.5,0 8.5,4 8.5,5.5;8.5,5.5 5,5.5"},
    Letter{'H', 8.0, "0,12 0,0;8,12 8,0;0,6.5 8,6.5"},
    Letter{'I', 0.0, "0,12 0,0"},
    Letter{'J', 5.0, "~5,12 5,8 5,4 5,0 2.5,0 0,0 0,3"},
    Letter{'K', 7.5, "0,12 0,0;7,12 0,4.8;2.4,7.3 7.5,0"},
    Letter{'L', 6.0, "0,12 0,0 6,0"},
    Letter{'M', 9.0, "0,0 0,12 4.5,3 9,12 9,0"},
    Letter{'N', 8.0, "0,0 0,12 8,0 8,12"},
    Letter{'O', 9.0, "o0,0 9,0 9,12 0,12"},
    Letter{'P', 7.0, "0,12 0,0;~0,12 4,12 7,12 7,5.5 4,5.5 0,5.5"},
    Letter{'Q', 9.0, "o0,0 9,0 9,12 0,12;5.5,3 9,-1"},
    Letter{'R', 7.5, "0,12 0,0;~0,12 4,12 7,12 7,6 4,6 0,6;4,6 7.5,0"},
    Letter{'S', 7.5, "~7.2,9.8 6.6,12 3.8,12 0.4,12 0.4,6.8 3.8,6.3 7.5,5.8 7.5,0 3.8,0 0.7,0 0,2.4"},
    Letter{'T', 8.0, "0,12 8,12;4,12 4,0"},
    Letter{'U', 8.0, "~0,12 0,8 0,4 0,0 4,0 8,0 8,4 8,8 8,12"},
    Letter{'V', 8.0, "0,12 4,0 8,12"},
    Letter{'W', 11.0, "0,12 2.75,0 5.5,12 8.25,0 11,12"},
    Letter{'X', 7.5, "0,12 7.5,0;7.5,12 0,0"},
    Letter{'Y', 8.0, "0,12 4,6 8,12;4,6 4,0"},
    Letter{'Z', 7.5, "0,12 7.5,12 0,0 7.5,0"},
    Letter{'a', 6.5, "6.5,8 6.5,0;o0,0 6.5,0 6.5,8 0,8"},
    Letter{'b', 6.5, "0,12 0,0;o0,0 6.5,0 6.5,8 0,8"},
    Letter{'c', 6.0, "~6,6.5 5.4,8 3.5,8 0,8 0,0 3.5,0 5.4,0 6,1.5"},
    Letter{'d', 6.5, "6.5,12 6.5,0;o0,0 6.5,0 6.5,8 0,8"},
    Letter{'e', 6.5, "0.2,4.2 6.5,4.2;~6.5,4.2 6.5,8 3.4,8 0,8 0,0 3.6,0 5.6,0 6.3,1.6"},
    Letter{'f', 4.0, "~4.3,12 1.5,12.3 1.5,9 1.5,6 1.5,0;0,8 4,8"},
    Letter{'g', 6.5, "~6.5,8 6.5,3 6.5,-1 6.5,-4 3.3,-4 1,-4 0.5,-2.6;o0,0 6.5,0 6.5,8 0,8"},
    Letter{'h', 6.0, "0,12 0,0;~0,4 0,8 3.2,8 6,8 6,4 6,2 6,0"},
    Letter{'i', 0.0, "0,8 0,0;0,11 0,11.4"},
    Letter{'j', 1.5, "~1.5,8 1.5,2 1.5,-1 1.5,-4 -1,-4;1.5,11 1.5,11.4"},
    Letter{'k', 6.0, "0,12 0,0;5.6,8 0,2.8;2.2,4.8 6,0"},
    Letter{'l', 1.8, "~0,12 0,8 0,4 0,0 1.8,0"},
    Letter{'m', 10.0, "0,8 0,0;~0,4 0,8 2.8,8 5,8 5,5 5,2 5,0;~5,4 5,8 7.8,8 10,8 10,5 10,2 10,0"},
    Letter{'n', 6.0, "0,8 0,0;~0,4 0,8 3.2,8 6,8 6,4 6,2 6,0"},
    Letter{'o', 6.8, "o0,0 6.8,0 6.8,8 0,8"},
    Letter{'p', 6.5, "0,8 0,-4;o0,0 6.5,0 6.5,8 0,8"},
    Letter{'q', 6.5, "6.5,8 6.5,-4;o0,0 6.5,0 6.5,8 0,8"},
    Letter{'r', 3.8, "0,8 0,0;~0,4 0,8 3.8,8"},
    Letter{'s', 5.6, "~5.3,6.6 4.9,8 2.8,8 0.4,8 0.4,4.5 2.8,4.2 5.6,3.9 5.6,0 2.8,0 0.5,0 0,1.5"},
    Letter{'t', 4.2, "~1.5,11 1.5,6 1.5,0 4.2,0;0,8 4,8"},
    Letter{'u', 6.0, "6,8 6,0;~0,8 0,6 0,4 0,0 2.8,0 6,0 6,4"},
    Letter{'v', 6.4, "0,8 3.2,0 6.4,8"},
    Letter{'w', 9.2, "0,8 2.3,0 4.6,8 6.9,0 9.2,8"},
    Letter{'x', 6.0, "0,8 6,0;6,8 0,0"},
    Letter{'y', 6.4, "0,8 3.2,0;6.4,8 2.8,-1.2;~2.8,-1.2 1.8,-4 0,-4"},
    Letter{'z', 5.8, "0,8 5.8,8 0,0 5.8,0"},
    Letter{'0', 7.2, "o0,0 7.2,0 7.2,12 0,12"},
    Letter{'1', 7.2, "1.2,9.4 4.2,12 4.2,0"},
    Letter{'2', 7.2, "~0.3,8.8 0.3,12 3.6,12 7,12 7,8.7 7,6.5 4,4 0,0;0,0 7.2,0"},
    Letter{'3', 7.2,
           "~0.4,10 1,12 3.6,12 6.8,12 6.8,6.5 3.6,6.5 2.4,6.5;"
           "~2.4,6.5 3.8,6.5 7.2,6.5 7.2,0 3.6,0 0.7,0 0,2.2"},
    Letter{'4', 7.2, "5.4,0 5.4,12 0,3.5 7.2,3.5"},
    Letter{'5', 7.2, "6.4,12 1,12 0.5,6.3;~0.5,6.3 1.6,7.7 3.6,7.7 7.2,7.7 7.2,0 3.4,0 0.7,0 0,2"},
    Letter{'6', 7.2, "~6.4,10.4 5.6,12 3.8,12 0,12 0,5 0,3.8;o0,0 7.2,0 7.2,7.6 0,7.6"},
    Letter{'7', 7.2, "0,12 7.2,12 2.4,0"},
    Letter{'8', 7.2, "o0.5,6.5 6.7,6.5 6.7,12 0.5,12;o0,0 7.2,0 7.2,6.5 0,6.5"},
    Letter{'9', 7.2, "~0.8,1.6 1.6,0 3.4,0 7.2,0 7.2,7 7.2,8.2;o0,4.4 7.2,4.4 7.2,12 0,12"},
    Letter{'.', 0.5, "0.2,0 0.2,0.4"},
    Letter{',', 1.0, "0.8,0.4 0,-2.2"},
    Letter{':', 0.5, "0.2,0 0.2,0.4;0.2,7 0.2,7.4"},
    Letter{';', 1.0, "0.8,0.4 0,-2.2;0.7,7 0.7,7.4"},
    Letter{'!', 0.5, "0.2,12 0.2,4;0.2,0 0.2,0.4"},
    Letter{'?', 6.5, "~0,9.5 0.4,12 3.3,12 6.5,12 6.5,8.6 6.5,6.8 3.3,6 3.3,3.6;3.3,0 3.3,0.4"},
    Letter{'\'', 0.0, "0,12 0,9"},
    Letter{'"', 2.6, "0,12 0,9;2.6,12 2.6,9"},
    Letter{'`', 2.0, "0,12.5 2,10.5"},
    Letter{'-', 4.5, "0,5 4.5,5"},
    Letter{'_', 7.0, "0,-2 7,-2"},
    Letter{'+', 7.0, "0,5.5 7,5.5;3.5,9 3.5,2"},
    Letter{'*', 5.0, "0,9 5,9;1.2,11.2 3.8,6.8;3.8,11.2 1.2,6.8"},
    Letter{'=', 7.0, "0,7.3 7,7.3;0,3.7 7,3.7"},
    Letter{'/', 5.0, "0,-1 5,13"},
    Letter{'\\', 5.0, "0,13 5,-1"},
    Letter{'|', 0.0, "0,13 0,-2"},
    Letter{'(', 3.0, "~3,13.5 0,10 0,1 3,-2.5"},
    Letter{')', 3.0, "~0,13.5 3,10 3,1 0,-2.5"},
    Letter{'[', 2.8, "2.8,13 0,13 0,-2 2.8,-2"},
    Letter{']', 2.8, "0,13 2.8,13 2.8,-2 0,-2"},
    Letter{'{', 3.6, "~3.6,13 1.6,13 1.6,9 1.6,6.5 0,5.5;~0,5.5 1.6,4.5 1.6,2 1.6,-2 3.6,-2"},
    Letter{'}', 3.6, "~0,13 2,13 2,9 2,6.5 3.6,5.5;~3.6,5.5 2,4.5 2,2 2,-2 0,-2"},
    Letter{'<', 6.0, "6,9.5 0,5.5 6,1.5"},
    Letter{'>', 6.0, "0,9.5 6,5.5 0,1.5"},
    Letter{'%', 9.0, "0.5,0 8.5,12;o0,6.5 3.8,6.5 3.8,12 0,12;o5.2,0 9,0 9,5.5 5.2,5.5"},
    Letter{'^', 5.6, "0,8 2.8,12 5.6,8"},
    Letter{'~', 7.0, "~0,4.5 1.4,8 3.5,5.5 5.6,3 7,6.5"},
    Letter{'#', 8.0, "1.6,0 3.2,12;4.8,0 6.4,12;0,4 7.6,4;0.4,8 8,8"},
    Letter{'$', 7.5,
           "~7.2,9.6 6.6,11 3.8,11 0.4,11 0.4,6.5 3.8,6.1 7.5,5.7 7.5,1 3.8,1 0.7,1 0,2.9;3.8,13 3.8,-1"},
    Letter{'&', 8.5, "~8.5,0 5,4 1.5,8 1.5,12 3.8,12 6,12 6,8.5 3.5,7 0,5 0,0 3.6,0 7,0 7.8,5"},
    Letter{'@', 10.0, "o3,3 7,3 7,9 3,9;~7,9 7,5 7,2.5 10,2.5 10,6 10,12 5,12 0,12 0,-1 5,-1 7.5,-1 8.5,0.3"},
};

constexpr Letter kUnknown{'\0', 6.0, "0,0 6,0 6,12 0,12 0,0"};

std::vector<Point> parse_points(std::string_view text) {
  std::vector<Point> points;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (at < end) {
    Point point;
    at = std::from_chars(at, end, point.x).ptr + 1;  // past the comma
    at = std::from_chars(at, end, point.y).ptr + 1;  // past the space
    points.push_back(point);
  }
  return points;
}

Point mix(const Point& a, const Point& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

// One parabola of the spline, as a few segments.
void append_parabola(std::vector<Point>& line, const Point& from, const Point& control, const Point& to) {
  constexpr int kSegments = 6;
  for (int i = 1; i <= kSegments; ++i) {
    const double t = static_cast<double>(i) / kSegments;
    line.push_back(mix(mix(from, control, t), mix(control, to, t), t));
  }
}

// The parabolas join, with a common tangent, in the middle between two control points; an open spline begins
// and ends at its first and its last point.
std::vector<Point> open_spline(const std::vector<Point>& controls) {
  std::vector<Point> line{controls.front()};
  for (std::size_t i = 1; i + 1 < controls.size(); ++i) {
    const bool last = i + 2 == controls.size();
    const Point from = line.back();
    append_parabola(line, from, controls[i], last ? controls[i + 1] : mix(controls[i], controls[i + 1], 0.5));
  }
  return line;
}

std::vector<Point> closed_spline(const std::vector<Point>& controls) {
  const std::size_t count = controls.size();
  std::vector<Point> line{mix(controls[count - 1], controls[0], 0.5)};
  for (std::size_t i = 0; i < count; ++i) {
    const Point from = line.back();
    append_parabola(line, from, controls[i], mix(controls[i], controls[(i + 1) % count], 0.5));
  }
  return line;
}

std::vector<Point> parse_stroke(std::string_view text) {
  if (text.front() == '~') return open_spline(parse_points(text.substr(1)));
  if (text.front() == 'o') return closed_spline(parse_points(text.substr(1)));
  return parse_points(text);
}

StrokeGlyph make_glyph(const Letter& letter) {
  StrokeGlyph glyph;
  glyph.width = letter.width;
  std::string_view rest = letter.strokes;
  while (!rest.empty()) {
    const std::size_t length = rest.find(';');
    glyph.strokes.push_back(parse_stroke(rest.substr(0, length)));
    rest = length == std::string_view::npos ? std::string_view() : rest.substr(length + 1);
  }
  return glyph;
}

}  // namespace

StrokeGlyph stroke_glyph(char character) {
  for (const Letter& letter : kLetters) {
    if (letter.character == character) return make_glyph(letter);
  }
  return make_glyph(kUnknown);
}

}  // namespace solidnoise
