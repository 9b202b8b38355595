#include "digests/volume_inputs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>
#include <openvdb/tools/LevelSetSphere.h>

#include "support/parameter_grids.h"
#include "support/paths.h"

namespace solidnoise {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3SGrid;

constexpr double kVoxel = 0.1;
const openvdb::CoordBBox kPainted = cube_of(-18, 18);  // whole leaves around all other voxels

template <typename At>
FloatGrid::Ptr floats(const std::string& name, const openvdb::CoordBBox& box, const At& at) {
  return grid_of<FloatGrid>(name, kVoxel, box,
                            [&](double x, double y, double z) { return static_cast<float>(at(x, y, z)); });
}

FloatGrid::Ptr smoke() {
  const FloatGrid::Ptr grid = floats("density", cube_of(-12, 12), [](double x, double y, double z) {
    return std::max(0.0, 20.0 * (1.0 - std::sqrt(x * x + y * y + z * z)));
  });
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  return grid;
}

FloatGrid::Ptr turned_smoke() {
  const FloatGrid::Ptr grid = smoke();
  const auto transform = openvdb::math::Transform::createLinearTransform(kVoxel);
  transform->postRotate(0.4, openvdb::math::Y_AXIS);
  transform->postTranslate({0.2, -0.1, 0.3});
  grid->setTransform(transform);
  return grid;
}

FloatGrid::Ptr surface() {
  const auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(0.7f, openvdb::Vec3f(0.1f, 0.0f, -0.2f),
                                                                    static_cast<float>(kVoxel));
  grid->setName("surface");
  return grid;
}

// Puts the folder before every "file" of a recipe.
void find_files(Json& json, const std::filesystem::path& folder) {
  for (auto& [key, value] : json.items()) {
    if (key == "file") value = (folder / value.get<std::string>()).string();
    if (value.is_structured()) find_files(value, folder);
  }
}

}  // namespace

void write_volume_inputs(const std::filesystem::path& folder) {
  write_vdb(folder / "smoke.vdb", {smoke()}, {});
  write_vdb(folder / "turned.vdb", {turned_smoke()}, {});
  write_vdb(folder / "surface.vdb", {surface()}, {});
  write_vdb(folder / "paint.vdb",
            {floats("paint", kPainted, [](double x, double, double) { return 0.5 + x / 4.0; }),
             floats("ramp", kPainted, [](double x, double, double) { return 4.0 + 5.0 / 3.0 * x; }),
             floats("narrow", kPainted, [](double, double y, double) { return 1.2 + 0.25 * y; })},
            {});
  write_vdb(folder / "vel.vdb",
            {grid_of<Vec3SGrid>("vel", kVoxel, kPainted,
                                [](double x, double y, double) {
                                  return openvdb::Vec3s(static_cast<float>(-y), static_cast<float>(x), 0.1f);
                                })},
            {});
  write_vdb(folder / "rest.vdb",
            {grid_of<Vec3SGrid>("rest", kVoxel, kPainted,
                                [](double x, double y, double z) {
                                  return openvdb::Vec3s(openvdb::Vec3d(2.0 * x, 2.0 * y, 2.0 * z + 0.1 * x));
                                })},
            {});
  std::filesystem::copy_file(in_source("meshes/torus.obj"), folder / "torus.obj");
}

Json with_inputs(Json recipe, const std::filesystem::path& folder) {
  if (!recipe.contains("on")) {
    if (recipe.contains("displace")) recipe["on"]["file"] = "surface.vdb";
    if (recipe.contains("combine")) recipe["on"]["file"] = "smoke.vdb";
  }
  find_files(recipe, folder);
  return recipe;
}

}  // namespace solidnoise
