#include "solidnoise/volume/make_volume.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/geometry/read_mesh.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/moved_noise.h"
#include "solidnoise/noise/slice_noise.h"
#include "solidnoise/volume/derived_volume.h"
#include "solidnoise/volume/field/cloud_field.h"
#include "solidnoise/volume/field/layered_field.h"
#include "solidnoise/volume/field/shaped_noise_field.h"
#include "solidnoise/volume/fill.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/modify/modified_volume.h"
#include "solidnoise/volume/parameters/magnified_field.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/topology/world_bounds.h"

namespace solidnoise {
namespace {

template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

bool is_raw(const VolumeRecipe& recipe) {
  return std::holds_alternative<RawShaping>(recipe.shaping);
}

Topology make_topology(const VolumeRecipe& recipe, const VolumePlan& plan, Progress* progress) {
  const Vec<3> centre = (plan.box.lower + plan.box.upper) * 0.5;
  const Vec<3> radii = (plan.box.upper - plan.box.lower) * 0.5;
  const Overloaded by_shape{
      [&](const BoxShape&) { return box_topology(plan.frame, plan.box); },
      [&](const SphereShape&) {
        return sphere_topology(plan.frame, centre, std::min({radii.x, radii.y, radii.z}));
      },
      [&](const EllipsoidShape&) { return ellipsoid_topology(plan.frame, centre, radii); },
      [&](const MeshShape&) { return mesh_topology(plan.frame, *plan.mesh, progress); },
      [&](const GridShape&) { return grid_topology(*plan.grid); },
  };
  return std::visit(by_shape, recipe.shape);
}

using Parameters = std::shared_ptr<const ParameterFields>;

NoiseView view_of(const VolumeRecipe& recipe) {
  return {recipe.dims, recipe.time, recipe.offset};
}

// Octave k of a recipe's noise by itself.
std::shared_ptr<const Field> make_volume_octave(const VolumeRecipe& recipe, const VolumePlan& plan, int k) {
  std::shared_ptr<const Field> field;
  if (recipe.parameters.vary_kernel()) {
    field = make_varying_octave(recipe.noise, k, view_of(recipe), plan.parameters);
  } else {
    VolumeRecipe octave = recipe;
    octave.noise = octave_of(recipe.noise, k);
    field = std::make_shared<NoiseField>(make_voxel_noise(octave, plan.frame));
  }
  return recipe.parameters.magnitude ? with_magnitude(field, plan.parameters) : field;
}

std::unique_ptr<Field> make_cloud(const VolumeRecipe& recipe, const VolumePlan& plan,
                                  const CloudShaping& shaping) {
  CloudParts parts;
  parts.shaping = shaping;
  parts.wavelength =
      1.0 / std::visit([](const auto& options) { return options.frequency; }, recipe.noise.noise);
  parts.box = plan.box;
  parts.up = recipe.up;
  parts.seed = seed_of(recipe.noise);
  for (int k = 0; k < recipe.noise.fractal.octaves; ++k) {
    parts.octaves.push_back({make_volume_octave(recipe, plan, k), std::pow(recipe.noise.fractal.gain, k)});
  }
  return make_cloud_field(parts);
}

std::shared_ptr<const Noise<3>> make_noise_of(VolumeRecipe recipe, const NoiseRecipe& noise) {
  recipe.noise = noise;
  return make_volume_noise(recipe);
}

std::shared_ptr<const LayeredField> make_layers(const VolumeRecipe& recipe) {
  return make_layered_field(recipe.layers, recipe.noise,
                            [&](const NoiseRecipe& noise) { return make_noise_of(recipe, noise); });
}

std::shared_ptr<const LayeredField> make_layers(const VolumeRecipe& recipe, const GridFrame& frame) {
  return make_layered_field(recipe.layers, recipe.noise, [&](const NoiseRecipe& noise) {
    VolumeRecipe layer = recipe;
    layer.noise = noise;
    return make_voxel_noise(layer, frame);
  });
}

// What is shaped: the noise, or the layers in its place.
std::shared_ptr<const Field> make_source(const VolumeRecipe& recipe, const VolumePlan& plan) {
  if (!recipe.layers.empty()) return make_layers(recipe, plan.frame);
  std::shared_ptr<const Field> field;
  if (recipe.parameters.vary_kernel()) {
    field = make_varying_volume_noise(recipe, plan.parameters);
  } else {
    field = std::make_shared<NoiseField>(make_voxel_noise(recipe, plan.frame));
  }
  return recipe.parameters.magnitude ? with_magnitude(field, plan.parameters) : field;
}

std::unique_ptr<PointField> make_raw_points(const VolumeRecipe& recipe, const RawShaping& raw) {
  if (!recipe.layers.empty()) return make_point_field(make_layers(recipe), raw);
  return make_point_field(make_volume_noise(recipe), raw);
}

std::unique_ptr<PointField> make_parameter_points(const VolumeRecipe& recipe, const Parameters& parameters) {
  const auto& raw = std::get<RawShaping>(recipe.shaping);
  if (!recipe.parameters.any()) return make_raw_points(recipe, raw);
  std::shared_ptr<const PointField> points;
  if (recipe.parameters.vary_kernel()) {
    points = make_varying_volume_noise(recipe, parameters);
  } else {
    points = make_point_field(make_volume_noise(recipe), RawShaping{});
  }
  if (recipe.parameters.magnitude) points = with_magnitude(points, parameters);
  return make_point_field(points, raw);
}

std::unique_ptr<Field> make_volume_field(const VolumeRecipe& recipe, const VolumePlan& plan) {
  if (!is_scalar(recipe)) return make_derived_field(recipe, plan);
  const auto source = [&] { return make_source(recipe, plan); };
  const Overloaded by_shaping{
      [&](const RawShaping& raw) { return make_field(source(), raw); },
      [&](const RemapShaping& remap) { return make_field(source(), remap, plan.box); },
      [&](const VeinShaping& veins) { return make_field(source(), veins); },
      [&](const CloudShaping& cloud) { return make_cloud(recipe, plan, cloud); },
  };
  return std::visit(by_shaping, recipe.shaping);
}

// Takes place and voxels of the grid that is modified.
void plan_modification(const VolumeRecipe& recipe, VolumePlan& plan) {
  if (!plan.part.whole()) {
    throw std::invalid_argument("a grid that exists is worked on as a whole; leave out region and shard");
  }
  ModificationPlan modification = plan_modification(recipe);
  const openvdb::FloatGrid& grid = modification.grid();
  plan.voxels = grid.evalActiveVoxelBoundingBox();
  const openvdb::Vec3d size = grid.transform().voxelSize(plan.voxels.getCenter());
  plan.frame = modification.frame().value_or(GridFrame(std::max({size.x(), size.y(), size.z()})));
  plan.box = plan.frame.bounds(plan.voxels);
  plan.memory = estimate_memory(recipe, modification);
  plan.modification = std::move(modification);
}

// The noise that `make(dimensions, noise recipe)` makes, as it is in the volume: at its time and place.
template <typename Make>
std::shared_ptr<const Noise<3>> make_framed(const VolumeRecipe& recipe, const Make& make) {
  std::shared_ptr<const Noise<3>> noise;
  if (recipe.dims == 3) {
    noise = make(std::integral_constant<int, 3>(), at_time(recipe.noise, recipe.time));
  } else {
    noise = slice(make(std::integral_constant<int, 4>(), recipe.noise), recipe.time);
  }
  return recipe.offset == Vec<3>(0.0) ? noise : move_noise<3>(noise, recipe.offset);
}

// What is left of the recipe's error interpolates the noise, where that is quicker.
std::shared_ptr<const Noise<3>> on_voxels(const VolumeRecipe& recipe, std::shared_ptr<const Noise<3>> noise,
                                          const GridFrame& frame) {
  if (recipe.exact) return noise;
  const bool slopes = std::all_of(recipe.output.begin(), recipe.output.end(), [](Output output) {
    return output == Output::gradient || output == Output::curl;
  });
  return interpolate<3>(std::move(noise), voxel_lattice(recipe, frame),
                        ErrorBudget(error_of(recipe.noise)).interpolation,
                        slopes ? Quantity::gradient : Quantity::values);
}

// Reads the surface that a velocity is to stay off, if there is one.
void plan_boundary(const VolumeRecipe& recipe, VolumePlan& plan) {
  plan.boundary = recipe.boundary;
  if (!plan.boundary) return;
  const openvdb::FloatGrid::Ptr surface = read_float_grid(plan.boundary->surface, "--boundary");
  try {
    require_level_set(*surface);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", plan.boundary->surface.file, error.what()));
  }
  const double frequency = std::visit([](const auto& noise) { return noise.frequency; }, recipe.noise.noise);
  plan.boundary_distance =
      std::make_shared<DistanceSpline>(surface, plan.boundary->width.value_or(1.0 / frequency));
}

// All of the plan but the parameters.
VolumePlan plan_voxels(const VolumeRecipe& recipe, const VolumePart& part) {
  VolumePlan plan;
  plan.part = part;
  plan.box = recipe.box;
  plan.shape = recipe.shape;
  if (recipe.modification) {
    plan_modification(recipe, plan);
    return plan;
  }
  plan_boundary(recipe, plan);
  const std::vector<int> components = components_of(recipe.output);
  const int channels = std::accumulate(components.begin(), components.end(), 0);
  if (auto* shape = std::get_if<GridShape>(&plan.shape)) {
    plan.grid = read_grid(*shape, "--shape");
    plan.frame = GridFrame(plan.grid->transform());
    plan.voxels = plan.grid->evalActiveVoxelBoundingBox();
    plan.box = plan.frame.bounds(plan.voxels);
    plan.memory = estimate_part_memory(estimate_memory(*plan.grid, channels), plan.frame, part);
    return plan;
  }
  if (auto* shape = std::get_if<MeshShape>(&plan.shape)) {
    PolygonMesh mesh = read_mesh(shape->file).mesh;
    plan.mesh = TriangleMesh{std::move(mesh.positions), triangulate(mesh)};
    try {
      require_closed(*plan.mesh);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}: {}", shape->file, error.what()));
    }
    plan.box = plan.mesh->bounds();
    note_digest(shape->file, "--shape", shape->digest);
  }
  plan.frame = GridFrame(recipe.voxel ? *recipe.voxel : voxel_size_for_dim(plan.box, recipe.dim));
  plan.voxels = plan.frame.voxels_in(plan.box);
  plan.memory = estimate_part_memory(estimate_memory(plan.voxels, channels), plan.frame, part);
  return plan;
}

// The noise for a modification of the plan's grid, for whichever recipe that asks for.
ModifyingNoise modifying_noise(const VolumePlan& plan) {
  const Vec<3> voxel = plan.frame.voxel_size();
  return {
      [&plan, voxel](const VolumeRecipe& of) { return make_volume_field(at_resolution(of, voxel), plan); },
      [&plan, voxel](const VolumeRecipe& of) {
        return make_parameter_points(at_resolution(of, voxel), plan.parameters);
      }};
}

// Layers of whole leaves that a topology can be cut into along an axis, from below.
std::vector<VolumePart> slabs_of(const Topology& topology, int axis) {
  constexpr int kThickness = 64;  // voxels: two of the blocks that impulses are made for once
  constexpr int kHalfLeaf = 4;
  const openvdb::CoordBBox voxels = topology.voxel_bounds();
  const Box<3> bounds = topology.frame.bounds(voxels.expandBy(kThickness));
  std::vector<VolumePart> slabs;
  for (int first = voxels.min()[axis] & ~(kThickness - 1); first <= voxels.max()[axis]; first += kThickness) {
    // Leaves count by their first voxel: the border lies well between those of two.
    const double voxel = topology.frame.voxel_size()[axis];
    Box<3> region = bounds;
    region.lower[axis] = topology.frame.origin()[axis] + (first - kHalfLeaf) * voxel;
    region.upper[axis] = region.lower[axis] + kThickness * voxel;
    slabs.push_back({.region = region});
  }
  return slabs;
}

}  // namespace

