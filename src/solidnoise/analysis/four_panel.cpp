#include "solidnoise/analysis/four_panel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/analysis/field_picture.h"
#include "solidnoise/analysis/line_plot.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/core/check.h"
#include "solidnoise/image/drawing.h"

namespace solidnoise {
namespace {

// How many waves of the highest frequency the noise's panel shows: more would be too fine to see.
constexpr double kShownWaves = 50.0;

const Color kPaper(1.0f);
const Color kInk(0.1f);
const Color kMeasured(0.80f, 0.25f, 0.15f);
const Color kExpected(0.15f, 0.35f, 0.65f);

std::string singular(const std::string& unit) {
  return unit.size() > 1 && unit.back() == 's' ? unit.substr(0, unit.size() - 1) : unit;
}

// Sizes in pixels, for a picture of a given width.
struct Layout {
  explicit Layout(const FourPanelOptions& options, bool has_plot)
      : width(options.width),
        text(std::max(7.0, options.width / 90.0)),
        margin(options.width / 28.0),
        panel(static_cast<int>((options.width - 3.0 * margin) / 2.0)),
        top(options.title.empty() ? 0.6 * margin : 0.9 * margin + 2.0 * text),
        row(panel + 3.0 * text + 0.5 * margin),
        plot(has_plot ? 0.36 * options.width : 0.0),
        height(static_cast<int>(top + 2.0 * row + plot + 0.3 * margin)) {}

  double left(int column) const { return std::floor(margin + column * (panel + margin)); }
  double panel_top(int line) const { return std::floor(top + line * row + 2.4 * text); }

  int width;
  double text;
  double margin;
  int panel;
  double top;
  double row;   // height of a panel with its title
  double plot;  // height of the plot with its labels
  int height;
};

// The frequency (in the larger of |fx| and |fy|) below which lies all but a thousandth of the power.
double highest_frequency(const DenseField<2>& noise, double mean) {
  const PowerSpectrum<2> spectrum = periodogram(noise, {Window::hann, mean});
  std::vector<std::pair<double, double>> powers;
  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    const Vec<2> f = spectrum.frequency(i);
    powers.emplace_back(std::max(std::abs(f.x), std::abs(f.y)), spectrum.density[i]);
  }
  std::sort(powers.begin(), powers.end());
  const double total = std::accumulate(powers.begin(), powers.end(), 0.0,
                                       [](double sum, const auto& power) { return sum + power.second; });
  double sum = 0.0;
  for (const auto& [frequency, power] : powers) {
    sum += power;
    if (sum >= 0.999 * total) return frequency;
  }
  return powers.back().first;
}

class FourPanels {
 public:
  FourPanels(const FourPanelOptions& options, bool has_plot)
      : options_(options), layout_(options, has_plot), image_(layout_.width, layout_.height, 3) {
    fill_rectangle(image_, {0.0, 0.0, image_.width + 0.0, image_.height + 0.0}, kPaper);
    draw_text(image_, options.title, {layout_.margin, 0.6 * layout_.margin + 1.4 * layout_.text},
              {1.4 * layout_.text, kInk});
  }

  void draw_panel(int column, int line, const std::string& title, const Image& picture) {
    const double left = layout_.left(column);
    const double top = layout_.panel_top(line);
    draw_text(image_, title, {left, top - 0.8 * layout_.text}, {layout_.text, kInk});
    paste(image_, picture, static_cast<int>(left), static_cast<int>(top));
    draw_frame(image_, frame(column, line), kInk);
  }

  void draw_empty_panel(int column, int line, const std::string& title, const std::string& reason) {
    Image blank(layout_.panel, layout_.panel, 3);
    std::fill(blank.pixels.begin(), blank.pixels.end(), 0.93f);
    draw_panel(column, line, title, blank);
    const Rectangle area = frame(column, line);
    draw_text(image_, reason, {0.5 * (area.left + area.right), 0.5 * (area.top + area.bottom)},
              {layout_.text, Color(0.4f), TextAlignment::centre});
  }

