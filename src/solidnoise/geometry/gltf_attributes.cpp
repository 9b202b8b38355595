#include "solidnoise/geometry/gltf_attributes.h"

#include <array>
#include <cctype>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/geometry/scene_values.h"

namespace solidnoise {
namespace {

// A property's name as an attribute's: those that are not of the format begin with _ and are in capitals.
std::string attribute_name(const std::string& name) {
  std::string result = "_";
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    result += std::isalnum(letter) != 0 && letter < 0x80 ? static_cast<char>(std::toupper(letter)) : '_';
  }
  return result;
}

// In 16 bits of linear light: the darkest step of 8 bits of sRGB is 20 of them.
GltfAttribute colors(const std::vector<const VertexProperty*>& channels, std::size_t first,
                     std::size_t count) {
  constexpr int kUnsignedShort = 5123;
  GltfAttribute result{"COLOR_0", "VEC4", kUnsignedShort, count, count * 4 * sizeof(std::uint16_t), true};
  result.write = [=](NumberWriter& out) {
    constexpr double kOne = std::numeric_limits<std::uint16_t>::max();
    for (std::size_t v = first; v < first + count; ++v) {
      for (std::size_t c = 0; c < 4; ++c) {
        out.bytes(c < channels.size() ? kOne * linear_color(*channels[c], v) : kOne, ScalarType::uint16);
      }
    }
  };
  return result;
}

}  // namespace

GltfAttribute gltf_floats(const std::string& name, std::size_t width, std::size_t first, std::size_t count,
                          const std::function<double(std::size_t vertex, std::size_t part)>& value) {
  constexpr std::array kTypes{"SCALAR", "VEC2", "VEC3"};
  GltfAttribute result{name, kTypes[width - 1], kGltfFloat, count, count * width * sizeof(float)};
  result.write = [=](NumberWriter& out) {
    for (std::size_t v = first; v < first + count; ++v) {
      for (std::size_t part = 0; part < width; ++part)
        out.bytes(float_value(value(v, part)), ScalarType::float32);
    }
  };
  return result;
}

std::vector<GltfAttribute> gltf_attributes(const PolygonMesh& mesh, std::size_t first, std::size_t count) {
  std::vector<GltfAttribute> attributes;
  if (const auto channels = color_channels(mesh); !channels.empty())
    attributes.push_back(colors(channels, first, count));
  std::set<std::string> names;
  for (const VertexProperty* number : plain_numbers(mesh)) {
    const std::string name = attribute_name(number->name);
    if (!names.insert(name).second) {
      throw std::invalid_argument(
          fmt::format("two properties are {} in a .glb, one of them {}", name, number->name));
    }
    attributes.push_back(gltf_floats(
        name, 1, first, count, [number](std::size_t vertex, std::size_t) { return number->values[vertex]; }));
  }
  return attributes;
}

void write_glb_head(NumberWriter& out, std::string text, std::size_t bytes) {
  constexpr std::size_t kHead = 12;
  constexpr std::size_t kChunkHead = 8;
  text.append((4 - text.size() % 4) % 4, ' ');
  const std::size_t size = kHead + kChunkHead + text.size() + kChunkHead + bytes;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument(fmt::format("a .glb has at most 4 GiB, this would have {} bytes", size));
  }
  const auto number = [&](std::size_t value) { out.bytes(static_cast<double>(value), ScalarType::uint32); };
  out.text("glTF");
  number(2);
  number(size);
  number(text.size());
  out.text("JSON");
  out.text(text);
  number(bytes);
  out.text(std::string_view("BIN\0", 4));
}

}  // namespace solidnoise
