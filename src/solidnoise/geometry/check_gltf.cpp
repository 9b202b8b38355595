#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/gltf_file.h"

namespace solidnoise {
namespace {

using Source = nlohmann::ordered_json;
using Checked = nlohmann::json;

constexpr int kDeepest = 64;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return word;
}

Source parse_text(std::string_view text, const std::string& name) {
  bool too_deep = false;
  const Source::parser_callback_t watch = [&](int depth, Source::parse_event_t, Source&) {
    too_deep = too_deep || depth > kDeepest;
    return depth <= kDeepest;
  };
  Source json = Source::parse(text, watch, false);
  if (too_deep) refuse_gltf(name, fmt::format("its text is nested more than {} deep", kDeepest));
  if (json.is_discarded() || !json.is_object()) refuse_gltf(name, "its text is no JSON object");
  return json;
}

// Takes what it wants from a text, and refuses what is not as it must be.
class GltfCheck {
 public:
  GltfCheck(const GltfFile& file, const std::string& name) : file_(file), name_(name) {}

  Checked check() {
    const Source& json = file_.json;
    const Source* const asset = member(json, "asset");
    if (asset == nullptr || !asset->is_object() || !member(*asset, "version") ||
        !member(*asset, "version")->is_string() ||
        !member(*asset, "version")->get_ref<const std::string&>().starts_with("2."))
      refuse_gltf(name_, "asset.version must be \"2.0\"");
    refuse_version(json);
    refuse_extensions(json);
    counts_ = {list("buffers").size(), list("bufferViews").size(), list("accessors").size(),
               list("meshes").size(), list("nodes").size()};
    Checked checked{{"asset", {{"version", "2.0"}}}};
    each("buffers", checked,
         [&](const Source& from, const std::string& where) { return buffer(from, where); });
    each("bufferViews", checked,
         [&](const Source& from, const std::string& where) { return view(from, where); });
    each("accessors", checked,
         [&](const Source& from, const std::string& where) { return accessor(from, where); });
    each("meshes", checked, [&](const Source& from, const std::string& where) { return mesh(from, where); });
    each("nodes", checked, [&](const Source& from, const std::string& where) { return node(from, where); });
    each("scenes", checked, [&](const Source& from, const std::string& where) {
      return Checked{{"nodes", indices(from, where, "nodes", counts_.nodes)}};
    });
    refuse_circles(checked["nodes"]);
    if (const auto scene = index(json, "the file", "scene", checked["scenes"].size()))
      checked["scene"] = *scene;
    return checked;
  }

 private:
  struct Counts {
    std::size_t buffers = 0;
    std::size_t views = 0;
    std::size_t accessors = 0;
    std::size_t meshes = 0;
    std::size_t nodes = 0;
  };

  static const Source* member(const Source& from, const char* key) {
    const auto found = from.find(key);
    return found == from.end() ? nullptr : &*found;
  }

  const Source& list(const char* key) const {
    static const Source kNone = Source::array();
    const Source* const found = member(file_.json, key);
    if (found != nullptr && !found->is_array()) refuse_gltf(name_, fmt::format("{} must be a list", key));
    return found != nullptr ? *found : kNone;
  }

  template <typename Check>
  void each(const char* key, Checked& checked, const Check& check) const {
    Checked result = Checked::array();
    std::size_t i = 0;
    for (const Source& from : list(key)) {
      const std::string where = fmt::format("{}[{}]", key, i++);
      if (!from.is_object()) refuse_gltf(name_, fmt::format("{} must be an object", where));
      result.push_back(check(from, where));
    }
    checked[key] = std::move(result);
  }

  // A whole number below a limit, if there is one of this name.
  std::optional<std::int64_t> whole(const Source& from, const std::string& where, const char* key,
                                    double limit = kMostGltfBytes) const {
    const Source* const found = member(from, key);
    if (found == nullptr) return std::nullopt;
    const double number = found->is_number() ? found->get<double>() : -1.0;
    if (!(number >= 0.0 && number < limit) || number != std::floor(number))
      refuse_gltf(name_, fmt::format("{}.{} must be a whole number below {:.12g}", where, key, limit));
    return static_cast<std::int64_t>(number);
  }

  std::int64_t needed(const Source& from, const std::string& where, const char* key,
                      double limit = kMostGltfBytes) const {
    const auto number = whole(from, where, key, limit);
    if (!number) refuse_gltf(name_, fmt::format("{}.{} is missing", where, key));
    return *number;
  }

  std::optional<std::int64_t> index(const Source& from, const std::string& where, const char* key,
                                    std::size_t count) const {
    return whole(from, where, key, static_cast<double>(count));
  }

