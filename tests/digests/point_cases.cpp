#include <string>
#include <utility>
#include <vector>

#include "digests/cases.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/gabor/surface_spectrum_noise.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"
#include "support/scattered.h"
#include "support/spectra.h"

namespace solidnoise {
namespace {

constexpr std::size_t kPoints = 300;
constexpr double kSide = 4.0;

// The parameters that vary: none, some, all.
struct Variation {
  std::string name;
  bool frequency = false;
  bool bandwidth = false;
  bool magnitude = false;
  bool direction = false;

  template <int Dim>
  VaryingParameters<Dim> of(const Scattered<Dim>& scattered) const {
    VaryingParameters<Dim> parameters = scattered.parameters();
    if (!frequency) parameters.frequency = {};
    if (!bandwidth) parameters.bandwidth = {};
    if (!magnitude) parameters.magnitude = {};
    if (!direction) parameters.direction = {};
    return parameters;
  }
};
const std::vector<Variation> kVariations{
    {.name = "constant"},
    {.name = "frequency", .frequency = true},
    {.name = "bandwidth", .bandwidth = true},
    {.name = "magnitude and direction", .magnitude = true, .direction = true},
    {"all", true, true, true, true}};
const std::vector<std::pair<std::string, GaborWaves>> kWaves{{"isotropic", GaborWaves::isotropic},
                                                             {"oriented", GaborWaves::oriented}};

template <typename Evaluate>
DigestCase case_of(const std::string& name, const Evaluate& evaluate) {
  return {"points/" + name, [evaluate](Digest& digest) {
            std::vector<float> values(kPoints);
            evaluate(values);
            digest.add(std::span<const float>(values));
          }};
}

template <int Dim>
DigestCase varying_case(const std::string& name, const VaryingGaborOptions& options,
                        const Variation& variation) {
  return case_of("varying gabor/" + std::to_string(Dim) + "d/" + name, [=](std::vector<float>& values) {
    const Scattered<Dim> scattered = scattered_points<Dim>(kPoints, kSide);
    VaryingGaborNoise<Dim>(options).evaluate(scattered.points(), variation.of(scattered), {values, {}});
  });
}

DigestCase surface_case(const std::string& name, const SurfaceGaborOptions& options,
                        const Variation& variation) {
  return case_of("surface gabor/" + name, [=](std::vector<float>& values) {
    const Scattered<3> scattered = scattered_points<3>(kPoints, kSide);
    SurfaceGaborNoise(options).evaluate(scattered.surface(), variation.of(scattered), {values, {}});
  });
}

void add_gabor(DigestCases& cases) {
  for (const auto& [name, waves] : kWaves) {
    VaryingGaborOptions options{.frequency = 1.0, .impulses = 12.0, .waves = waves, .seed = 21};
    options.direction = {0.6, -0.3, 1.0, 0.7};
    SurfaceGaborOptions surface{.frequency = 1.0, .waves = waves, .seed = 22};
    surface.direction = {0.6, -0.3, 1.0};
    for (const Variation& variation : kVariations) {
      const std::string both = name + "/" + variation.name;
      cases.push_back(varying_case<3>(both, options, variation));
      cases.push_back(varying_case<4>(both, options, variation));
      cases.push_back(surface_case(both, surface, variation));
    }
    cases.push_back(case_of("surface gabor/" + name + "/thin layer", [=](std::vector<float>& values) {
      SurfaceGaborOptions thin = surface;
      thin.layer = 0.2;
      SurfaceGaborNoise(thin).evaluate(scattered_points<3>(kPoints, kSide).surface(), {}, {values, {}});
    }));
  }
}

void add_projected(DigestCases& cases) {
  cases.push_back(case_of("projected kensler/full", [](std::vector<float>& values) {
    ProjectedGradientNoise({.frequency = 1.0, .seed = 23})
        .evaluate(scattered_points<3>(kPoints, kSide).surface(), {values, {}});
  }));
}

void add_spectrum(DigestCases& cases) {
  for (const bool isotropic : {false, true}) {
    const std::string name = isotropic ? "isotropic" : "anisotropic";
    cases.push_back(case_of("surface spectrum/" + name, [isotropic](std::vector<float>& values) {
      const Scattered<3> scattered = scattered_points<3>(kPoints, kSide);
      const SurfaceSpectrumNoise noise(some_spectrum(2, isotropic), 0.5);
      noise.evaluate(scattered.surface(), scattered.parameters().direction, {values, {}});
    }));
  }
}

}  // namespace

DigestCases point_cases() {
  DigestCases cases;
  add_gabor(cases);
  add_projected(cases);
  add_spectrum(cases);
  return cases;
}

}  // namespace solidnoise
