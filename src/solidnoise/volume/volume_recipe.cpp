#include "solidnoise/volume/volume_recipe.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solidnoise/core/named_error.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

bool contains(const std::vector<Output>& outputs, Output output) {
  return std::find(outputs.begin(), outputs.end(), output) != outputs.end();
}

void validate_output(const VolumeRecipe& recipe) {
  validate_outputs(recipe.output);
  const std::string output = format_outputs(recipe.output);
  if (recipe.output.size() > 1 && !recipe.grid.empty()) {
    throw std::invalid_argument(fmt::format("output is {}; a grid that has a name, {}, has one output",
                                            output, printable(recipe.grid)));
  }
  if (!is_scalar(recipe)) {
    if (recipe.modification) {
      throw std::invalid_argument(
          fmt::format("output is {}; it must be value where a grid that exists is worked on", output));
    }
    if (!recipe.layers.empty()) {
      throw std::invalid_argument(fmt::format("output is {}; layers have their value only", output));
    }
    const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
    if (!raw) {
      throw std::invalid_argument(
          fmt::format("output is {}; shaped noise has its value only: it must be raw", output));
    }
    if (raw->range != RawShaping::Range::raw && !contains(recipe.output, Output::color)) {
      throw std::invalid_argument(fmt::format("output is {}; the range must be raw", output));
    }
  }
  if (contains(recipe.output, Output::phase) || contains(recipe.output, Output::intensity)) {
    require_phase(recipe.noise);
  }
  if (!contains(recipe.output, Output::curl)) {
    if (recipe.drift != Vec<3>(0.0)) throw std::invalid_argument("drift applies to output curl only");
    if (recipe.speed != 1.0) {
      throw std::invalid_argument(fmt::format("speed is {}; it applies to output curl only", recipe.speed));
    }
    if (recipe.boundary) throw std::invalid_argument("boundary applies to output curl only");
  }
  if (recipe.boundary_width && !recipe.boundary) {
    throw std::invalid_argument("boundary_width applies to a boundary only");
  }
  if (!recipe.boundary) return;
  recipe.boundary->validate();
  if (recipe.drift != Vec<3>(0.0)) {
    throw std::invalid_argument("drift does not go with a boundary, through which it would flow");
  }
}

void validate_finish(const VolumeRecipe& recipe) {
  if (recipe.within && recipe.modification) {
    throw std::invalid_argument("within has no effect where a grid that exists is worked on");
  }
  if (recipe.sparse && recipe.modification) {
    throw std::invalid_argument("sparse has no effect where a grid that exists is worked on");
  }
  const bool raw = std::holds_alternative<RawShaping>(recipe.shaping);
  if (recipe.prune != 0.0 && (raw || recipe.modification)) {
    throw std::invalid_argument("prune applies to densities that are made, not to raw noise");
  }
  if (recipe.output.size() > 1 && recipe.within) {
    throw std::invalid_argument("within goes with a single output");
  }
}

// What moves would flicker, for each frame has moments of its own.
void validate_normalize(const VolumeRecipe& recipe) {
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  if (!raw || !raw->normalize) return;
  const bool of_values = is_scalar(recipe) || recipe.output == std::vector{Output::color};
  if (!of_values || !recipe.layers.empty() || recipe.parameters.any()) {
    throw std::invalid_argument(
        "normalize is true; it applies to the values or colours of a noise, without layers and parameters "
        "that vary");
  }
  if (recipe.dims == 4 || evolves(recipe) || recipe.wind != Vec<3>(0.0)) {
    throw std::invalid_argument("normalize is true; it applies to noise that does not move");
  }
}

// Whether a layer of the recipe's noise is stretched.
bool stretch_own_noise(const std::vector<Layer>& layers) {
  return std::ranges::any_of(layers, [](const Layer& layer) {
    return (!layer.noise && layer.stretch != Vec<3>(1.0)) || stretch_own_noise(layer.layers);
  });
}

// Kernels vary in the layers that name no noise.
void validate_layers_of_varying(const VolumeRecipe& recipe, std::string_view field) {
  if (!use_own_noise(recipe.layers, recipe.fields)) {
    throw std::invalid_argument(
        fmt::format("{} is of the recipe's noise; all layers have noises of their own", field));
  }
  bool stretched = stretch_own_noise(recipe.layers);
  for (const auto& [name, layer] : recipe.fields) stretched = stretched || stretch_own_noise({layer});
  if (stretched) {
    throw std::invalid_argument(
        fmt::format("{} does not go with layers that stretch the recipe's noise", field));
  }
}