VolumePlan plan_volume(const VolumeRecipe& recipe, const VolumePart& part) {
  recipe.validate();
  part.validate();
  VolumePlan plan = plan_voxels(recipe, part);
  if (!recipe.parameters.any()) return plan;
  plan.parameters = std::make_shared<ParameterFields>(recipe.parameters);
  plan.parameters->require_overlap(plan.modification ? world_bounds(plan.modification->grid()) : plan.box);
  plan.memory += plan.parameters->memory();
  return plan;
}

std::shared_ptr<const Noise<3>> make_volume_noise(const VolumeRecipe& recipe) {
  if (recipe.band_limit) throw std::invalid_argument("band_limit needs the size of the voxels");
  return make_framed(
      recipe, [](auto dim, const NoiseRecipe& noise) { return make_noise<decltype(dim)::value>(noise); });
}

std::unique_ptr<PointField> make_volume_points(const VolumeRecipe& recipe) {
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  if (!raw) throw std::invalid_argument("a field at points is of raw noise; shaped noise is on voxels only");
  return make_raw_points(recipe, *raw);
}

LatticeFrame<3> voxel_lattice(const VolumeRecipe& recipe, const GridFrame& frame) {
  LatticeFrame<3> lattice{frame.origin(), frame.voxel_size()};
  const Vec<4> period = std::visit([](const auto& options) { return options.period; }, recipe.noise.noise);
  for (int axis = 0; axis < 3; ++axis) lattice.period[axis] = whole_period(period[axis], lattice.step[axis]);
  return lattice;
}

