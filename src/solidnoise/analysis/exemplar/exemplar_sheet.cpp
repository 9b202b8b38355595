#include "solidnoise/analysis/exemplar/exemplar_sheet.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/analysis/exemplar/square_colors.h"
#include "solidnoise/core/points.h"
#include "solidnoise/core/random.h"
#include "solidnoise/image/color.h"
#include "solidnoise/image/drawing.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise_views.h"

namespace solidnoise {
namespace {

constexpr int kStrip = 128;  // columns that are evaluated together

// A noise in a plane, and where its lattice begins.
struct NoisePlane {
  std::shared_ptr<const Noise<2>> noise;
  Vec<2> origin;
};

// The plane z = origin.z.
template <int Dim>
NoisePlane plane_of(const SpectrumNoiseOptions& options, const Vec<3>& origin) {
  auto noise = std::make_shared<const SpectrumNoise<Dim>>(with_truncation_share(options));
  if constexpr (Dim == 2) {
    return {noise, Vec<2>(origin)};
  } else {
    return {on_plane(noise, {.origin = origin}), Vec<2>(0.0)};
  }
}

DenseField<2> evaluate(const SpectrumNoiseOptions& options, const glm::ivec2& count, const Vec<2>& step,
                       const Vec<3>& origin, Progress& progress) {
  const bool flat = options.model.channels[static_cast<std::size_t>(options.channel)].dimensions == 2;
  const NoisePlane plane = flat ? plane_of<2>(options, origin) : plane_of<3>(options, origin);
  const auto interpolated =
      interpolate<2>(plane.noise, {plane.origin, step}, ErrorBudget(options.error).interpolation);
  DenseField<2> field(count, step);
  const int strips = (count.x + kStrip - 1) / kStrip;
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for(0, strips, [&](int strip) {
    throw_if_cancelled(&progress);
    const int begin = strip * kStrip;
    const Lattice<2> lattice{plane.origin, step, {begin, 0}, {std::min(kStrip, count.x - begin), count.y}};
    const std::size_t offset = static_cast<std::size_t>(begin) * static_cast<std::size_t>(count.y);
    const std::span<float> values(field.values.data() + offset, lattice.size());
    interpolated->block(lattice.bounds())->evaluate(lattice, Samples<2>{values, {}});
    progress.advance(++done, static_cast<std::uint64_t>(strips));
  });
  return field;
}

}  // namespace

Exemplar<2> procedural_texture(const ExemplarModel& model, const glm::ivec2& count, const Vec<2>& step,
                               const Vec<3>& origin, std::uint64_t seed, Progress* progress) {
  const auto share = 1.0 / static_cast<double>(model.channels.size());
  std::vector<DenseField<2>> channels;
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    SpectrumNoiseOptions options;
    options.model = model;
    options.channel = static_cast<int>(k);
    options.frequency = model.principal_frequency();  // as in the exemplar
    options.seed = derive_seed(seed, k);
    PartialProgress part(progress, share * static_cast<double>(k), share * static_cast<double>(k + 1));
    channels.push_back(evaluate(options, count, step, origin, part));
    const auto deviation = static_cast<float>(std::sqrt(model.channels[k].variance()));
    for (float& value : channels.back().values) value *= deviation;
  }
  return compose(model, channels);
}

namespace {

constexpr int kEnlargeBelow = 200;
constexpr int kMargin = 12;
constexpr int kTextLine = 26;
constexpr double kDecades = 4.0;  // of power, from black to white
// Of linear light: what an eye sees as brightness.
constexpr std::array kLuminance{0.2126, 0.7152, 0.0722};

struct Panel {
  std::string name;
  Exemplar<2> texture;
  PowerSpectrum<2> spectrum;
};

Exemplar<2> cut(const Exemplar<2>& exemplar, const glm::ivec2& count) {
  Exemplar<2> result;
  for (const DenseField<2>& channel : exemplar.channels) {
    DenseField<2>& field = result.channels.emplace_back(count, channel.step);
    const ArrayShape<2> from{channel.count};
    const ArrayShape<2> to{count};
    for (std::size_t i = 0; i < field.size(); ++i) {
      field.values[i] = channel.values[from.index(to.position(i))];
    }
  }
  return result;
}

PowerSpectrum<2> brightness_spectrum(const Exemplar<2>& texture) {
  const CrossSpectra<2> spectra = cross_spectra<2>(std::vector{texture});
  if (spectra.channels == 1) return spectra.spectrum(std::array{1.0});
  return spectra.spectrum(kLuminance);
}

// Of the sparse spectra themselves.
PowerSpectrum<2> brightness_density(const ExemplarModel& model, const PowerSpectrum<2>& like) {
  PowerSpectrum<2> sum = like;
  std::fill(sum.density.begin(), sum.density.end(), 0.0);
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    double along = 0.0;
    for (int c = 0; c < 3; ++c) along += model.axes[k][c] * kLuminance[static_cast<std::size_t>(c)];
    const PowerSpectrum<2> channel = sampled_density<2>(model.channels[k], like.count, like.step);
    for (std::size_t i = 0; i < sum.density.size(); ++i) sum.density[i] += along * along * channel.density[i];
  }
  return sum;
}

