#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "solidnoise/noise/noise.h"

namespace solidnoise::papers {

// What is measured of impulses in strata (src/solidnoise/noise/kernel/impulse_strata.h), over many seeds.

// A mean over batches of seeds, and its standard error.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};
Estimate estimate(const std::vector<double>& batches);

template <int Dim>
using MakeNoise = std::function<std::unique_ptr<const Noise<Dim>>(std::uint64_t seed)>;

// Values of an ensemble at some 4096 places, `spacing` world units apart along each axis, of each seed.
struct Ensemble {
  Estimate mean;
  Estimate variance;
  Estimate excess_kurtosis;
  Estimate beyond_3;  // share of the values that are farther than so many standard deviations from 0
  Estimate beyond_4;
};
template <int Dim>
Ensemble measure_ensemble(const MakeNoise<Dim>& make, double spacing, int seeds);

// The variance of the mean square over square windows, over that of a Gaussian field of the noise's
// covariance. Windows with sides of 1, 2, 4, ... 16 `radius` are cut of squares of 32, `seeds` of them.
struct WindowPower {
  double side = 0.0;  // radii
  Estimate spread;
};
std::vector<WindowPower> measure_windows(const MakeNoise<2>& make, double radius, int seeds);

}  // namespace solidnoise::papers