std::shared_ptr<const Noise<3>> make_voxel_noise(const VolumeRecipe& recipe, const GridFrame& frame) {
  return on_voxels(recipe, make_volume_noise(recipe), frame);
}

std::shared_ptr<const VaryingField> make_varying_volume_noise(const VolumeRecipe& recipe,
                                                              std::shared_ptr<const ParameterFields> fields) {
  return make_varying_field(recipe.noise, view_of(recipe), std::move(fields));
}

std::shared_ptr<const Noise<3>> make_voxel_quadrature(const VolumeRecipe& recipe, const GridFrame& frame) {
  const auto noise = make_framed(
      recipe, [](auto dim, const NoiseRecipe& of) { return make_quadrature<decltype(dim)::value>(of); });
  return on_voxels(recipe, noise, frame);
}

double highest_frequency(const VolumeRecipe& recipe, const VolumePlan& plan) {
  if (recipe.parameters.vary_kernel()) {
    return make_varying_volume_noise(recipe, plan.parameters)->band().upper;
  }
  if (recipe.layers.empty()) return make_volume_noise(recipe)->band().upper;
  double highest = 0.0;
  for (const NoiseRecipe& noise : noises_of(recipe.layers, recipe.noise)) {
    highest = std::max(highest, make_noise_of(recipe, noise)->band().upper);
  }
  return highest;
}

