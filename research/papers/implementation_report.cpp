#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "papers/data_file.h"
#include "papers/items.h"
#include "papers/paper_kernel.h"
#include "papers/square.h"
#include "papers/stopwatch.h"
#include "reference/gabor_reference.h"
#include "solidnoise/analysis/expected_spectrum.h"
#include "solidnoise/analysis/four_panel.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"

namespace solidnoise::papers {
namespace {

constexpr int kKernelSide = 129;  // samples of the picture of a kernel

namespace fs = std::filesystem;

OrientedGaborNoiseOptions oriented_options(double anisotropy) {
  OrientedGaborNoiseOptions options;
  options.frequency = kFrequency;
  options.impulses_process = ImpulseSpread::poisson;  // as the report's
  options.anisotropy = anisotropy;
  options.direction = {std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0};
  return options;
}

GaborNoiseOptions isotropic_options() {
  GaborNoiseOptions options;
  options.frequency = kFrequency;
  options.impulses_process = ImpulseSpread::poisson;  // as the report's
  return options;
}

DenseField<2> sample(const Noise<2>& noise, int side) {
  DenseField<2> field({side, side}, Vec<2>(1.0));
  noise.evaluate(Lattice<2>{.count = field.count}, {.values = field.values});
  return field;
}

void draw(const fs::path& path, const std::string& title, const Noise<2>& noise,
          const DenseField<2>& kernel) {
  write_image(path,
              draw_four_panels(sample(noise, 512), kernel, {.title = title, .unit = "pixels", .width = 640}),
              {.existing = Existing::replace});
}

// The three noises, each with its kernel and the transforms of both.
void write_panels(const fs::path& folder) {
  for (const double anisotropy : {1.0, 0.0}) {
    const OrientedGaborNoise<2> noise(oriented_options(anisotropy));
    const CompactKernel& envelope = noise.envelope();
    const Vec<2>& wave = noise.kernel().frequency();
    const auto kernel = [&](double x, double y) {
      return envelope.value(std::abs(x)) * envelope.value(std::abs(y)) *
             std::cos(2.0 * std::numbers::pi * (wave.x * x + wave.y * y));
    };
    const bool along = anisotropy == 1.0;
    draw(folder / (along ? "report_anisotropic.png" : "report_isotropic.png"),
         along ? "anisotropic noise" : "isotropic noise, anisotropic kernel", noise,
         sample_square(kKernelSide, envelope.radius(), kernel));
  }
  const GaborNoise<2> noise(isotropic_options());
  const CompactKernel& kernel = noise.compact_kernel();
  draw(folder / "report_isotropic_kernel.png", "isotropic noise, isotropic kernel", noise,
       sample_square(kKernelSide, noise.radius(),
                     [&](double x, double y) { return kernel.value(std::hypot(x, y)); }));
}

// The cells of the report are as wide as the radius where the Gaussian is at 5 %, so many impulses in each.
double impulses_in_disc(int per_cell, double radius) {
  const double cell = std::sqrt(std::log(20.0) / std::numbers::pi) / kGaussian;
  return std::numbers::pi * radius * radius / (cell * cell) * per_cell;
}

double seconds_of(const Noise<2>& noise, int side) {
  return quickest(10, [&] { sample(noise, side); });
}

// In double precision: the papers' way to draw a Poisson number multiplies until exp(-mean), which single
// precision does not hold for means above 87.
template <template <int, typename> class Kernel>
double seconds_of_procedure(int per_cell, int side) {
  const double cell = std::sqrt(std::log(20.0) / std::numbers::pi) / kGaussian;
  const reference::GaborProcedure<2, Kernel> noise({kFrequency, kGaussian}, cell,
                                                   impulses_in_disc(per_cell, cell), 1);
  // A part of the picture, as its cost per point is that of all; the rest would take minutes.
  constexpr int kRows = 16;
  volatile double sink = 0.0;
  const double seconds = quickest(1, [&] {
    double sum = 0.0;
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < side; ++x)
        sum += noise({static_cast<double>(x), static_cast<double>(y * side / kRows)});
    }
    sink = sum;
  });
  return seconds * side / kRows;
}

// Table I, one thread.
void write_report_speed(const fs::path& folder) {
  Table table{{"side", "impulses", "anisotropic", "isotropic", "isotropic_kernel", "procedure_isotropic",
               "procedure_isotropic_kernel"},
              {}};
  for (const int side : {256, 512}) {
    for (const int per_cell : {64, 128, 256}) {
      OrientedGaborNoiseOptions along = oriented_options(1.0);
      OrientedGaborNoiseOptions all = oriented_options(0.0);
      GaborNoiseOptions isotropic = isotropic_options();
      along.impulses =
          impulses_in_disc(per_cell, OrientedGaborNoise<2>(along).kernel().radius_for_error(kNominalError));
      all.impulses =
          impulses_in_disc(per_cell, OrientedGaborNoise<2>(all).kernel().radius_for_error(kNominalError));
      isotropic.impulses =
          impulses_in_disc(per_cell, GaborNoise<2>(isotropic).kernel().radius_for_error(kNominalError));
      table.rows.push_back({static_cast<double>(side), static_cast<double>(per_cell),
                            seconds_of(OrientedGaborNoise<2>(along), side),
                            seconds_of(OrientedGaborNoise<2>(all), side),
                            seconds_of(GaborNoise<2>(isotropic), side),
                            seconds_of_procedure<reference::OrientedKernel>(per_cell, side),
                            seconds_of_procedure<reference::IsotropicKernel>(per_cell, side)});
    }
  }
  write_table(folder / "report_speed.csv", table);
}

}  // namespace

Items implementation_report_items() {
  return {{"report", write_panels}, {"report_speed", write_report_speed}};
}

}  // namespace solidnoise::papers
