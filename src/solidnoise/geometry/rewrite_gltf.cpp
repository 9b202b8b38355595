#include <cstddef>
#include <ostream>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/geometry/gltf_attributes.h"
#include "solidnoise/geometry/gltf_file.h"
#include "solidnoise/geometry/mesh_codecs.h"

namespace solidnoise {
namespace {

using OrderedJson = nlohmann::ordered_json;

// The numbers that are added to a file, behind those that it has.
class Additions {
 public:
  Additions(OrderedJson& json, std::size_t bytes_before) : json_(json), offset_(bytes_before) {}

  // Returns the number of the new accessor.
  std::size_t add(const GltfAttribute& attribute) {
    OrderedJson view{
        {"buffer", 0}, {"byteOffset", offset_}, {"byteLength", attribute.bytes}, {"target", 34962}};
    OrderedJson accessor{{"bufferView", list("bufferViews").size()},
                         {"componentType", attribute.component},
                         {"count", attribute.count},
                         {"type", attribute.type}};
    if (attribute.normalized) accessor["normalized"] = true;
    list("bufferViews").push_back(std::move(view));
    list("accessors").push_back(std::move(accessor));
    offset_ += attribute.bytes;
    return json_["accessors"].size() - 1;
  }

  std::size_t end() const { return offset_; }

 private:
  OrderedJson& list(const char* key) {
    if (!json_.contains(key)) json_[key] = OrderedJson::array();
    return json_[key];
  }

  OrderedJson& json_;
  std::size_t offset_;
};

void set_comments(OrderedJson& json, const std::vector<std::string>& comments) {
  OrderedJson& asset = json["asset"];
  if (comments.empty() || (asset.contains("extras") && !asset["extras"].is_object())) return;
  asset["extras"]["comments"] = OrderedJson::array();
  for (const std::string& comment : comments) asset["extras"]["comments"].push_back(comment);
}

// The first buffer becomes that of a .glb.
void make_room(OrderedJson& json) {
  if (!json.contains("buffers")) json["buffers"] = OrderedJson::array();
  OrderedJson& buffers = json["buffers"];
  if (!buffers.empty() && !buffers[0].contains("uri")) return;
  buffers.insert(buffers.begin(), OrderedJson{{"byteLength", 0}});
  for (OrderedJson& view : json["bufferViews"]) view["buffer"] = view["buffer"].get<std::size_t>() + 1;
}

}  // namespace

void rewrite_gltf(std::ostream& stream, std::string_view bytes, MeshFormat format, const std::string& name,
                  const PolygonMesh& mesh, const MeshWriteOptions& options) {
  GltfFile file = parse_gltf(bytes, format, name);
  const GltfMesh read = load_gltf(file, name);
  if (read.reading.mesh.positions.size() != mesh.positions.size()) {
    throw std::invalid_argument(fmt::format("the mesh has {} vertices; {} has {}", mesh.positions.size(),
                                            name, read.reading.mesh.positions.size()));
  }
  make_room(file.json);
  set_comments(file.json, options.comments);
  const std::size_t padded = (file.binary.size() + 3) / 4 * 4;
  Additions additions(file.json, padded);
  std::vector<GltfAttribute> written;
  for (std::size_t b = 0; b < read.blocks.size(); ++b) {
    const GltfBlock& block = read.blocks[b];
    for (GltfAttribute& attribute : gltf_attributes(mesh, block.first, block.count)) {
      const std::size_t accessor = additions.add(attribute);
      for (const GltfPrimitive& primitive : read.primitives) {
        if (primitive.block != b) continue;
        auto& of_file = file.json["meshes"][static_cast<std::size_t>(primitive.mesh)]["primitives"]
                                 [static_cast<std::size_t>(primitive.primitive)];
        of_file["attributes"][attribute.name] = accessor;
      }
      written.push_back(std::move(attribute));
    }
  }
  file.json["buffers"][0]["byteLength"] = additions.end();
  NumberWriter out(stream);
  write_glb_head(out, file.json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace), additions.end());
  out.text(file.binary);
  out.text(std::string(padded - file.binary.size(), '\0'));
  for (const GltfAttribute& attribute : written) attribute.write(out);
  out.finish();
}

}  // namespace solidnoise
