#include "solidnoise/image/color.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace solidnoise {

float srgb_from_linear(float linear) {
  const float magnitude = std::abs(linear);
  const float encoded =
      magnitude <= 0.0031308f ? 12.92f * magnitude : 1.055f * std::pow(magnitude, 1.0f / 2.4f) - 0.055f;
  return std::copysign(encoded, linear);
}

float linear_from_srgb(float encoded) {
  const float magnitude = std::abs(encoded);
  const float linear =
      magnitude <= 0.04045f ? magnitude / 12.92f : std::pow((magnitude + 0.055f) / 1.055f, 2.4f);
  return std::copysign(linear, encoded);
}

Color srgb_from_linear(const Color& linear) {
  return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z)};
}

Color linear_from_srgb(const Color& encoded) {
  return {linear_from_srgb(encoded.x), linear_from_srgb(encoded.y), linear_from_srgb(encoded.z)};
}

namespace {

struct NamedRamp {
  std::string_view name;
  std::string_view stops;
};

// viridis: nine intervals of the colour map of that name, which is in the public domain (CC0).
constexpr std::array<NamedRamp, 5> kNamedRamps{{
    {"viridis",
     "0:#440154,0.1111:#482878,0.2222:#3e4a89,0.3333:#31688e,0.4444:#26828e,0.5556:#1f9e89,0.6667:#35b779,"
     "0.7778:#6ece58,0.8889:#b5de2b,1:#fde725"},
    {"grey", "0:#000000,1:#ffffff"},
    {"marble", "0:#22262e,0.18:#5b626c,0.34:#a9adb1,0.5:#d8d6d0,0.75:#ece9e2,1:#f8f6f1"},
    {"rust", "0:#2a1410,0.25:#5c2713,0.45:#8f3f17,0.6:#b5622a,0.72:#7f7468,0.85:#8d9196,1:#b9bec4"},
    {"scales", "0:#0d1f14,0.3:#1f4a2b,0.48:#3f7d3a,0.6:#8fae4b,0.7:#d9cf7a,0.8:#6f8f45,1:#1b3a24"},
}};

std::optional<Color> parse_hex_color(std::string_view text) {
  if (text.empty() || text[0] != '#') return std::nullopt;
  const std::string_view digits = text.substr(1);
  if (digits.size() != 3 && digits.size() != 6) return std::nullopt;
  const std::size_t width = digits.size() / 3;
  Color color;
  for (int channel = 0; channel < 3; ++channel) {
    const char* const begin = digits.data() + static_cast<std::size_t>(channel) * width;
    unsigned value = 0;
    const auto [end, error] = std::from_chars(begin, begin + width, value, 16);
    if (error != std::errc() || end != begin + width) return std::nullopt;
    color[channel] = static_cast<float>(value) / (width == 1 ? 15.0f : 255.0f);
  }
  return color;
}

ColorStop parse_stop(std::string_view stop) {
  const std::size_t colon = stop.find(':');
  if (colon == std::string_view::npos) {
    throw std::invalid_argument(
        fmt::format("ramp stop \"{}\" must be POSITION:#RRGGBB, as in 0.5:#ff8000", stop));
  }
  const std::string_view position_text = stop.substr(0, colon);
  const std::string_view color_text = stop.substr(colon + 1);
  ColorStop result;
  const char* const last = position_text.data() + position_text.size();
  const auto [end, error] = std::from_chars(position_text.data(), last, result.position);
  if (error != std::errc() || end != last || !std::isfinite(result.position)) {
    throw std::invalid_argument(
        fmt::format("ramp stop \"{}\": position \"{}\" must be a finite number", stop, position_text));
  }
  const std::optional<Color> color = parse_hex_color(color_text);
  if (!color) {
    throw std::invalid_argument(
        fmt::format("ramp stop \"{}\": colour \"{}\" must be #RGB or #RRGGBB", stop, color_text));
  }
  result.color = *color;
  return result;
}

ColorRamp parse_stops(std::string_view text) {
  std::vector<ColorStop> stops;
  while (true) {
    const std::size_t comma = text.find(',');
    stops.push_back(parse_stop(text.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  return ColorRamp(std::move(stops));
}

}  // namespace

ColorRamp::ColorRamp(std::vector<ColorStop> stops) : stops_(std::move(stops)) {
  if (stops_.size() < 2) {
    throw std::invalid_argument(fmt::format("ramp has {} stop(s); it must have at least 2", stops_.size()));
  }
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const ColorStop& stop = stops_[i];
    if (!std::isfinite(stop.position)) {
      throw std::invalid_argument(fmt::format("ramp position is {}; it must be finite", stop.position));
    }
    if (i > 0 && stop.position < stops_[i - 1].position) {
      throw std::invalid_argument(fmt::format("ramp position {} comes after {}; positions must not decrease",
                                              stop.position, stops_[i - 1].position));
    }
    for (int channel = 0; channel < 3; ++channel) {
      if (!(stop.color[channel] >= 0.0f && stop.color[channel] <= 1.0f)) {
        throw std::invalid_argument(
            fmt::format("ramp colour channel is {}; it must be between 0 and 1", stop.color[channel]));
      }
    }
    linear_.push_back(linear_from_srgb(stop.color));
  }
}

Color ColorRamp::linear(float value) const {
  const auto after = std::upper_bound(stops_.begin(), stops_.end(), value,
                                      [](float v, const ColorStop& stop) { return v < stop.position; });
  if (after == stops_.begin() || std::isnan(value)) return linear_.front();
  if (after == stops_.end()) return linear_.back();
  const std::size_t upper = static_cast<std::size_t>(after - stops_.begin());
  const float below = stops_[upper - 1].position;
  const float t = (value - below) / (stops_[upper].position - below);
  return linear_[upper - 1] + t * (linear_[upper] - linear_[upper - 1]);
}

ColorRamp parse_color_ramp(std::string_view text) {
  if (text == "gray") text = "grey";  // as recipes of version 0.1 spell it
  for (const NamedRamp& ramp : kNamedRamps) {
    if (ramp.name == text) return parse_stops(ramp.stops);
  }
  if (text.find(':') == std::string_view::npos) {
    throw std::invalid_argument(
        fmt::format("ramp is \"{}\"; it must be one of {}, or stops as in 0:#000,1:#fff", text,
                    fmt::join(ramp_names(), ", ")));
  }
  return parse_stops(text);
}

std::vector<std::string_view> ramp_names() {
  std::vector<std::string_view> names;
  for (const NamedRamp& ramp : kNamedRamps) names.push_back(ramp.name);
  return names;
}

}  // namespace solidnoise
