#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "support/mesh_text.h"
#include "support/temporary_folder.h"

// What OpenMesh writes we read, and what we write it reads: a second opinion on each format.
namespace solidnoise::exchange_test {
namespace {

struct FloatTraits : OpenMesh::DefaultTraits {
  using Color = OpenMesh::Vec4uc;
  VertexAttributes(OpenMesh::Attributes::Color | OpenMesh::Attributes::Normal);
};
struct DoubleTraits : FloatTraits {
  using Point = OpenMesh::Vec3d;
};
using FloatMesh = OpenMesh::PolyMesh_ArrayKernelT<FloatTraits>;
using DoubleMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using Options = OpenMesh::IO::Options;

// A pyramid on a square, with colours and, as they come back unchanged in any format, short decimals.
PolygonMesh pyramid() {
  PolygonMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0.125}, {0, 0, 1.5}};
  mesh.add_face(std::array{3u, 2u, 1u, 0u});
  for (std::uint32_t k = 0; k < 4; ++k) mesh.add_face(std::array{k, (k + 1) % 4, 4u});
  for (std::size_t c = 0; c < 3; ++c) {
    VertexProperty channel{std::string(kColorNames[c]), ScalarType::uint8, {}};
    for (std::size_t v = 0; v < 5; ++v)
      channel.values.push_back(static_cast<double>((v * 60 + c * 17) % 256));
    mesh.properties.push_back(channel);
  }
  return mesh;
}

template <typename Mesh>
Mesh to_openmesh(const PolygonMesh& mesh) {
  Mesh result;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec<3>& p = mesh.positions[v];
    using Scalar = typename Mesh::Scalar;
    const auto handle =
        result.add_vertex({static_cast<Scalar>(p.x), static_cast<Scalar>(p.y), static_cast<Scalar>(p.z)});
    OpenMesh::Vec4uc color(0, 0, 0, 255);
    for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<unsigned char>(mesh.properties[c].values[v]);
    result.set_color(handle, color);
    result.set_normal(handle, {0, 0, 1});
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<typename Mesh::VertexHandle> corners;
    for (const std::uint32_t corner : mesh.face(f)) corners.emplace_back(static_cast<int>(corner));
    result.add_face(corners);
  }
  return result;
}

// The corners of a face, from the smallest on: OpenMesh does not keep where a face begins.
std::vector<std::uint32_t> turned(std::vector<std::uint32_t> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

void expect_same_shape(const PolygonMesh& mesh, const PolygonMesh& expected) {
  EXPECT_EQ(mesh.positions, expected.positions);
  ASSERT_EQ(mesh.face_count(), expected.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    EXPECT_EQ(turned(corners_of(mesh, f)), turned(corners_of(expected, f))) << "face " << f;
  }
}

void expect_same_colors(const PolygonMesh& mesh, const PolygonMesh& expected) {
  for (std::size_t c = 0; c < 3; ++c) {
    const VertexProperty* const channel = mesh.property(kColorNames[c]);
    ASSERT_NE(channel, nullptr);
    EXPECT_EQ(channel->type, ScalarType::uint8);
    EXPECT_EQ(channel->values, expected.properties[c].values);
  }
}

TEST(FromOpenMesh, ReadsEveryFormatThatItWrites) {
  const TemporaryFolder folder;
  const PolygonMesh expected = pyramid();
  FloatMesh mesh = to_openmesh<FloatMesh>(expected);
  struct Case {
    const char* name;
    Options options;
    bool colors;
  };
  const Options color = Options::VertexColor;
  const Case cases[] = {
      {"plain.ply", Options::Default, false},
      {"text.ply", color, true},
      {"little.ply", color + Options::Binary, true},
      {"big.ply", color + Options::Binary + Options::MSB, true},
      {"plain.obj", Options::Default, false},
      {"plain.off", Options::Default, false},
      {"color.off", color, true},
      {"normal.off", color + Options::VertexNormal, true},
      {"plain.om", Options::Default, false},
      {"color.om", color + Options::VertexNormal, true},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, (folder / one.name).string(), one.options));
    const PolygonMesh read = read_mesh(folder / one.name).mesh;
    expect_same_shape(read, expected);
    if (one.colors) expect_same_colors(read, expected);
    if (one.options.vertex_has_normal()) {
      ASSERT_NE(read.property("nz"), nullptr);
      EXPECT_EQ(read.property("nz")->values, std::vector<double>(5, 1.0));
    }
  }
}

