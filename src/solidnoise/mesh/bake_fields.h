#pragma once

#include <array>
#include <type_traits>

#include "solidnoise/core/fields.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/mesh/texture_plan.h"
#include "solidnoise/mesh/vertex_colors.h"
#include "solidnoise/noise/gabor/gabor_entries.h"
#include "solidnoise/noise/noise_entry.h"

namespace solidnoise {

// The tables of a bake's recipe, and its words.

inline constexpr Choices<SurfaceNoiseKind, 6> kSurfaceNoiseChoices{{
    {SurfaceNoiseKind::surface, "surface"},
    {SurfaceNoiseKind::oriented, "oriented"},
    {SurfaceNoiseKind::solid, "solid"},
    {SurfaceNoiseKind::kensler, "kensler"},
    {SurfaceNoiseKind::kensler_solid, "kensler-solid"},
    {SurfaceNoiseKind::spectrum, "spectrum"},
}};

// An attribute is given by its name instead.
inline constexpr Choices<SteeringSource, 5> kSteeringChoices{{
    {SteeringSource::mean_curvature, "mean-curvature"},
    {SteeringSource::gaussian_curvature, "gaussian-curvature"},
    {SteeringSource::max_curvature, "max-curvature"},
    {SteeringSource::abs_curvature, "abs-curvature"},
    {SteeringSource::height, "height"},
}};

inline constexpr Choices<DirectionRecipe::Source, 3> kDirectionChoices{{
    {DirectionRecipe::Source::axis, "axis"},
    {DirectionRecipe::Source::max_curvature, "max-curvature"},
    {DirectionRecipe::Source::min_curvature, "min-curvature"},
}};

inline constexpr Choices<LayerUnit, 2> kLayerUnitChoices{{
    {LayerUnit::world, "world"},
    {LayerUnit::feature, "feature"},
}};

inline constexpr Choices<RefineRecipe::Mode, 3> kRefineChoices{{
    {RefineRecipe::Mode::off, "off"},
    {RefineRecipe::Mode::automatic, "auto"},
    {RefineRecipe::Mode::rounds, "rounds"},
}};
inline constexpr Choices<RefineOptions::Method, 4> kRefineMethodChoices{{
    {RefineOptions::Method::own, "own"},
    {RefineOptions::Method::longest_edge, "longest-edge"},
    {RefineOptions::Method::sqrt3, "sqrt3"},
    {RefineOptions::Method::loop, "loop"},
}};
inline constexpr Choices<RefineOptions::Placement, 2> kPlacementChoices{{
    {RefineOptions::Placement::on_edges, "edges"},
    {RefineOptions::Placement::smooth, "smooth"},
}};

template <typename Visit>
void for_each_number(const ParameterRange& range, const Visit& visit) {
  visit(range.from);
  visit(range.to);
}

constexpr auto fields_of(std::type_identity<SurfaceNoiseRecipe>) {
  using Recipe = SurfaceNoiseRecipe;
  constexpr auto is_by_example = [](const Recipe& recipe) {
    return recipe.kind == SurfaceNoiseKind::spectrum;
  };
  constexpr auto changes = [](const Recipe& recipe) {
    return recipe.dims == 4 || recipe.evolve > 0.0 || recipe.time != 0.0;
  };
  return list_fields(
      field("noise", &Recipe::kind, kSurfaceNoiseChoices,
            "surface: of the tangent plane; oriented: its waves follow a direction; solid: the field that "
            "volumes have; kensler, kensler-solid: gradient noise, projected or solid; spectrum: by example")
          .without_flag(),
      field("exemplar", &Recipe::exemplar, "Of spectrum: what noisefit wrote").written_if(is_by_example),
      field("channel", &Recipe::channel, at_least(0.0), "of the model",
            "Of spectrum: channel of the exemplar")
          .written_if(is_by_example)
          .without_flag(),
      fields_of_impulses<Recipe>(), field_of_kurtosis<Recipe>(),
      field("layer", &Recipe::layer, between(0.1, 1.0), "kernel radii",
            "surface, oriented: half the layer that impulses come from"),
      field("dims", &Recipe::dims, between(3, 4), "",
            "solid, kensler-solid: 4 for a slice of a noise of 4, which changes with time")
          .written_if(changes),
      field("time", &Recipe::time, kFinite, "units of time",
            "Of a noise that changes (evolve, 4 dimensions): the moment to bake")
          .written_if(changes),
      field("evolve", &Recipe::evolve, between(0.0, kMostTurns), "turns per unit of time",
            "All but kensler-solid: impulses, or gradients, turn at rates of this standard deviation; each "
            "frame has the noise's spectrum")
          .written_if(changes),
      field("loop", &Recipe::loop, at_least(0.0), "units of time; 0 for none",
            "Of a noise that changes: the time after which it repeats")
          .written_if(changes),
      field("seed", &Recipe::seed, "Another seed makes another noise"), part(&Recipe::fractal));
}

constexpr auto fields_of(std::type_identity<Steering>) {
  return list_fields(
      field("attribute", &Steering::attribute, "A number of the vertices, in place of a source")
          .written_if([](const Steering& by) { return by.source == SteeringSource::attribute; }),
      field("source", &Steering::source, kSteeringChoices, "What ranges follow")
          .written_if([](const Steering& by) { return by.source != SteeringSource::attribute; })
          .without_flag(),
      field("percentiles", std::array{&Steering::low_percentile, &Steering::high_percentile},
            between(0.0, 100.0), "",
            "Shares of the surface, percent, below which and above which a range is at its ends"),
      field("gamma", &Steering::gamma, kPositive, "", "Exponent of the weight between the ends"));
}

constexpr auto fields_of(std::type_identity<DirectionRecipe>) {
  using Recipe = DirectionRecipe;
  return list_fields(
      field("source", &Recipe::source, kDirectionChoices,
            "Waves travel along the axis, or along a principal curvature; photographs stand on it"),
      field("axis", &Recipe::axis, kFinite, "",
            "An axis, laid into the tangent plane: of waves, or up in a photograph; left out, the "
            "up axis"),
      field("smooth", &Recipe::smooth, between(0, 10000), "rounds",
            "Smoothing of a direction that follows the curvature"));
}

constexpr auto fields_of(std::type_identity<RefineRecipe>) {
  using Recipe = RefineRecipe;
  return list_fields(field("mode", &Recipe::mode, kRefineChoices,
                           "Split edges until the noise shows on the mesh, or so often"),
                     field("rounds", &Recipe::rounds, between(1, 8), "rounds", "Of splitting every edge"),
                     field("budget", &Recipe::budget, between(0, 50'000'000), "vertices",
                           "Of auto: most vertices; 0 for four times the mesh's, 200 000 at least and 4 "
                           "million at most"),
                     field("method", &Recipe::method, kRefineMethodChoices,
                           "How edges are split: by our own rule, or by a subdivider of OpenMesh"),
                     field("placement", &Recipe::placement, kPlacementChoices,
                           "New vertices lie on the edges, or on the smooth surface through their ends"));
}

template <typename Recipe>
constexpr auto fields_of_smoothing() {
  return list_fields(
      field("smooth", &Recipe::smooth, between(0, 10000), "rounds", "Smoothing of the curvature"),
      field("smooth_radius", &Recipe::smooth_radius, at_least(0.0), "world units",
            "Smoothing over a distance that does not depend on the mesh; of a bake, of the normals that the "
            "noise lies along, too; left out there, a feature's size"));
}

constexpr auto fields_of(std::type_identity<BakeRecipe>) {
  using Recipe = BakeRecipe;
  return list_fields(
      field("description", &Recipe::description, "For people; changes nothing")
          .written_if([](const Recipe& recipe) { return !recipe.description.empty(); }),
      field("surface", &Recipe::noise, "The noise"),
      field("layers", &Recipe::layers, "Their sum takes the noise's place")
          .written_if([](const Recipe& recipe) { return !recipe.layers.empty(); }),
      field("fields", &Recipe::fields, "Fields with names, for layers to use")
          .written_if([](const Recipe& recipe) { return !recipe.fields.empty(); }),
      field(
          "properties", &Recipe::properties,
          "Numbers that vertices get beside the noise, such as roughness and height: each a layer, which may "
          "use the field value, what is baked")
          .written_if([](const Recipe& recipe) { return !recipe.properties.empty(); }),
      field(
          "layer_unit", &Recipe::layer_unit, kLayerUnitChoices,
          "Of frequencies, periods and warps in layers: world units, or features, so that layers are as fine "
          "on meshes of any size")
          .written_if([](const Recipe& recipe) { return recipe.layer_unit != LayerUnit::world; })
          .without_flag(),
      field("frequency", &Recipe::frequency, between(1e-9, 1e9), "cycles per world unit",
            "Principal frequency; left out, one cycle per feature_size; a range follows what steers"),
      field("feature_size", &Recipe::feature_size, between(1e-9, 1e9), "world units",
            "Where frequency is left out: size of a feature; left out too, a 24th of the box's diagonal"),
      field("detail", &Recipe::detail, between(1e-3, 1e3), "",
            "Where frequency is left out: features per feature_size; a range follows what steers")
          .written_if([](const Recipe& recipe) { return !recipe.frequency; }),
      field("bandwidth", &Recipe::bandwidth, between(0.1, 4.0), "octaves",
            "Width of the band at half amplitude"),
      field("magnitude", &Recipe::magnitude, between(0.0, 1e6), "", "Standard deviation of the noise"),
      field("bias", &Recipe::bias, between(-1e6, 1e6), "", "Added to the noise, in standard deviations"),
      field("by", &Recipe::by, "What ranges follow"), fields_of_smoothing<Recipe>(),
      field("direction", &Recipe::direction, "Which way the waves of oriented noise travel"),
      field("ramp", &Recipe::ramp,
            "Colours: a name, stops such as 0:#000,1:#fff, or exemplar for those of a noise by example"),
      field("contrast", &Recipe::contrast, kPositive, "",
            "The ramp spans 2.5 over this in standard deviations to each side"),
      field("refine", &Recipe::refine, "How densely the mesh is sampled before baking"),
      field(
          "displace", &Recipe::displace, between(-1e12, 1e12), "world units",
          "Move vertices along their normals, by this for a value of 1, or a height of 1 where a recipe has "
          "that property"),
      field("up", &Recipe::up, kUpAxisChoices, "The up axis: of height, of directions, and of the preview"));
}

constexpr auto fields_of(std::type_identity<TextureOptions>) {
  return list_fields(
      field("uv_size", &TextureOptions::size, between(1, 32768), "texels", "Of each side of a texture"),
      field("uv_padding", &TextureOptions::padding, between(0, 1024), "texels",
            "By which textures continue beyond the edges of faces"));
}

constexpr auto fields_of(std::type_identity<CurvatureRecipe>) {
  using Recipe = CurvatureRecipe;
  return list_fields(fields_of_smoothing<Recipe>(),
                     field("ramp", &Recipe::ramp, "Colours: a name, or stops such as 0:#000,1:#fff"),
                     field("up", &Recipe::up, kUpAxisChoices, "The up axis"));
}

}  // namespace solidnoise