  Checked indices(const Source& from, const std::string& where, const char* key, std::size_t count) const {
    Checked result = Checked::array();
    const Source* const found = member(from, key);
    if (found == nullptr) return result;
    if (!found->is_array()) refuse_gltf(name_, fmt::format("{}.{} must be a list", where, key));
    for (const Source& item : *found) {
      const double number = item.is_number_integer() ? item.get<double>() : -1.0;
      if (!(number >= 0.0 && number < static_cast<double>(count)))
        refuse_gltf(name_, fmt::format("{}.{} must be whole numbers below {}", where, key, count));
      result.push_back(static_cast<std::int64_t>(number));
    }
    return result;
  }

  void refuse_extensions(const Source& json) const {
    const Source* const required = member(json, "extensionsRequired");
    if (required == nullptr) return;
    for (const Source& extension : *required) {
      const std::string word = extension.is_string() ? extension.get<std::string>() : "";
      if (word == "KHR_draco_mesh_compression" || word == "EXT_meshopt_compression") {
        refuse_gltf(name_, fmt::format("its meshes are compressed ({}); only plain ones are read", word));
      }
      // Materials, lights and animations do not move a mesh.
      constexpr std::string_view kHarmless[] = {"KHR_materials_", "KHR_texture_",   "KHR_lights_",
                                                "EXT_texture_",   "KHR_animation_", "KHR_mesh_quantization",
                                                "KHR_xmp"};
      if (!std::ranges::any_of(kHarmless, [&](std::string_view start) { return word.starts_with(start); })) {
        refuse_gltf(name_, fmt::format("it requires {}, which is not known here", printable(word)));
      }
    }
  }

  void refuse_version(const Source& json) const {
    const Source* const asset = member(json, "asset");
    const Source* const least = asset == nullptr ? nullptr : member(*asset, "minVersion");
    if (least == nullptr) return;
    const std::string version = least->is_string() ? least->get<std::string>() : "";
    if (version != "2.0") {
      refuse_gltf(name_, fmt::format("asset.minVersion is {}; glTF 2.0 is read", printable(version)));
    }
  }

  Checked buffer(const Source& from, const std::string& where) const {
    Checked result{{"byteLength", needed(from, where, "byteLength")}};
    if (result["byteLength"] == 0) refuse_gltf(name_, fmt::format("{}.byteLength must be at least 1", where));
    const Source* const uri = member(from, "uri");
    if (uri == nullptr) {
      if (where != "buffers[0]" || file_.binary.empty())
        refuse_gltf(name_, fmt::format("{} has no bytes: no uri, nor a part of the file", where));
      return result;
    }
    if (!uri->is_string()) refuse_gltf(name_, fmt::format("{}.uri must be a text", where));
    const auto& text = uri->get_ref<const std::string&>();
    const bool beside = !text.empty() && text.front() != '/' && text.find("..") == std::string::npos &&
                        text.find(':') == std::string::npos && text.find('%') == std::string::npos &&
                        text.find('\\') == std::string::npos && text.front() != '~';
    if (!text.starts_with("data:") && !beside) {
      refuse_gltf(name_,
                  fmt::format("{}.uri is {}; it must be the name of a file beside it, without %, or data",
                              where, printable(text)));
    }
    result["uri"] = text;
    return result;
  }

  Checked view(const Source& from, const std::string& where) const {
    const auto number = [&](const char* key) { return whole(from, where, key).value_or(0); };
    Checked result{{"buffer", needed(from, where, "buffer", static_cast<double>(counts_.buffers))},
                   {"byteOffset", number("byteOffset")},
                   {"byteLength", needed(from, where, "byteLength")}};
    if (const auto stride = whole(from, where, "byteStride", 253.0)) result["byteStride"] = *stride;
    return result;
  }

  Checked accessor(const Source& from, const std::string& where) const {
    Checked result{{"componentType", needed(from, where, "componentType", 6000.0)},
                   {"count", needed(from, where, "count", 4294967295.0)}};
    if (const auto view = index(from, where, "bufferView", counts_.views)) result["bufferView"] = *view;
    result["byteOffset"] = whole(from, where, "byteOffset").value_or(0);
    if (const Source* const normalized = member(from, "normalized"))
      result["normalized"] = normalized->is_boolean() && normalized->get<bool>();
    const Source* const type = member(from, "type");
    if (type == nullptr || !type->is_string()) refuse_gltf(name_, fmt::format("{}.type is missing", where));
    result["type"] = type->get<std::string>();
    // Which accessors the mesh needs is known later: a mark, of bytes that are not there.
    if (member(from, "sparse") != nullptr) result.erase("bufferView");
    return result;
  }