void validate_parameters(const VolumeRecipe& recipe) {
  const ParameterGrids& parameters = recipe.parameters;
  if (!parameters.any()) return;
  parameters.validate(recipe.noise);
  const std::string_view field = parameters.first_field();
  if (!recipe.layers.empty() && parameters.vary_kernel()) validate_layers_of_varying(recipe, field);
  if (!is_scalar(recipe)) {
    throw std::invalid_argument(
        fmt::format("{} goes with output value only; output is {}", field, format_outputs(recipe.output)));
  }
  if (recipe.modification && recipe.modification->rest) {
    throw std::invalid_argument(
        fmt::format("{} does not go with rest: its grid lies in the world, and the noise elsewhere", field));
  }
}

// A grid at `path`, and what of the recipe has to go with it. `own` is the path of the grid's noise.
void validate_grid(const VolumeRecipe& recipe, const std::string& path, const std::string& own = "noise") {
  validate_parameters(recipe);
  validate_normalize(recipe);
  if (recipe.band_limit && !may_band_limit(recipe)) {
    throw std::invalid_argument(
        "band_limit is true; it must be false where dims is 4, for gradient noise (kensler), with layers and "
        "where frequency, bandwidth or direction are from a grid");
  }
  require_fields(static_cast<const GridRecipe&>(recipe), path);
  const LayerScope scope{recipe.noise, recipe.fields, LayerSpace::volume, own};
  validate_layers(recipe.layers, scope, path + "layers");
  if (recipe.within) validate_layer(*recipe.within, scope, path + "within");
  in_field(path, [&] {
    std::visit([](const auto& shaped) { shaped.validate(); }, recipe.shaping);
    if (!recipe.layers.empty() && std::holds_alternative<CloudShaping>(recipe.shaping)) {
      throw std::invalid_argument(
          "layers have no effect on a cloud, whose shaping takes the noise's octaves");
    }
    validate_output(recipe);
    validate_finish(recipe);
  });
}

// Each grid by itself, and all names different.
void validate_grids(const VolumeRecipe& recipe) {
  if (static_cast<const GridRecipe&>(recipe) != GridRecipe{}) {
    throw std::invalid_argument("grids have shapings, layers and outputs of their own; give them there");
  }
  if (recipe.modification) {
    throw std::invalid_argument("grids have no effect where a grid that exists is worked on");
  }
  const std::vector<VolumeRecipe> each = recipes_of_grids(recipe);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < each.size(); ++i) {
    const std::string path = fmt::format("grids[{}].", i);
    const std::optional<NoiseRecipe>& own = recipe.grids[i].own;
    if (own) in_field(path + "noise.", [&] { own->validate(); });
    validate_grid(each[i], path, own ? path + "noise" : "noise");
    for (const std::string& name : grid_names(each[i])) {
      if (std::find(names.begin(), names.end(), name) != names.end()) {
        throw std::invalid_argument(
            fmt::format("{}name is {}; there is a grid of that name before it", path, printable(name)));
      }
      names.push_back(name);
    }
  }
}

}  // namespace

void Domain::validate() const {
  require_fields(*this);
  for (int axis = 0; axis < 3; ++axis) {
    if (box.lower[axis] >= box.upper[axis]) {
      throw std::invalid_argument(
          fmt::format("box is {} to {} along {}; its upper corner must lie beyond its lower one",
                      box.lower[axis], box.upper[axis], "xyz"[axis]));
    }
  }
}

void VolumeRecipe::validate(const std::string& path) const {
  noise.validate();
  require_fields(*this);
  Domain::validate();
  if (modification) modification->validate();
  grids.empty() ? validate_grid(*this, path) : validate_grids(*this);  // whose fields are in no circle then
  if (dims == 3 && time != 0.0 && wind == Vec<3>(0.0) && !evolves(*this)) {
    throw std::invalid_argument(fmt::format(
        "time is {}; it must be 0 where dims is 3, there is no wind and the noise does not evolve", time));
  }
  if (dims == 4 && evolves(*this)) {
    throw std::invalid_argument("dims is 4; it must be 3 where the noise evolves");
  }
}

