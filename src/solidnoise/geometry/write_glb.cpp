#include <algorithm>
#include <cctype>
#include <cstdint>
#include <functional>
#include <limits>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/scene_values.h"

// glTF 2.0 (Khronos, ISO/IEC 12113): a JSON text that says what the bytes behind it are.
namespace solidnoise {
namespace {

constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

// Numbers that stand together in the file, and what the text says of them.
struct Block {
  std::string attribute;  // empty: the corners of the triangles
  std::string type;       // SCALAR, VEC3, ...
  int component = kFloat;
  std::size_t count = 0;
  std::size_t bytes = 0;
  std::string limits;  // of the values, where it has to say them
  std::function<void(NumberWriter&)> write;
};

// A property's name as an attribute's: those that are not of the format begin with _ and are in capitals.
std::string attribute_name(const std::string& name) {
  std::string result = "_";
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    result += std::isalnum(letter) != 0 && letter < 0x80 ? static_cast<char>(std::toupper(letter)) : '_';
  }
  return result;
}

// A block of float32, `width` to a vertex.
Block floats(const std::string& attribute, const std::string& type, const PolygonMesh& mesh,
             std::size_t width, const std::function<double(std::size_t vertex, std::size_t part)>& value) {
  const std::size_t count = mesh.positions.size();
  return {attribute, type, kFloat, count, count * width * sizeof(float), {}, [=](NumberWriter& out) {
            for (std::size_t v = 0; v < count; ++v) {
              for (std::size_t part = 0; part < width; ++part) {
                out.bytes(float_value(value(v, part)), ScalarType::float32);
              }
            }
          }};
}

Block positions(const PolygonMesh& mesh) {
  Block block = floats("POSITION", "VEC3", mesh, 3, [&mesh](std::size_t vertex, std::size_t axis) {
    return mesh.positions[vertex][static_cast<int>(axis)];
  });
  const FloatBox box = float_box(mesh);
  block.limits = fmt::format(R"(,"min":[{},{},{}],"max":[{},{},{}])", box.lower.x, box.lower.y, box.lower.z,
                             box.upper.x, box.upper.y, box.upper.z);
  return block;
}

// In 16 bits of linear light: the darkest step of 8 bits of sRGB is 20 of them.
Block colors(const std::vector<const VertexProperty*>& channels, std::size_t count) {
  return {"COLOR_0",
          "VEC4",
          kUnsignedShort,
          count,
          count * 4 * sizeof(std::uint16_t),
          R"(,"normalized":true)",
          [=](NumberWriter& out) {
            constexpr double kOne = std::numeric_limits<std::uint16_t>::max();
            for (std::size_t v = 0; v < count; ++v) {
              for (std::size_t c = 0; c < 4; ++c) {
                out.bytes(c < channels.size() ? kOne * linear_color(*channels[c], v) : kOne,
                          ScalarType::uint16);
              }
            }
          }};
}

std::vector<Block> attributes_of(const PolygonMesh& mesh, bool has_faces) {
  std::vector<Block> blocks{positions(mesh)};
  if (has_faces) {
    blocks.push_back(floats("NORMAL", "VEC3", mesh, 3,
                            [normals = unit_normals(mesh)](std::size_t vertex, std::size_t axis) {
                              return normals[vertex][static_cast<int>(axis)];
                            }));
  }
  if (const auto channels = color_channels(mesh); !channels.empty()) {
    blocks.push_back(colors(channels, mesh.positions.size()));
  }
  if (const auto texture = texture_coordinates(mesh); !texture.empty()) {
    // From the top, where ours are from the bottom.
    blocks.push_back(floats("TEXCOORD_0", "VEC2", mesh, 2, [texture](std::size_t vertex, std::size_t part) {
      return part == 0 ? texture[0]->values[vertex] : 1.0 - texture[1]->values[vertex];
    }));
  }
  std::set<std::string> names;
  for (const VertexProperty* number : plain_numbers(mesh)) {
    const std::string name = attribute_name(number->name);
    if (!names.insert(name).second) {
      throw std::invalid_argument(
          fmt::format("two properties are {} in a .glb, one of them {}", name, number->name));
    }
    blocks.push_back(floats(name, "SCALAR", mesh, 1,
                            [number](std::size_t vertex, std::size_t) { return number->values[vertex]; }));
  }
  return blocks;
}

std::string text_of(const std::vector<Block>& blocks, std::size_t bytes, const MeshWriteOptions& options) {
  std::vector<std::string> views;
  std::vector<std::string> accessors;
  std::vector<std::string> attributes;
  std::size_t offset = 0;
  for (const Block& block : blocks) {
    const bool is_index = block.attribute.empty();
    views.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})", offset,
                                block.bytes, is_index ? kElementArrayBuffer : kArrayBuffer));
    accessors.push_back(fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})",
                                    accessors.size(), block.component, block.count, block.type,
                                    block.limits));
    if (!is_index) attributes.push_back(fmt::format(R"("{}":{})", block.attribute, accessors.size() - 1));
    offset += block.bytes;
  }
  const bool has_faces = blocks.back().attribute.empty();
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
  std::vector<Block> blocks = attributes_of(mesh, !triangles.empty());
  if (!triangles.empty()) {
    const std::size_t count = 3 * triangles.size();
    blocks.push_back(
        {{}, "SCALAR", kUnsignedInt, count, count * sizeof(std::uint32_t), {}, [&](NumberWriter& out) {
           for (const Triangle& triangle : triangles) {
             for (const std::uint32_t corner : triangle) out.bytes(corner, ScalarType::uint32);
           }
         }});
  }
  std::size_t bytes = 0;
  for (const Block& block : blocks) bytes += block.bytes;
  std::string text = text_of(blocks, bytes, options);
  text.append((4 - text.size() % 4) % 4, ' ');

  constexpr std::size_t kHead = 12;
  constexpr std::size_t kChunkHead = 8;
  const std::size_t size = kHead + kChunkHead + text.size() + kChunkHead + bytes;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument(fmt::format("a .glb has at most 4 GiB, this would have {} bytes", size));
  }
  NumberWriter out(stream);
  const auto number = [&](std::size_t value) { out.bytes(static_cast<double>(value), ScalarType::uint32); };
  out.text("glTF");
  number(2);
  number(size);
  number(text.size());
  out.text("JSON");
  out.text(text);
  number(bytes);
  out.text(std::string_view("BIN\0", 4));
  for (const Block& block : blocks) block.write(out);
  out.finish();
}

}  // namespace solidnoise
