#include <functional>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/scene_values.h"

// Pixar's Universal Scene Description as text: a UsdGeomMesh, or UsdGeomPoints where there are no faces.
namespace solidnoise {
namespace {

class PrimWriter {
 public:
  explicit PrimWriter(NumberWriter& out) : out_(out) {}

  // An attribute: `count` times `width` numbers, in parentheses where there are several.
  void floats(std::string_view declaration, std::size_t count, std::size_t width,
              const std::function<double(std::size_t item, std::size_t part)>& value) {
    list(declaration, count, [&](std::size_t item) {
      if (width > 1) out_.text("(");
      for (std::size_t part = 0; part < width; ++part) {
        if (part > 0) out_.text(", ");
        out_.finite_decimal(float_value(value(item, part)), ScalarType::float32);
      }
      if (width > 1) out_.text(")");
    });
  }

  void integers(std::string_view declaration, std::size_t count,
                const std::function<std::uint64_t(std::size_t item)>& value) {
    list(declaration, count, [&](std::size_t item) { out_.decimal(value(item)); });
    out_.text("\n");
  }

  void of_vertices() { out_.text(" (\n        interpolation = \"vertex\"\n    )\n"); }

 private:
  void list(std::string_view declaration, std::size_t count, const std::function<void(std::size_t)>& write) {
    out_.text(fmt::format("    {} = [", declaration));
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) out_.text(i % 8 == 0 ? ",\n        " : ", ");
      write(i);
    }
    out_.text("]");
  }

  NumberWriter& out_;
};

void write_head(NumberWriter& out, const MeshWriteOptions& options) {
  out.text(
      fmt::format("#usda 1.0\n(\n    defaultPrim = \"mesh\"\n    metersPerUnit = 1\n    upAxis = \"{}\"\n",
                  options.up == UpAxis::z ? "Z" : "Y"));
  if (!options.comments.empty()) {
    out.text("    customLayerData = {\n        string[] comments = [");
    for (std::size_t i = 0; i < options.comments.size(); ++i) {
      out.text((i > 0 ? ", " : "") + quoted_text(options.comments[i]));
    }
    out.text("]\n    }\n");
  }
  out.text(")\n\n");
}

void write_primvars(PrimWriter& prim, const PolygonMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  if (const auto channels = color_channels(mesh); !channels.empty()) {
    prim.floats("color3f[] primvars:displayColor", count, 3,
                [&](std::size_t vertex, std::size_t part) { return linear_color(*channels[part], vertex); });
    prim.of_vertices();
    if (channels.size() > 3) {
      prim.floats("float[] primvars:displayOpacity", count, 1,
                  [&](std::size_t vertex, std::size_t) { return linear_color(*channels[3], vertex); });
      prim.of_vertices();
    }
  }
  if (const auto texture = texture_coordinates(mesh); !texture.empty()) {
    prim.floats("texCoord2f[] primvars:st", count, 2,
                [&](std::size_t vertex, std::size_t part) { return texture[part]->values[vertex]; });
    prim.of_vertices();
  }
  std::set<std::string> names{"displayColor", "displayOpacity", "st"};
  for (const SceneNumber& number : plain_vectors(mesh)) {
    const std::string name = usd_name(number.name);
    if (!names.insert(name).second) {
      throw std::invalid_argument(
          fmt::format("two properties are primvars:{} in a .usda, one of them {}", name, number.name));
    }
    const char* const type = number.parts.size() == 3 ? "vector3f" : "float";
    prim.floats(fmt::format("{}[] primvars:{}", type, name), count, number.parts.size(),
                [&](std::size_t vertex, std::size_t part) { return number.parts[part]->values[vertex]; });
    prim.of_vertices();
  }
}

}  // namespace

void write_usda(std::ostream& stream, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  require_float_positions(mesh, "USD");
  NumberWriter out(stream);
  write_head(out, options);
  const bool has_faces = mesh.face_count() > 0;
  const std::size_t count = mesh.positions.size();
  out.text(has_faces ? "def Mesh \"mesh\"\n{\n" : "def Points \"mesh\"\n{\n");
  PrimWriter prim(out);
  const FloatBox box = float_box(mesh);
  prim.floats("float3[] extent", 2, 3, [&](std::size_t corner, std::size_t axis) {
    return (corner == 0 ? box.lower : box.upper)[static_cast<int>(axis)];
  });
  out.text("\n");
  prim.floats("point3f[] points", count, 3, [&](std::size_t vertex, std::size_t axis) {
    return mesh.positions[vertex][static_cast<int>(axis)];
  });
  out.text("\n");
  if (has_faces) {
    prim.integers("int[] faceVertexCounts", mesh.face_count(),
                  [&](std::size_t f) { return mesh.face(f).size(); });
    prim.integers("int[] faceVertexIndices", mesh.corners.size(),
                  [&](std::size_t c) { return mesh.corners[c]; });
    const std::vector<Vec<3>> normals = unit_normals(mesh);
    prim.floats("normal3f[] normals", count, 3, [&](std::size_t vertex, std::size_t axis) {
      return normals[vertex][static_cast<int>(axis)];
    });
    prim.of_vertices();
    out.text("    uniform token subdivisionScheme = \"none\"\n");
  }
  write_primvars(prim, mesh);
  out.text("}\n");
  out.finish();
}

}  // namespace solidnoise
