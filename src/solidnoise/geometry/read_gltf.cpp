#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "solidnoise/core/input_file.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/gltf_file.h"
#include "solidnoise/geometry/gltf_library.h"
#include "solidnoise/geometry/mesh_codecs.h"

namespace solidnoise {
namespace {

using Transform = glm::dmat4;

// A .glb of a text and the bytes of another.
std::string container(const std::string& text, std::string_view binary) {
  std::string bytes = "glTF";
  const auto add = [&](std::size_t number) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
  };
  const std::string padded = text + std::string((4 - text.size() % 4) % 4, ' ');
  add(2);
  add(12 + 8 + padded.size() + 8 + binary.size());
  add(padded.size());
  bytes += "JSON" + padded;
  add(binary.size());
  bytes += std::string_view("BIN\0", 4);
  bytes += binary;
  return bytes;
}

bool read_beside(std::vector<unsigned char>* out, std::string* error, const std::string& path, void*) {
  try {
    const std::string bytes = read_file(path, kMostGltfBytes);
    out->assign(bytes.begin(), bytes.end());
    return true;
  } catch (const std::exception& problem) {
    *error += problem.what();
    return false;
  }
}

tinygltf::Model model_of(const GltfFile& file, const std::string& name) {
  const std::string text = checked_gltf(file, name).dump();
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({[](const std::string& path, void*) { return std::filesystem::exists(path); },
                         [](const std::string& path, void*) { return path; }, read_beside, nullptr, nullptr});
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const std::string folder = std::filesystem::path(name).parent_path().string();
  bool done = false;
  try {
    if (file.binary.empty()) {
      done = loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                        static_cast<unsigned int>(text.size()), folder);
    } else {
      const std::string bytes = container(text, file.binary);
      done = loader.LoadBinaryFromMemory(&model, &error, &warning,
                                         reinterpret_cast<const unsigned char*>(bytes.data()),
                                         static_cast<unsigned int>(bytes.size()), folder);
    }
  } catch (const std::exception& problem) {
    error = problem.what();
  }
  if (done) return model;
  std::replace(error.begin(), error.end(), '\n', ' ');
  while (error.ends_with(' ')) error.pop_back();
  refuse_gltf(name, error.empty() ? "it cannot be read" : printable(error));
}

// An accessor's numbers.
class Numbers {
 public:
  Numbers(const tinygltf::Model& model, int index, const std::string& name)
      : accessor_(model.accessors[static_cast<std::size_t>(index)]) {
    const std::string where = fmt::format("accessors[{}]", index);
    const int component =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor_.componentType));
    width_ = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor_.type));
    if (component <= 0 || width_ <= 0) refuse_gltf(name, where + " is of no known type");
    if (accessor_.bufferView < 0)
      refuse_gltf(name, where + " is sparse, or has no bufferView: such are not read");
    const auto& view = model.bufferViews[static_cast<std::size_t>(accessor_.bufferView)];
    const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    const std::size_t size = static_cast<std::size_t>(component) * static_cast<std::size_t>(width_);
    stride_ = view.byteStride != 0 ? view.byteStride : size;
    const std::size_t end = accessor_.count == 0
                                ? accessor_.byteOffset
                                : accessor_.byteOffset + stride_ * (accessor_.count - 1) + size;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset ||
        end > view.byteLength || stride_ < size)
      refuse_gltf(name, where + " has more numbers than bytes");
    first_ = data.data() + view.byteOffset + accessor_.byteOffset;
  }

  std::size_t count() const { return accessor_.count; }
  int width() const { return width_; }
  bool is_float() const { return accessor_.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT; }

  double at(std::size_t index, int part) const {
    const unsigned char* const from = first_ + index * stride_;
    switch (accessor_.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return scaled(number<std::int8_t>(from, part), 127.0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return scaled(number<std::uint8_t>(from, part), 255.0);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return scaled(number<std::int16_t>(from, part), 32767.0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return scaled(number<std::uint16_t>(from, part), 65535.0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return number<std::uint32_t>(from, part);
      default:
        return static_cast<double>(number<float>(from, part));
    }
  }

 private:
  template <typename T>
  static T number(const unsigned char* from, int part) {
    T value;
    std::memcpy(&value, from + static_cast<std::size_t>(part) * sizeof(T), sizeof(T));
    return value;
  }
  double scaled(double value, double most) const {
    return accessor_.normalized ? std::max(value / most, -1.0) : value;
  }

  const tinygltf::Accessor& accessor_;
  int width_ = 0;
  std::size_t stride_ = 0;
  const unsigned char* first_ = nullptr;
};

Transform transform_of(const tinygltf::Node& node) {
  Transform result(1.0);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) result[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return result;
  }
  if (node.rotation.size() == 4) {
    const double x = node.rotation[0];
    const double y = node.rotation[1];
    const double z = node.rotation[2];
    const double w = node.rotation[3];
    result[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0};
    result[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0};
    result[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0};
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (node.scale.size() == 3) result[axis] *= node.scale[a];
    if (node.translation.size() == 3) result[3][axis] = node.translation[a];
  }
  return result;
}

// Where the first node that has a mesh puts it, and how many have it.
struct Placement {
  Transform transform{1.0};
  int nodes = 0;
};

std::vector<Placement> placements_of(const tinygltf::Model& model) {
  std::vector<Placement> placements(model.meshes.size());
  std::vector<int> parents(model.nodes.size(), -1);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const int child : model.nodes[i].children)
      parents[static_cast<std::size_t>(child)] = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].mesh < 0) continue;
    Placement& placement = placements[static_cast<std::size_t>(model.nodes[i].mesh)];
    if (++placement.nodes > 1) continue;
    for (int at = static_cast<int>(i); at >= 0; at = parents[static_cast<std::size_t>(at)])
      placement.transform = transform_of(model.nodes[static_cast<std::size_t>(at)]) * placement.transform;
  }
  return placements;
}