  Checked mesh(const Source& from, const std::string& where) const {
    Checked result{{"primitives", Checked::array()}};
    const Source* const primitives = member(from, "primitives");
    if (primitives == nullptr || !primitives->is_array())
      refuse_gltf(name_, fmt::format("{}.primitives must be a list", where));
    std::size_t i = 0;
    for (const Source& item : *primitives) {
      result["primitives"].push_back(primitive(item, fmt::format("{}.primitives[{}]", where, i++)));
    }
    return result;
  }

  Checked primitive(const Source& from, const std::string& where) const {
    const Source* const attributes = from.is_object() ? member(from, "attributes") : nullptr;
    if (attributes == nullptr || !attributes->is_object())
      refuse_gltf(name_, fmt::format("{}.attributes must be an object", where));
    Checked result{{"attributes", Checked::object()}, {"mode", whole(from, where, "mode", 7.0).value_or(4)}};
    for (const char* const key : {"POSITION", "TEXCOORD_0"}) {
      if (const auto found = index(*attributes, where + ".attributes", key, counts_.accessors))
        result["attributes"][key] = *found;
    }
    if (const auto found = index(from, where, "indices", counts_.accessors)) result["indices"] = *found;
    return result;
  }

  Checked node(const Source& from, const std::string& where) const {
    Checked result{{"children", indices(from, where, "children", counts_.nodes)}};
    if (const auto mesh = index(from, where, "mesh", counts_.meshes)) result["mesh"] = *mesh;
    // A skinned mesh is where its joints say, whatever its node.
    if (member(from, "skin") != nullptr) return result;
    for (const auto& [key, count] : {std::pair("matrix", 16), std::pair("translation", 3),
                                     std::pair("rotation", 4), std::pair("scale", 3)}) {
      const Source* const numbers = member(from, key);
      if (numbers == nullptr) continue;
      const bool fits = numbers->is_array() && numbers->size() == static_cast<std::size_t>(count) &&
                        std::all_of(numbers->begin(), numbers->end(),
                                    [](const Source& number) { return number.is_number(); });
      if (!fits) refuse_gltf(name_, fmt::format("{}.{} must be {} numbers", where, key, count));
      result[key] = Checked::array();
      for (const Source& number : *numbers) result[key].push_back(number.get<double>());
    }
    return result;
  }

  // Each node may have one parent; then whoever goes up from it comes to an end, or round.
  void refuse_circles(const Checked& nodes) const {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> parents(nodes.size(), kNone);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (const Checked& child : nodes[i]["children"]) {
        if (parents[child.get<std::size_t>()] != kNone)
          refuse_gltf(name_, fmt::format("nodes[{}] has two parents", child.get<std::size_t>()));
        parents[child.get<std::size_t>()] = i;
      }
    }
    std::vector<char> done(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      std::vector<std::size_t> path;
      std::size_t at = i;
      while (at != kNone && done[at] == 0) {
        done[at] = 2;
        path.push_back(at);
        at = parents[at];
      }
      if (at != kNone && done[at] == 2) refuse_gltf(name_, fmt::format("nodes[{}] is its own ancestor", at));
      for (const std::size_t node : path) done[node] = 1;
    }
  }

  const GltfFile& file_;
  const std::string& name_;
  Counts counts_;
};

}  // namespace

void refuse_gltf(const std::string& name, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", name, what));
}

GltfFile parse_gltf(std::string_view bytes, MeshFormat format, const std::string& name) {
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
  constexpr std::uint32_t kBinaryChunk = 0x004E4942;
  GltfFile file;
  if (format == MeshFormat::gltf) {
    file.json = parse_text(bytes, name);
    return file;
  }
  if (bytes.size() < 20 || !bytes.starts_with("glTF") || word_at(bytes, 4) != 2)
    refuse_gltf(name, "it is no .glb of glTF 2");
  if (word_at(bytes, 8) > bytes.size()) refuse_gltf(name, "it is cut short");
  bytes = bytes.substr(0, word_at(bytes, 8));
  if (bytes.size() < 20) refuse_gltf(name, "it is cut short");
  std::string_view rest = bytes.substr(12);
  bool has_text = false;
  while (rest.size() >= 8) {
    const std::uint32_t length = word_at(rest, 0);
    const std::uint32_t type = word_at(rest, 4);
    if (length > rest.size() - 8) refuse_gltf(name, "it is cut short");
    const std::string_view chunk = rest.substr(8, length);
    rest.remove_prefix(8 + std::size_t{length});
    if (!has_text && type != kJsonChunk) refuse_gltf(name, "its first part must be its text");
    if (!has_text) file.json = parse_text(chunk, name);
    if (has_text && type == kBinaryChunk && file.binary.empty()) file.binary = chunk;
    has_text = true;
  }
  if (!has_text) refuse_gltf(name, "it has no text");
  return file;
}

nlohmann::json checked_gltf(const GltfFile& file, const std::string& name) {
  return GltfCheck(file, name).check();
}

}  // namespace solidnoise