std::vector<VolumeRecipe> recipes_of_grids(const VolumeRecipe& recipe) {
  if (recipe.grids.empty()) return {recipe};
  std::vector<VolumeRecipe> recipes;
  for (const GridRecipe& grid : recipe.grids) {
    VolumeRecipe& single = recipes.emplace_back(recipe);
    static_cast<GridRecipe&>(single) = grid;
    single.grids.clear();
    single.noise = noise_of_layer(grid.own, recipe.noise);
    if (grid.own) single.noise_of_fields = recipe.noise;
    single.own.reset();
  }
  return recipes;
}

std::size_t entry_of_grid(const VolumeRecipe& recipe, const std::string& name) {
  const std::vector<VolumeRecipe> singles = recipes_of_grids(recipe);
  const auto has_name = [&](const VolumeRecipe& single) {
    const std::vector<std::string> names = grid_names(single);
    return std::ranges::find(names, name) != names.end();
  };
  const auto found = std::ranges::find_if(singles, has_name);
  return found == singles.end() ? 0 : static_cast<std::size_t>(found - singles.begin());
}

VolumeRecipe recipe_of_grid(const VolumeRecipe& recipe, const std::string& name) {
  return recipes_of_grids(recipe)[entry_of_grid(recipe, name)];
}

void require_grid(const VolumeRecipe& recipe, const std::string& name) {
  const std::vector<std::string> names = grid_names(recipe);
  if (std::ranges::find(names, name) != names.end()) return;
  throw std::invalid_argument(
      fmt::format("grid is {}; it must be one of {}", printable(name), fmt::join(names, ", ")));
}

GridRecipe& grid_of(VolumeRecipe& recipe, std::size_t i) {
  return recipe.grids.empty() ? recipe : recipe.grids[i];
}

bool has_gradient(const VolumeRecipe& recipe) {
  return contains(recipe.output, Output::gradient) || contains(recipe.output, Output::curl);
}

NoiseRecipe noise_of_output(const VolumeRecipe& recipe, const NoiseRecipe& noise) {
  return has_gradient(recipe) ? bounding_gradient(noise) : noise;
}

std::vector<NoiseRecipe> noises_of(const VolumeRecipe& recipe) {
  std::vector<NoiseRecipe> noises{recipe.noise};
  if (!recipe.layers.empty()) noises = noises_of(recipe.layers, recipe.noise, recipe.fields);
  if (recipe.within) {
    for (const NoiseRecipe& noise : noises_of({*recipe.within}, recipe.noise, recipe.fields)) {
      noises.push_back(noise);
    }
  }
  return noises;
}

std::vector<std::string> grid_names(const VolumeRecipe& recipe) {
  std::vector<std::string> names;
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    for (const Output output : single.output) {
      names.push_back(single.grid.empty() ? std::string(default_grid_name(output)) : single.grid);
    }
  }
  return names;
}

Vec<3> moved(const VolumeRecipe& recipe) {
  return recipe.offset + recipe.time * recipe.wind;
}

int vertical_axis(const VolumeRecipe& recipe) {
  return recipe.up == UpAxis::y ? 1 : 2;
}

bool is_scalar(const VolumeRecipe& recipe) {
  return recipe.grids.empty() && recipe.output == std::vector{Output::value};
}

bool may_band_limit(const VolumeRecipe& recipe) {
  return recipe.dims == 3 && recipe.layers.empty() && can_filter(recipe.noise) &&
         !recipe.parameters.vary_kernel();
}

VolumeRecipe at_resolution(const VolumeRecipe& recipe, const Vec<3>& voxel_size) {
  VolumeRecipe resolved = recipe;
  if (!recipe.band_limit) return resolved;
  const double longest_side = std::max({voxel_size.x, voxel_size.y, voxel_size.z});
  resolved.noise = filtered(recipe.noise, kBandLimit * longest_side);
  resolved.band_limit = false;
  return resolved;
}

bool evolves(const VolumeRecipe& recipe) {
  if (evolves(recipe.noise)) return true;
  const auto any_evolves = [](const VolumeRecipe& single) {
    return std::ranges::any_of(noises_of(single), [](const NoiseRecipe& noise) { return evolves(noise); });
  };
  return std::ranges::any_of(recipes_of_grids(recipe), any_evolves);
}

const ExemplarModel* exemplar_of_colors(const VolumeRecipe& recipe) {
  const auto* const spectrum = std::get_if<SpectrumNoiseOptions>(&recipe.noise.noise);
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  const bool own_range = raw && raw->range == RawShaping::Range::raw;
  return spectrum && own_range && spectrum->model.channels.size() == 3 ? &spectrum->model : nullptr;
}

}  // namespace solidnoise