class GltfReader {
 public:
  GltfReader(const GltfFile& file, const std::string& name)
      : file_(file), name_(name), model_(model_of(file, name)), placements_(placements_of(model_)) {}

  GltfMesh read() {
    for (std::size_t mesh = 0; mesh < model_.meshes.size(); ++mesh) {
      const auto& primitives = model_.meshes[mesh].primitives;
      for (std::size_t i = 0; i < primitives.size(); ++i)
        add(static_cast<int>(mesh), static_cast<int>(i), primitives[i]);
    }
    add_texture();
    add_notes();
    add_files();
    return std::move(result_);
  }

 private:
  void add(int mesh, int index, const tinygltf::Primitive& primitive) {
    const bool is_surface =
        primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN;
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end() || (!is_surface && primitive.mode != TINYGLTF_MODE_POINTS)) {
      ++others_;
      return;
    }
    const std::size_t block = block_of(mesh, primitive, position->second);
    result_.primitives.push_back({mesh, index, block});
    if (is_surface) add_triangles(primitive, result_.blocks[block]);
  }

  std::size_t block_of(int mesh, const tinygltf::Primitive& primitive, int accessor) {
    const auto texture = primitive.attributes.find("TEXCOORD_0");
    const int places = texture == primitive.attributes.end() ? -1 : texture->second;
    const auto [found, is_new] = known_.try_emplace({mesh, accessor, places}, result_.blocks.size());
    if (!is_new) return found->second;
    auto& positions = result_.reading.mesh.positions;
    const Numbers numbers(model_, accessor, name_);
    if (numbers.width() != 3) refuse_gltf(name_, fmt::format("accessors[{}] must be VEC3", accessor));
    result_.blocks.push_back({mesh, accessor, positions.size(), numbers.count()});
    if (positions.size() + numbers.count() >= 4294967295u)
      refuse_gltf(name_, "it has more than 2^32 vertices");
    const Transform& transform = placements_[static_cast<std::size_t>(mesh)].transform;
    for (std::size_t v = 0; v < numbers.count(); ++v) {
      const Vec<3> place(transform * Vec<4>(numbers.at(v, 0), numbers.at(v, 1), numbers.at(v, 2), 1.0));
      if (!std::isfinite(place.x + place.y + place.z))
        refuse_gltf(name_, fmt::format("accessors[{}]: position {} is not finite", accessor, v));
      positions.push_back(place);
    }
    texture_.push_back(places);
    return found->second;
  }

  void add_triangles(const tinygltf::Primitive& primitive, const GltfBlock& block) {
    std::optional<Numbers> indices;
    if (primitive.indices >= 0) indices.emplace(model_, primitive.indices, name_);
    if (indices && indices->is_float())
      refuse_gltf(name_, fmt::format("accessors[{}] must be of integers", primitive.indices));
    const std::size_t count = indices ? indices->count() : block.count;
    const auto corner = [&](std::size_t i) {
      const auto vertex = indices ? static_cast<std::size_t>(std::max(0.0, indices->at(i, 0))) : i;
      if (vertex >= block.count) {
        refuse_gltf(name_, fmt::format("accessors[{}]: index {} is {}; there are {} vertices",
                                       primitive.indices, i, vertex, block.count));
      }
      return static_cast<std::uint32_t>(block.first + vertex);
    };
    // A transform that mirrors turns faces inside out, unless they are wound the other way round.
    const glm::dmat3 linear(placements_[static_cast<std::size_t>(block.mesh)].transform);
    const bool is_mirrored = glm::determinant(linear) < 0.0;
    const auto face = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (is_mirrored) std::swap(b, c);
      result_.reading.mesh.add_face(Triangle{corner(a), corner(b), corner(c)});
    };
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    for (std::size_t i = 0; i + 2 < count; i += is_list ? 3 : 1) {
      if (is_list || (is_strip && i % 2 == 0)) {
        face(i, i + 1, i + 2);
      } else if (is_strip) {
        face(i + 1, i, i + 2);
      } else {
        face(0, i + 1, i + 2);
      }
    }
  }

  // From the bottom, where theirs are from the top.
  void add_texture() {
    if (std::all_of(texture_.begin(), texture_.end(), [](int accessor) { return accessor < 0; })) return;
    std::array<std::vector<double>, 2> places;
    for (std::size_t b = 0; b < texture_.size(); ++b) {
      const std::size_t count = result_.blocks[b].count;
      std::optional<Numbers> numbers;
      if (texture_[b] >= 0) numbers.emplace(model_, texture_[b], name_);
      if (numbers && (numbers->count() != count || numbers->width() != 2))
        refuse_gltf(name_, fmt::format("accessors[{}] must be {} VEC2", texture_[b], count));
      for (std::size_t v = 0; v < count; ++v) {
        places[0].push_back(numbers ? numbers->at(v, 0) : kNoNumber);
        places[1].push_back(numbers ? 1.0 - numbers->at(v, 1) : kNoNumber);
      }
    }
    for (std::size_t part = 0; part < 2; ++part) {
      result_.reading.mesh.properties.push_back(
          {std::string(kTextureNames[part]), ScalarType::float32, std::move(places[part])});
    }
  }

  void add_notes() {
    std::vector<std::string>& notes = result_.reading.notes;
    std::vector<std::string> dropped;
    for (const char* const key :
         {"nodes", "materials", "textures", "images", "animations", "skins", "cameras"}) {
      const auto found = file_.json.find(key);
      if (found != file_.json.end() && found->is_array() && !found->empty())
        dropped.push_back(fmt::format("{} {}", found->size(), key));
    }
    dropped.push_back("normals and colours");
    notes.push_back(fmt::format("{} are dropped", fmt::join(dropped, ", ")));
    if (others_ > 0)
      notes.push_back(fmt::format("{} primitives of lines, or without positions, are left out", others_));
    for (std::size_t i = 0; i < placements_.size(); ++i) {
      if (placements_[i].nodes <= 1) continue;
      notes.push_back(fmt::format("meshes[{}] is that of {} nodes; it is where the first has it", i,
                                  placements_[i].nodes));
    }
    const auto asset = file_.json.find("asset");
    const auto extras = asset->find("extras");
    if (extras == asset->end() || !extras->is_object()) return;
    const auto comments = extras->find("comments");
    if (comments == extras->end() || !comments->is_array()) return;
    for (const auto& comment : *comments) {
      if (comment.is_string()) result_.reading.comments.push_back(comment.get<std::string>());
    }
  }

  void add_files() {
    for (const char* const key : {"buffers", "images"}) {
      const auto list = file_.json.find(key);
      if (list == file_.json.end()) continue;
      for (const auto& item : *list) {
        if (!item.is_object() || !item.contains("uri") || !item["uri"].is_string()) continue;
        const auto& uri = item["uri"].get_ref<const std::string&>();
        if (!uri.starts_with("data:")) result_.reading.files.push_back(uri);
      }
    }
  }

  const GltfFile& file_;
  const std::string& name_;
  tinygltf::Model model_;
  std::vector<Placement> placements_;
  std::map<std::array<int, 3>, std::size_t> known_;  // blocks of a mesh, its positions and its places
  std::vector<int> texture_;                         // accessor of each block; -1: none
  std::size_t others_ = 0;
  GltfMesh result_;
};

}  // namespace

GltfMesh load_gltf(const GltfFile& file, const std::string& name) {
  return GltfReader(file, name).read();
}

MeshReading read_gltf(std::string_view bytes, MeshFormat format, const std::string& name) {
  return load_gltf(parse_gltf(bytes, format, name), name).reading;
}

}  // namespace solidnoise
