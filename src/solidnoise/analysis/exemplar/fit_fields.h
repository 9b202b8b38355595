#pragma once

#include <type_traits>

#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/core/fields.h"

namespace solidnoise {

// The tables of what noise by example is fitted with.

constexpr auto fields_of(std::type_identity<ExemplarReading>) {
  using Reading = ExemplarReading;
  return list_fields(
      field("pixel_size", &Reading::pixel_size, between(1e-9, 1e9), "world units", "Side of a pixel"),
      field("raw_values", &Reading::raw_values, "Take values as they are stored, and not as linear light"));
}

constexpr auto fields_of(std::type_identity<SpectrumFitOptions>) {
  using Options = SpectrumFitOptions;
  constexpr Interval kShares{.least = 0.0, .most = 1.0, .without_least = true};
  return list_fields(
      field("kappa", &Options::kappa, kShares, "", "Fewer components against accuracy"),
      field("fill", &Options::fill, "Add the fine detail that a sparse spectrum leaves out"),
      field("gap", &Options::gap_tolerance, kShares, "", "Duality gap at which a solution is accepted"),
      field("narrowest_band", &Options::narrowest_band,
            "Components as narrow as one frequency, for periodic textures"));
}

inline constexpr Choices<ColorAxes, 3> kColorAxesChoices{
    {{ColorAxes::independent, "independent"}, {ColorAxes::pca, "pca"}, {ColorAxes::rgb, "rgb"}}};

constexpr auto fields_of(std::type_identity<ExemplarFitOptions>) {
  using Options = ExemplarFitOptions;
  return list_fields(
      field("axes", &Options::axes, kColorAxesChoices, "The channels of a coloured noise"),
      field("squares", &Options::squares,
            "Learn square roots, and square the noise: for pictures that are dark with bright parts"));
}

}  // namespace solidnoise
