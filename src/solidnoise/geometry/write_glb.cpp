#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solidnoise/geometry/gltf_attributes.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/scene_values.h"

// glTF 2.0 (Khronos, ISO/IEC 12113): a JSON text that says what the bytes behind it are.
namespace solidnoise {
namespace {

constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

GltfAttribute positions(const PolygonMesh& mesh) {
  GltfAttribute result =
      gltf_floats("POSITION", 3, 0, mesh.positions.size(), [&mesh](std::size_t vertex, std::size_t axis) {
        return mesh.positions[vertex][static_cast<int>(axis)];
      });
  const FloatBox box = float_box(mesh);
  result.limits = fmt::format(R"(,"min":[{},{},{}],"max":[{},{},{}])", box.lower.x, box.lower.y, box.lower.z,
                              box.upper.x, box.upper.y, box.upper.z);
  return result;
}

std::vector<GltfAttribute> all_attributes(const PolygonMesh& mesh, bool has_faces) {
  const std::size_t count = mesh.positions.size();
  std::vector<GltfAttribute> attributes{positions(mesh)};
  if (has_faces) {
    attributes.push_back(gltf_floats("NORMAL", 3, 0, count,
                                     [normals = unit_normals(mesh)](std::size_t vertex, std::size_t axis) {
                                       return normals[vertex][static_cast<int>(axis)];
                                     }));
  }
  if (const auto texture = texture_coordinates(mesh); !texture.empty()) {
    // From the top, where ours are from the bottom.
    attributes.push_back(
        gltf_floats("TEXCOORD_0", 2, 0, count, [texture](std::size_t vertex, std::size_t part) {
          return part == 0 ? texture[0]->values[vertex] : 1.0 - texture[1]->values[vertex];
        }));
  }
  for (GltfAttribute& attribute : gltf_attributes(mesh, 0, count)) attributes.push_back(std::move(attribute));
  return attributes;
}

std::string text_of(const std::vector<GltfAttribute>& blocks, std::size_t bytes,
                    const MeshWriteOptions& options) {
  std::vector<std::string> views;
  std::vector<std::string> accessors;
  std::vector<std::string> attributes;
  std::size_t offset = 0;
  for (const GltfAttribute& block : blocks) {
    const bool is_index = block.name.empty();
    views.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})", offset,
                                block.bytes, is_index ? kElementArrayBuffer : kArrayBuffer));
    accessors.push_back(fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})",
                                    accessors.size(), block.component, block.count, block.type,
                                    block.normalized ? R"(,"normalized":true)" : block.limits));
    if (!is_index) attributes.push_back(fmt::format(R"("{}":{})", block.name, accessors.size() - 1));
    offset += block.bytes;
  }
  const bool has_faces = blocks.back().name.empty();
  std::vector<std::string> comments;
  for (const std::string& comment : options.comments) comments.push_back(quoted_text(comment));
  const std::string extras =
      comments.empty() ? "" : fmt::format(R"(,"extras":{{"comments":[{}]}})", fmt::join(comments, ","));
  // What is up in the file is y.
  const char* const turn =
      options.up == UpAxis::z ? R"(,"rotation":[-0.7071067811865476,0,0,0.7071067811865476])" : "";
  const std::string faces =
      has_faces ? fmt::format(R"("indices":{},"mode":4)", accessors.size() - 1) : R"("mode":0)";
  return fmt::format(
      R"({{"asset":{{"version":"2.0","generator":"solidnoise"{}}},"scene":0,"scenes":[{{"nodes":[0]}}],)"
      R"("nodes":[{{"mesh":0{}}}],"meshes":[{{"primitives":[{{"attributes":{{{}}},{}}}]}}],)"
      R"("buffers":[{{"byteLength":{}}}],"bufferViews":[{}],"accessors":[{}]}})",
      extras, turn, fmt::join(attributes, ","), faces, bytes, fmt::join(views, ","),
      fmt::join(accessors, ","));
}

}  // namespace

void write_glb(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  require_float_positions(mesh, "glTF");
  const std::vector<Triangle> triangles = triangulate(mesh);
  std::vector<GltfAttribute> blocks = all_attributes(mesh, !triangles.empty());
  if (!triangles.empty()) {
    GltfAttribute corners{{}, "SCALAR", kUnsignedInt, 3 * triangles.size()};
    corners.bytes = corners.count * sizeof(std::uint32_t);
    corners.write = [&](NumberWriter& out) {
      for (const Triangle& triangle : triangles) {
        for (const std::uint32_t corner : triangle) out.bytes(corner, ScalarType::uint32);
      }
    };
    blocks.push_back(std::move(corners));
  }
  std::size_t bytes = 0;
  for (const GltfAttribute& block : blocks) bytes += block.bytes;
  NumberWriter out(stream);
  write_glb_head(out, text_of(blocks, bytes, options), bytes);
  for (const GltfAttribute& block : blocks) block.write(out);
  out.finish();
}

}  // namespace solidnoise