Volume make_volume(const VolumeRecipe& recipe, const VolumePlan& plan, const std::string& creator,
                   Progress* progress) {
  VolumeRecipe noted = recipe;
  noted.shape = plan.shape;
  noted.boundary = plan.boundary;
  if (plan.parameters) noted.parameters = plan.parameters->grids();
  if (plan.modification) {
    if (plan.parameters && plan.modification->on_lattice()) {
      plan.parameters->require_allowed_at(grid_topology(plan.modification->grid()));
    }
    return make_modified_volume(noted, *plan.modification, modifying_noise(plan), progress);
  }
  const std::unique_ptr<Field> field =
      make_volume_field(at_resolution(recipe, plan.frame.voxel_size()), plan);
  const Topology topology = make_topology(recipe, plan, progress);
  const Topology part = take_part(topology, plan.part);
  if (plan.parameters) plan.parameters->require_allowed_at(part);
  Volume volume{fill_grids(part, *field, components_of(recipe.output),
                           is_raw(recipe) ? Sparsity::keep : Sparsity::drop, progress)};
  if (plan.part.whole()) {
    finish_volume(noted, creator, volume);
  } else {
    note_part(noted, creator, topology, part, volume);
  }
  return volume;
}

std::optional<double> measure_density_factor(const VolumeRecipe& recipe, const VolumePlan& plan,
                                             Progress* progress) {
  if (plan.modification) {
    return measure_density_factor(recipe, *plan.modification, modifying_noise(plan), progress);
  }
  const std::unique_ptr<Field> field =
      make_volume_field(at_resolution(recipe, plan.frame.voxel_size()), plan);
  const Topology topology = make_topology(recipe, plan, progress);
  if (plan.parameters) plan.parameters->require_allowed_at(topology);
  const int axis = vertical_axis(recipe);
  ColumnSums columns(topology.voxel_bounds(), axis);
  double peak = 0.0;
  const std::vector<VolumePart> slabs = slabs_of(topology, axis);
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    const auto share = [&](std::size_t k) {
      return static_cast<double>(k) / static_cast<double>(slabs.size());
    };
    PartialProgress of_slab(progress, share(i), share(i + 1));
    const FilledGrid slab = fill_grid(take_part(topology, slabs[i]), *field, Sparsity::drop, &of_slab);
    if (slab.moments.count() == 0) continue;
    columns.add(*slab.grid);
    peak = std::max(peak, slab.moments.max());
  }
  return density_factor(recipe.density, peak, columns.largest() * plan.frame.voxel_size()[axis]);
}

}  // namespace solidnoise