TEST(FromOpenMesh, MergesTheFacetsOfStl) {
  const TemporaryFolder folder;
  PolygonMesh triangles = pyramid();
  triangles.face_starts = {0};
  triangles.corners.clear();
  for (const Triangle& triangle : triangulate(pyramid())) triangles.add_face(triangle);
  FloatMesh mesh = to_openmesh<FloatMesh>(triangles);
  for (const auto& [name, options] : {std::pair{"text.stla", Options(Options::Default)},
                                      std::pair{"binary.stlb", Options(Options::Binary)}}) {
    ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, (folder / name).string(), options));
    std::filesystem::rename(folder / name, folder / "mesh.stl");
    const PolygonMesh read = read_mesh(folder / "mesh.stl").mesh;
    ASSERT_EQ(read.positions.size(), 5u);
    ASSERT_EQ(read.face_count(), 6u);
    for (std::size_t f = 0; f < 6; ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(read.positions[read.face(f)[k]], triangles.positions[triangles.face(f)[k]]);
      }
    }
  }
}

TEST(FromOpenMesh, KeepsDoublesAndNumbersOfItsOwnFormat) {
  const TemporaryFolder folder;
  PolygonMesh expected = pyramid();
  expected.positions[4] = {0.1, 1e-17, 1e6 + 0.1};
  DoubleMesh mesh = to_openmesh<DoubleMesh>(expected);
  OpenMesh::VPropHandleT<float> noise;
  mesh.add_property(noise, "noise");
  mesh.property(noise).set_persistent(true);
  for (const auto vertex : mesh.vertices())
    mesh.property(noise, vertex) = 0.5f * static_cast<float>(vertex.idx());
  OpenMesh::VPropHandleT<std::string> label;
  mesh.add_property(label, "label");
  mesh.property(label).set_persistent(true);
  ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, (folder / "mesh.om").string(),
                                       Options(Options::VertexColor) + Options::Custom));
  const MeshReading reading = read_mesh(folder / "mesh.om");
  EXPECT_EQ(reading.mesh.position_type, ScalarType::float64);
  expect_same_shape(reading.mesh, expected);
  ASSERT_NE(reading.mesh.property("noise"), nullptr);
  EXPECT_EQ(reading.mesh.property("noise")->type, ScalarType::float32);
  EXPECT_EQ(reading.mesh.property("noise")->values, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(reading.notes, std::vector<std::string>{"property 'label' is dropped"});
}

template <typename Mesh>
void expect_same(Mesh& mesh, const PolygonMesh& expected) {
  ASSERT_EQ(mesh.n_vertices(), expected.positions.size());
  ASSERT_EQ(mesh.n_faces(), expected.face_count());
  for (const auto vertex : mesh.vertices()) {
    const auto index = static_cast<std::size_t>(vertex.idx());
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(mesh.point(vertex)[static_cast<std::size_t>(axis)], expected.positions[index][axis]);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(mesh.color(vertex)[c], expected.properties[c].values[index]) << "vertex " << index;
    }
  }
  for (const auto face : mesh.faces()) {
    std::vector<std::uint32_t> corners;
    for (const auto vertex : face.vertices()) corners.push_back(static_cast<std::uint32_t>(vertex.idx()));
    EXPECT_EQ(turned(corners), turned(corners_of(expected, static_cast<std::size_t>(face.idx()))));
  }
}

TEST(ToOpenMesh, ReadsEveryFormatThatWeWrite) {
  const TemporaryFolder folder;
  const PolygonMesh expected = pyramid();
  for (const std::string name : {"text.ply", "little.ply", "big.ply", "mesh.obj", "mesh.off", "mesh.om"}) {
    SCOPED_TRACE(name);
    MeshWriteOptions options;
    if (name == "text.ply") options.ply = PlyEncoding::ascii;
    if (name == "big.ply") options.ply = PlyEncoding::binary_big_endian;
    write_mesh(folder / name, expected, options);
    FloatMesh mesh;
    Options wanted = Options::VertexColor;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, (folder / name).string(), wanted));
    EXPECT_TRUE(wanted.vertex_has_color());
    expect_same(mesh, expected);
  }
}

TEST(ToOpenMesh, ReadsDoublesAndTrianglesOfItsOwnFormat) {
  const TemporaryFolder folder;
  PolygonMesh expected = pyramid();
  expected.positions[4] = {0.1, 1e-17, 1e6 + 0.1};
  expected.position_type = ScalarType::float64;
  expected.face_starts = {0};
  expected.corners.clear();
  for (const Triangle& triangle : triangulate(pyramid())) expected.add_face(triangle);
  for (const std::string_view name : kNormalNames) {
    expected.properties.push_back({std::string(name), ScalarType::float32, std::vector<double>(5, 0.5)});
  }
  write_mesh(folder / "mesh.om", expected);
  DoubleMesh mesh;
  Options wanted = Options::VertexColor + Options(Options::VertexNormal);
  ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, (folder / "mesh.om").string(), wanted));
  EXPECT_TRUE(wanted.vertex_has_normal());
  expect_same(mesh, expected);
  EXPECT_EQ(mesh.normal(OpenMesh::VertexHandle(2)), DoubleMesh::Normal(0.5, 0.5, 0.5));
}

}  // namespace
}  // namespace solidnoise::exchange_test