  // A bar of a round length, at most 0.3 of the panel, white on black edges.
  void draw_scale_bar(int column, int line, double panel_width, const std::string& unit) {
    const double length = round_length(0.3 * panel_width);
    const std::string label = short_number(length) + " " + (length == 1.0 ? singular(unit) : unit);
    const double text = layout_.text;
    const Rectangle area = frame(column, line);
    const double left = area.left + 1.2 * text;
    const double right = left + length / panel_width * layout_.panel;
    const double bottom = area.bottom - 1.2 * text;
    const double top = bottom - 0.25 * text;
    const int edge = std::max(1, static_cast<int>(0.2 * text));
    fill_rectangle(image_, {left - edge, top - edge, right + edge, bottom + edge}, Color(0.0f));
    fill_rectangle(image_, {left, top, right, bottom}, Color(1.0f));
    draw_text(image_, label, {left, top - 0.7 * text - 2.0 * edge},
              {.height = text, .color = Color(1.0f), .outline = edge});
  }

  void draw_spectrum(const SpectrumPlot& spectrum) {
    const double text = layout_.text;
    const double top = layout_.top + 2.0 * layout_.row;
    draw_text(image_, "Radial power spectrum", {layout_.margin, top + 1.2 * text}, {text, kInk});
    draw_text(image_, spectrum.caption, {layout_.width - layout_.margin, top + 1.2 * text},
              {text, kInk, TextAlignment::right});
    const Rectangle area{layout_.margin + 6.0 * text, top + 4.6 * text, layout_.width - layout_.margin,
                         top + layout_.plot - 5.2 * text};
    draw_line_plot(image_, area, make_plot(spectrum));
  }

  int panel_size() const { return layout_.panel; }
  const Image& image() const { return image_; }

 private:
  Rectangle frame(int column, int line) const {
    const double left = layout_.left(column);
    const double top = layout_.panel_top(line);
    return {left, top, left + layout_.panel, top + layout_.panel};
  }

  // Five decades below the peak; the closed form on top of the measured values.
  LinePlot make_plot(const SpectrumPlot& spectrum) const {
    LinePlot plot;
    plot.text_height = 0.9 * layout_.text;
    plot.x.label = fmt::format("frequency, cycles per {}", singular(options_.unit));
    plot.x.upper = spectrum.measured.back().upper;
    plot.y.label = fmt::format("power per (cycle per {})^n", singular(options_.unit));
    plot.y.scale = PlotAxis::Scale::logarithmic;
    PlotSeries measured{"measured, 2 standard errors", PlotSeries::Style::dots, kMeasured, {}, {}};
    PlotSeries expected{"closed form", PlotSeries::Style::line, kExpected, {}, {}};
    double highest = 0.0;
    for (std::size_t i = 0; i < spectrum.measured.size(); ++i) {
      const RadialBin& bin = spectrum.measured[i];
      measured.points.push_back({bin.frequency, bin.power});
      measured.errors.push_back(2.0 * bin.standard_error);
      highest = std::max(highest, bin.power);
      if (i >= spectrum.expected.size()) continue;
      expected.points.push_back({bin.frequency, spectrum.expected[i]});
      highest = std::max(highest, spectrum.expected[i]);
    }
    plot.y.upper = highest > 0.0 ? 3.0 * highest : 1.0;
    plot.y.lower = 1e-5 * plot.y.upper;
    if (!expected.points.empty()) plot.series.push_back(expected);
    plot.series.push_back(measured);
    return plot;
  }

