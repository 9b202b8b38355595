#include "solidnoise/geometry/mesh_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace solidnoise {
namespace {

constexpr std::array<std::pair<std::string_view, MeshFormat>, 5> kExtensions{{{".ply", MeshFormat::ply},
                                                                              {".obj", MeshFormat::obj},
                                                                              {".off", MeshFormat::off},
                                                                              {".stl", MeshFormat::stl},
                                                                              {".om", MeshFormat::om}}};

std::optional<MeshFormat> find_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [name, format] : kExtensions) {
    if (extension == name) return format;
  }
  return std::nullopt;
}

}  // namespace

MeshFormat mesh_format(const std::filesystem::path& path) {
  const std::optional<MeshFormat> format = find_format(path);
  if (!format) {
    throw std::runtime_error(fmt::format(
        "{}: is not a mesh by its name; .ply, .obj, .off, .stl and .om are known", path.string()));
  }
  return *format;
}

bool is_mesh_path(const std::filesystem::path& path) {
  return find_format(path).has_value();
}

}  // namespace solidnoise