// The density below which all but a thousandth of the frequencies lie.
double bright_density(std::vector<double> density) {
  const auto at = density.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(density.size()));
  std::nth_element(density.begin(), at, density.end());
  return *at;
}

Image draw_spectrum(const PowerSpectrum<2>& spectrum, double white, int size) {
  Image image(size, size, 3);
  const glm::ivec2 n = spectrum.count;
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y < size; ++y) {
      const int kx = static_cast<int>(std::floor((x + 0.5) / size * n.x)) - n.x / 2;
      const int ky = static_cast<int>(std::floor((y + 0.5) / size * n.y)) - n.y / 2;
      const std::size_t index = ArrayShape<2>{n}.index({(kx + n.x) % n.x, (ky + n.y) % n.y});
      const double level = 1.0 + std::log10(std::max(1e-30, spectrum.density[index] / white)) / kDecades;
      for (int c = 0; c < 3; ++c) {
        image.at(x, size - 1 - y, c) = static_cast<float>(std::clamp(level, 0.0, 1.0));
      }
    }
  }
  return image;
}

// The texture as it is seen, each pixel as `zoom` x `zoom`.
Image draw_texture(const Exemplar<2>& texture, bool raw_values, const ExemplarSheetOptions& options,
                   int zoom) {
  const Image pixels = image_of_exemplar(texture);
  Image image(pixels.width * zoom, pixels.height * zoom, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double level =
            (pixels.at(x / zoom, y / zoom, c) - options.black) / (options.white - options.black);
        const auto value = static_cast<float>(std::clamp(level, 0.0, 1.0));
        image.at(x, y, c) = raw_values ? value : srgb_from_linear(value);
      }
    }
  }
  return image;
}

std::vector<Panel> make_panels(const Exemplar<2>& exemplar, const ExemplarModel& model, std::uint64_t seed,
                               Progress* progress) {
  const glm::ivec2 count = exemplar.shape().count;
  const Vec<2> step = exemplar.shape().step;
  const Vec<3> origin(0.0);
  const bool planar = model.channels.front().dimensions == 2;
  std::vector<Panel> panels;
  panels.push_back({"exemplar", exemplar, {}});
  panels.push_back({"Gaussian version",
                    model.squares ? squared_version(exemplar, seed) : gaussian_version(exemplar, seed),
                    {}});
  const double middle = planar ? 0.0 : 0.5;  // of the work: a second texture of a solid noise is as much
  PartialProgress first(progress, 0.0, middle);
  PartialProgress last(progress, middle, 1.0);
  throw_if_cancelled(progress);
  if (planar) {
    panels.push_back({"sparse spectrum", gaussian_texture(model, count, step, seed), {}});
    panels.push_back({"procedural noise", procedural_texture(model, count, step, origin, seed, &last), {}});
  } else {
    panels.push_back(
        {"solid noise, a slice", procedural_texture(model, count, step, origin, seed, &first), {}});
    const Vec<3> far(0.0, 0.0, 1000.0 * step.x);
    panels.push_back({"solid noise, another", procedural_texture(model, count, step, far, seed, &last), {}});
  }
  for (Panel& panel : panels) panel.spectrum = brightness_spectrum(panel.texture);
  if (planar && !model.squares) panels[2].spectrum = brightness_density(model, panels[2].spectrum);
  return panels;
}

}  // namespace

Image draw_exemplar_sheet(const Exemplar<2>& whole, const ExemplarModel& model,
                          const ExemplarSheetOptions& options, Progress* progress) {
  const glm::ivec2 count = glm::ivec2(std::min(kLargestShown, whole.shape().count.x),
                                      std::min(kLargestShown, whole.shape().count.y));
  const Exemplar<2> exemplar = cut(whole, count);
  const std::vector<Panel> panels = make_panels(exemplar, model, options.seed, progress);
  const int zoom = std::max(1, (kEnlargeBelow + std::max(count.x, count.y) - 1) / std::max(count.x, count.y));
  const int width = zoom * count.x;
  const int height = zoom * count.y;
  const int top = options.title.empty() ? kMargin : kMargin + kTextLine;

  Image sheet(kMargin + 4 * (width + kMargin),
              top + height + kTextLine + (options.caption.empty() ? 0 : kTextLine), 3);
  fill_rectangle(sheet, {0.0, 0.0, double(sheet.width), double(sheet.height)}, Color(1.0f));
  const TextStyle title{.height = 14.0};
  const TextStyle small{.height = 10.0, .color = Color(0.25f)};
  draw_text(sheet, options.title, {kMargin, kMargin + 15.0}, title);
  const double white = bright_density(panels[0].spectrum.density);
  const int inset = std::max(48, std::min(width, height) / 3);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const int left = kMargin + static_cast<int>(i) * (width + kMargin);
    paste(sheet, draw_texture(panels[i].texture, model.raw_values, options, zoom), left, top);
    const int x = left + width - inset;
    const int y = top + height - inset;
    paste(sheet, draw_spectrum(panels[i].spectrum, white, inset), x, y);
    draw_frame(sheet, {double(x), double(y), double(x + inset), double(y + inset)}, Color(1.0f));
    draw_text(sheet, panels[i].name, {double(left), top + height + 17.0}, small);
  }
  draw_text(sheet, options.caption, {kMargin, top + height + kTextLine + 15.0}, small);
  return sheet;
}

}  // namespace solidnoise