  FourPanelOptions options_;
  Layout layout_;
  Image image_;
};

// The square that a panel shows of a field is as wide as this.
double shown_width(const DenseField<2>& field) {
  return std::min(field.count.x * field.step.x, field.count.y * field.step.y);
}

void draw_transform(FourPanels& panels, int column, const std::string& title, const DenseField<2>& magnitude,
                    double highest, const std::string& unit) {
  const DenseField<2> part = middle_part(magnitude, 2.0 * highest);
  panels.draw_panel(column, 1, title,
                    field_picture(part, panels.panel_size(), parse_color_ramp("viridis"), 0.0, 1.0));
  panels.draw_scale_bar(column, 1, shown_width(part), unit);
}

}  // namespace

SpectrumPlot::SpectrumPlot(const SpectrumComparison& comparison)
    : caption(fmt::format("chi-square {:.1f} for {} degrees of freedom, p = {:.2g}", comparison.chi_square,
                          comparison.degrees_of_freedom, comparison.significance)) {
  for (const ComparedBin& bin : comparison.bins) {
    measured.push_back(bin.measured);
    expected.push_back(bin.expected);
  }
}

Image draw_four_panels(const DenseField<2>& noise, const DenseField<2>& kernel,
                       const FourPanelOptions& options, const SpectrumPlot& spectrum) {
  for (int axis = 0; axis < 2; ++axis) require_at_least("noise slice", noise.count[axis], 8, "samples");
  require_in_range("picture width", options.width, 400, 4000, "pixels");

  double mean = 0.0;
  for (const float value : noise.values) mean += value / static_cast<double>(noise.values.size());
  double variance = 0.0;
  for (const float value : noise.values) {
    variance += (value - mean) * (value - mean) / static_cast<double>(noise.values.size());
  }
  const double reach = variance > 0.0 ? 2.5 * std::sqrt(variance) : 1.0;
  DenseField<2> centred = noise;
  for (float& value : centred.values) value -= static_cast<float>(mean);

  FourPanels panels(options, !spectrum.measured.empty());
  // Even steps to the eye, not in light: these stops are nearly linear as they are encoded.
  const ColorRamp even = parse_color_ramp("0:#000,0.25:#404040,0.5:#808080,0.75:#bfbfbf,1:#fff");
  const std::string per_unit = "cycles / " + singular(options.unit);
  const double nyquist = 0.5 / std::max(noise.step.x, noise.step.y);
  constexpr double kLowest = 1e-3;  // of a constant
  const double highest = std::clamp(1.3 * highest_frequency(noise, mean), kLowest * nyquist, nyquist);
  const DenseField<2> part = middle_part(centred, kShownWaves / highest);
  panels.draw_panel(0, 0, "Noise", field_picture(part, panels.panel_size(), even, -reach, reach));
  panels.draw_scale_bar(0, 0, shown_width(part), options.unit);
  draw_transform(panels, 0, "Fourier transform of the noise",
                 spectrum_magnitude(centred, SpectrumWindow::hann), highest, per_unit);

  if (kernel.values.empty()) {
    panels.draw_empty_panel(1, 0, "Kernel", "no kernel");
    panels.draw_empty_panel(1, 1, "Fourier transform of the kernel", "no kernel");
  } else {
    float largest = 0.0f;
    for (const float value : kernel.values) largest = std::max(largest, std::abs(value));
    const double limit = largest > 0.0f ? largest : 1.0;
    panels.draw_panel(1, 0, "Kernel", field_picture(kernel, panels.panel_size(), even, -limit, limit));
    panels.draw_scale_bar(1, 0, shown_width(kernel), options.unit);
    // Padding makes the frequencies some 200 to a panel, so that they are interpolated smoothly.
    const int padded = std::clamp(static_cast<int>(200.0 / (2.0 * highest * kernel.step.x)), 1, 2048);
    draw_transform(panels, 1, "Fourier transform of the kernel",
                   spectrum_magnitude(kernel, SpectrumWindow::none, padded), highest, per_unit);
  }
  if (!spectrum.measured.empty()) panels.draw_spectrum(spectrum);
  return panels.image();
}

}  // namespace solidnoise
