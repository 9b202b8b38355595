#pragma once

#include <type_traits>

#include "solidnoise/core/fields.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/field/shaping.h"

namespace solidnoise {

// The tables of what fields are made of, and their words.

inline constexpr Choices<RawShaping::Range, 3> kRangeChoices{{
    {RawShaping::Range::signed_values, "signed"},
    {RawShaping::Range::unit, "unit"},
    {RawShaping::Range::raw, "raw"},
}};

inline constexpr Choices<RemapShaping::Fold, 3> kFoldChoices{{
    {RemapShaping::Fold::none, "none"},
    {RemapShaping::Fold::ridged, "ridged"},
    {RemapShaping::Fold::billow, "billow"},
}};

inline constexpr Choices<Layer::Fold, 5> kLayerFoldChoices{{
    {Layer::Fold::none, "none"},
    {Layer::Fold::ridged, "ridged"},
    {Layer::Fold::billow, "billow"},
    {Layer::Fold::turbulence, "turbulence"},
    {Layer::Fold::crest, "crest"},
}};

inline constexpr Choices<Layer::Histogram, 2> kHistogramChoices{{
    {Layer::Histogram::gaussian, "gaussian"},
    {Layer::Histogram::uniform, "uniform"},
}};

inline constexpr Choices<Layer::Combine, 5> kLayerCombineChoices{{
    {Layer::Combine::sum, "sum"},
    {Layer::Combine::product, "product"},
    {Layer::Combine::max, "max"},
    {Layer::Combine::min, "min"},
    {Layer::Combine::mix, "mix"},
}};

inline constexpr Choices<Layer::Place, 8> kPlaceChoices{{
    {Layer::Place::none, "none"},
    {Layer::Place::x, "x"},
    {Layer::Place::y, "y"},
    {Layer::Place::z, "z"},
    {Layer::Place::height, "height"},
    {Layer::Place::radius, "radius"},
    {Layer::Place::distance, "distance"},
    {Layer::Place::weight, "weight"},
}};

constexpr auto fields_of(std::type_identity<RawShaping>) {
  return list_fields(
      field("range", &RawShaping::range, kRangeChoices, "Values as they are, or 3 sigma to -1..1 or to 0..1"),
      field("normalize", &RawShaping::normalize,
            "Mean 0 and variance 1 in the box itself, or in a period, not on average over seeds"));
}

constexpr auto fields_of(std::type_identity<RemapShaping>) {
  using Look = RemapShaping;
  return list_fields(
      field("fold", &Look::fold, kFoldChoices, "The noise n, -|n| or |n|"),
      field("threshold", &Look::threshold, kFinite, "sigmas", "Where the density begins"),
      field("softness", &Look::softness, kPositive, "sigmas", "Over which it rises to its full value"),
      field("power", &Look::power, kPositive, "", "Contrast"),
      field("edge", &Look::edge, at_least(0.0), "sigmas",
            "Rise of the threshold from the box's centre to its sides"),
      field("floor", &Look::floor, between(0.0, 1.0), "", "Density where there would be none"));
}

constexpr auto fields_of(std::type_identity<VeinShaping>) {
  using Look = VeinShaping;
  return list_fields(
      field("direction", &Look::direction, kFinite, "", "Across the veins"),
      field("spacing", &Look::spacing, kPositive, "world units", "From vein to vein"),
      field("turbulence", &Look::turbulence, at_least(0.0), "spacings", "Shift by one sigma of the noise"),
      field("sharpness", &Look::sharpness, kPositive, "",
            "Above 1 thin dense veins, below 1 thin gaps in a dense body"),
      field("floor", &Look::floor, between(0.0, 1.0), "", "Density between veins"));
}

constexpr auto fields_of(std::type_identity<CloudShaping>) {
  using Look = CloudShaping;
  return list_fields(
      field("puffs", &Look::puffs, between(1, 1000), "", "Large puffs that the cloud is piled from"),
      field("lobes", &Look::lobes, between(0.0, 2.0), "wavelengths", "Depth of the first octave's lobes"),
      field("base", &Look::base, between(0.0, 1.0), "",
            "Part of the lobes' depth that is left at the flat base"),
      field("edge", &Look::edge, kPositive, "wavelengths", "Width of the soft edge"),
      field("wisps", &Look::wisps, between(0.0, 4.0), "edge widths", "How far thin edges are eroded"),
      field("core", &Look::core, between(0.0, 1.0), "", "Part of the density that comes with depth"),
      field("lean", &Look::lean, between(0.0, 2.0), "",
            "Sideways shift of the top over its height, towards a random direction"));
}

constexpr auto fields_of(std::type_identity<Warp>) {
  return list_fields(field("amount", &Warp::amount, between(0.0, 1e9), "world units",
                           "Standard deviation of each component of the displacement"),
                     field("noise", &Warp::noise, "Left out, the recipe's"));
}

constexpr auto fields_of(std::type_identity<Layer>) {
  constexpr auto is_noise = [](const Layer& layer) {
    return layer.layers.empty() && layer.use.empty() && layer.place == Layer::Place::none;
  };
  constexpr auto combines = [](const Layer& layer) { return !layer.layers.empty(); };
  return list_fields(
      field("noise", &Layer::noise, "Left out, the recipe's").written_if(is_noise),
      field("fold", &Layer::fold, kLayerFoldChoices,
            "The noise's octaves |n| turned to ridges, or added up as turbulence; billow: |noise|; mean 0, "
            "variance 1; crest: waves from -1 to 1, all of the same height")
          .written_if(is_noise),
      field("histogram", &Layer::histogram, kHistogramChoices,
            "Values as they are, or uniform on 0 to 1 by the error function")
          .written_if(is_noise),
      field("stretch", &Layer::stretch, kPositive, "",
            "How much longer the noise's features are along each axis")
          .written_if([](const Layer& layer) { return layer.stretch != Vec<3>(1.0); }),
      field("turn", &Layer::turn, between(-360.0, 360.0), "degrees",
            "Of a surface's oriented noise: how far its waves turn in the tangent plane")
          .written_if([](const Layer& layer) { return layer.turn != 0.0; }),
      field("use", &Layer::use, "In place of a noise: a field that the recipe has a name for")
          .written_if([](const Layer& layer) { return !layer.use.empty(); }),
      field("place", &Layer::place, kPlaceChoices,
            "In place of a noise: where it is in the box; weight: of what steers a surface, 0 to 1")
          .written_if([](const Layer& layer) { return layer.place != Layer::Place::none; }),
      field("combine", &Layer::combine, kLayerCombineChoices, "What becomes of the layers")
          .written_if(combines),
      field("layers", &Layer::layers, "In place of a noise").written_if(combines),
      field("ramp", &Layer::ramp, "Pairs of a value and what it becomes, values increasing")
          .written_if([](const Layer& layer) { return !layer.ramp.empty(); }),
      field("weight", &Layer::weight, kFinite, "", "What the value is multiplied by"),
      field("bias", &Layer::bias, kFinite, "", "What is added to it then"),
      field("warp", &Layer::warp, "Where the layer is looked up instead"));
}

}  // namespace solidnoise
