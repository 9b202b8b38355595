#include "solidnoise/volume/usd_scene.h"

#include <functional>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/geometry/scene_values.h"

namespace solidnoise {
namespace {

std::string class_of(const openvdb::GridBase& grid) {
  switch (grid.getGridClass()) {
    case openvdb::GRID_FOG_VOLUME:
      return "fogVolume";
    case openvdb::GRID_LEVEL_SET:
      return "levelSet";
    case openvdb::GRID_STAGGERED:
      return "staggered";
    default:
      return "unknown";
  }
}

std::string data_type_of(const openvdb::GridBase& grid) {
  static const std::map<std::string, std::string> kWords{
      {"float", "float"},   {"double", "double"}, {"int32", "int"}, {"int64", "int64"}, {"vec3s", "float3"},
      {"vec3d", "double3"}, {"vec3i", "int3"},    {"bool", "bool"}, {"mask", "mask"},   {"string", "string"}};
  const auto word = kWords.find(grid.valueType());
  return word == kWords.end() ? std::string() : word->second;
}

std::string vector_role_of(const openvdb::GridBase& grid) {
  if (!grid.valueType().starts_with("vec")) return {};
  switch (grid.getVectorType()) {
    case openvdb::VEC_INVARIANT:
      return "Color";
    case openvdb::VEC_COVARIANT_NORMALIZE:
      return "Normal";
    case openvdb::VEC_CONTRAVARIANT_ABSOLUTE:
      return "Point";
    default:
      return "Vector";
  }
}

// An attribute: one value, or one per frame.
std::string attribute(const std::string& margin, const std::string& declaration,
                      const std::vector<UsdFrame>& frames,
                      const std::function<std::string(const UsdFrame&)>& value) {
  if (!frames.front().frame) return fmt::format("{}{} = {}\n", margin, declaration, value(frames.front()));
  std::string text = fmt::format("{}{}.timeSamples = {{\n", margin, declaration);
  for (const UsdFrame& frame : frames)
    text += fmt::format("{}    {}: {},\n", margin, *frame.frame, value(frame));
  return text + margin + "}\n";
}

std::string extent_text(const UsdFrame& frame) {
  const auto point = [](const openvdb::Vec3d& p) {
    return fmt::format("({}, {}, {})", static_cast<float>(p.x()), static_cast<float>(p.y()),
                       static_cast<float>(p.z()));
  };
  return fmt::format("[{}, {}]", point(frame.extent.min()), point(frame.extent.max()));
}

std::string asset_text(const UsdFrame& frame) {
  const char* const mark = frame.file.find('@') == std::string::npos ? "@" : "@@@";
  return fmt::format("{}./{}{}", mark, frame.file, mark);
}

std::string head_text(const UsdScene& scene) {
  std::string text =
      fmt::format("#usda 1.0\n(\n    defaultPrim = \"{}\"\n    metersPerUnit = 1\n    upAxis = \"{}\"\n",
                  usd_name(scene.name), scene.up == UpAxis::z ? "Z" : "Y");
  if (scene.frames.front().frame) {
    text += fmt::format("    startTimeCode = {}\n    endTimeCode = {}\n    timeCodesPerSecond = {}\n",
                        *scene.frames.front().frame, *scene.frames.back().frame, scene.fps);
  }
  return text + ")\n\n";
}

std::string field_text(const UsdField& field, const std::vector<UsdFrame>& frames) {
  const std::string margin(8, ' ');
  std::string text = fmt::format("\n    def OpenVDBAsset \"{}\"\n    {{\n", usd_name(field.grid));
  text += attribute(margin, "asset filePath", frames, asset_text);
  text += margin + "token fieldName = " + quoted_text(field.grid) + '\n';
  text += margin + "token fieldClass = " + quoted_text(field.field_class) + '\n';
  if (!field.data_type.empty())
    text += margin + "token fieldDataType = " + quoted_text(field.data_type) + '\n';
  if (!field.vector_role.empty())
    text += margin + "token vectorDataRoleHint = " + quoted_text(field.vector_role) + '\n';
  return text + "    }\n";
}

}  // namespace

std::string UsdScene::text() const {
  const std::string prim = usd_name(name);
  std::string text = head_text(*this) + fmt::format("def Volume \"{}\"\n{{\n", prim);
  text += attribute("    ", "float3[] extent", frames, extent_text);
  std::set<std::string> names;
  for (const UsdField& field : fields) {
    const std::string field_name = usd_name(field.grid);
    if (!names.insert(field_name).second) {
      throw std::invalid_argument(
          fmt::format("two grids are {} in USD, one of them '{}'", field_name, field.grid));
    }
    text += fmt::format("    rel field:{} = </{}/{}>\n", field_name, prim, field_name);
  }
  for (const UsdField& field : fields) text += field_text(field, frames);
  return text + "}\n";
}

std::vector<UsdField> usd_fields(const openvdb::GridCPtrVec& grids) {
  std::vector<UsdField> fields;
  for (const auto& grid : grids) {
    fields.push_back({grid->getName(), class_of(*grid), data_type_of(*grid), vector_role_of(*grid)});
  }
  return fields;
}

openvdb::BBoxd usd_extent(const openvdb::GridCPtrVec& grids) {
  openvdb::BBoxd extent;
  for (const auto& grid : grids) {
    const openvdb::CoordBBox voxels = grid->evalActiveVoxelBoundingBox();
    if (voxels.empty()) continue;
    // Voxels reach half their size around their centres.
    const openvdb::Vec3d half(0.5);
    extent.expand(grid->transform().indexToWorld(
        openvdb::BBoxd(voxels.min().asVec3d() - half, voxels.max().asVec3d() + half)));
  }
  return extent.empty() ? openvdb::BBoxd(openvdb::Vec3d(0.0), openvdb::Vec3d(0.0)) : extent;
}

}  // namespace solidnoise
