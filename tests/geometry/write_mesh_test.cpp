#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <ostream>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "support/mesh_text.h"
#include "support/message_of.h"
#include "support/sample_meshes.h"
#include "support/temporary_folder.h"

namespace solidnoise::write_mesh_test {
namespace {

MeshReading again(const PolygonMesh& mesh, MeshFormat format, const MeshWriteOptions& options = {}) {
  return read_mesh(written(mesh, format, options), format, "again");
}

// Texts have the shortest decimals that are the same number in the positions' type, not beyond.
void expect_same_shape(const PolygonMesh& mesh, const PolygonMesh& expected) {
  if (mesh.position_type == ScalarType::float64) {
    EXPECT_TRUE(mesh.positions == expected.positions);
  } else {
    const std::vector<glm::vec3> floats(mesh.positions.begin(), mesh.positions.end());
    const std::vector<glm::vec3> expected_floats(expected.positions.begin(), expected.positions.end());
    EXPECT_TRUE(floats == expected_floats);
  }
  EXPECT_EQ(mesh.face_starts, expected.face_starts);
  EXPECT_EQ(mesh.corners, expected.corners);
}

void expect_same_values(const PolygonMesh& mesh, const PolygonMesh& expected, const std::string& name) {
  ASSERT_NE(mesh.property(name), nullptr) << name;
  EXPECT_EQ(mesh.property(name)->values, expected.property(name)->values) << name;
}

constexpr PlyEncoding kEncodings[] = {PlyEncoding::ascii, PlyEncoding::binary_little_endian,
                                      PlyEncoding::binary_big_endian};

TEST(WriteMesh, PlyKeepsEverythingInItsOrder) {
  for (const ScalarType position_type : {ScalarType::float32, ScalarType::float64}) {
    PolygonMesh mesh = awkward_mesh();
    mesh.position_type = position_type;
    if (position_type == ScalarType::float64) mesh.positions[2] = {0.1, 1.0 / 3.0, 1e300};
    for (const PlyEncoding encoding : kEncodings) {
      const MeshReading reading =
          again(mesh, MeshFormat::ply, {.ply = encoding, .comments = {"one", "two\nthree", ""}});
      expect_same_shape(reading.mesh, mesh);
      EXPECT_EQ(reading.mesh.position_type, position_type);
      ASSERT_EQ(reading.mesh.properties.size(), mesh.properties.size());
      for (std::size_t i = 0; i < mesh.properties.size(); ++i) {
        EXPECT_EQ(reading.mesh.properties[i].name, mesh.properties[i].name);
        EXPECT_EQ(reading.mesh.properties[i].type, mesh.properties[i].type);
        EXPECT_EQ(reading.mesh.properties[i].values, mesh.properties[i].values) << mesh.properties[i].name;
      }
      EXPECT_EQ(reading.comments, (std::vector<std::string>{"one", "two", "three", ""}));
      EXPECT_TRUE(reading.notes.empty());
    }
  }
}

TEST(WriteMesh, PlyHasTheHeaderThatReadersExpect) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}};
  mesh.add_face(std::array{0u, 1u, 2u});
  mesh.properties = {{"red", ScalarType::uint8, {1, 2, 3}}, {"noise", ScalarType::float32, {0.5, -1, 0.1}}};
  const std::string header =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
      "property float noise\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_EQ(written(mesh, MeshFormat::ply, {.ply = PlyEncoding::ascii, .comments = {"by us"}}),
            "ply\nformat ascii 1.0\ncomment by us\n" + header +
                "0 0 0 1 0.5\n1 0 0 2 -1\n0 0.5 0 3 0.1\n3 0 1 2\n");
  EXPECT_TRUE(written(mesh, MeshFormat::ply).starts_with("ply\nformat binary_little_endian 1.0\n" + header));
}

TEST(WriteMesh, ObjKeepsShapeColoursAndNormals) {
  const PolygonMesh mesh = awkward_mesh();
  const MeshReading reading = again(mesh, MeshFormat::obj, {.comments = {"made by us"}});
  expect_same_shape(reading.mesh, mesh);
  EXPECT_EQ(reading.comments, std::vector<std::string>{"made by us"});
  for (const std::string name : {"nx", "ny", "nz"}) expect_same_values(reading.mesh, mesh, name);
  for (const std::string name : {"red", "green", "blue"}) {
    const VertexProperty* const channel = reading.mesh.property(name);
    ASSERT_NE(channel, nullptr);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      // A float32 tells 255 levels apart: the byte comes back.
      EXPECT_EQ(std::round(channel->values[v] * 255), mesh.property(name)->values[v]);
    }
  }
  EXPECT_EQ(reading.mesh.properties.size(), 6u);
}

TEST(WriteMesh, ObjHasShortestDecimals) {
  PolygonMesh mesh;
  mesh.positions = {{static_cast<double>(0.1f), 0.1, 1e20}, {-1, 0, 1.0 / 3.0}, {0, 0, 1e-20}};
  mesh.add_face(std::array{0u, 1u, 2u});
  for (const auto name : kColorNames)
    mesh.properties.push_back({std::string(name), ScalarType::uint8, {0, 51, 255}});
  EXPECT_EQ(written(mesh, MeshFormat::obj),
            "v 0.1 0.1 1e+20 0 0 0\nv -1 0 0.3333333333333333 0.2 0.2 0.2\nv 0 0 1e-20 1 1 1\nf 1 2 3\n");
}

TEST(WriteMesh, ObjAndOffHaveZeroForWhatIsNotFinite) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.add_face(std::array{0u, 1u, 2u});
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto name : {"red", "green", "blue", "nx", "ny", "nz"}) {
    mesh.properties.push_back({name, ScalarType::float32, {infinity, std::nan(""), 1e99}});
  }
  EXPECT_EQ(written(mesh, MeshFormat::obj),
            "v 0 0 0 0 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nvn 0 0 0\nvn 0 0 0\nvn 0 0 0\nf 1//1 2//2 3//3\n");
  EXPECT_EQ(written(mesh, MeshFormat::off),
            "CNOFF\n3 1 0\n0 0 0 0 0 0 255 255 255 255\n1 0 0 0 0 0 0 0 0 255\n0 1 0 0 0 0 255 255 255 255\n"
            "3 0 1 2\n");
}

TEST(WriteMesh, OffKeepsShapeColoursAndNormals) {
  const PolygonMesh mesh = awkward_mesh();
  const MeshReading reading = again(mesh, MeshFormat::off, {.comments = {"made by us"}});
  expect_same_shape(reading.mesh, mesh);
  EXPECT_EQ(reading.comments, std::vector<std::string>{"made by us"});
  for (const std::string name : {"nx", "ny", "nz", "red", "green", "blue"}) {
    expect_same_values(reading.mesh, mesh, name);
  }
  EXPECT_EQ(reading.mesh.properties.size(), 6u);
}

TEST(WriteMesh, OffRoundsAndClampsColours) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.add_face(std::array{0u, 1u, 2u});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.properties = {{"red", ScalarType::float32, {0.5, 1.75, -1}},
                     {"green", ScalarType::float64, {nan, 0.1, 1}},
                     {"blue", ScalarType::uint16, {65535, 257, 0}},
                     {"alpha", ScalarType::uint8, {255, 0, 7}}};
  EXPECT_EQ(written(mesh, MeshFormat::off),
            "COFF\n3 1 0\n0 0 0 128 0 255 255\n1 0 0 255 26 1 0\n0 1 0 0 255 0 7\n3 0 1 2\n");
}

TEST(WriteMesh, OmKeepsShapeColoursNormalsAndNumbers) {
  for (const ScalarType position_type : {ScalarType::float32, ScalarType::float64}) {
    PolygonMesh mesh = awkward_mesh();
    mesh.position_type = position_type;
    const MeshReading reading = again(mesh, MeshFormat::om);
    expect_same_shape(reading.mesh, mesh);
    EXPECT_EQ(reading.mesh.position_type, position_type);
    ASSERT_EQ(reading.mesh.properties.size(), mesh.properties.size());
    for (const VertexProperty& property : mesh.properties) {
      expect_same_values(reading.mesh, mesh, property.name);
      EXPECT_EQ(reading.mesh.property(property.name)->type, property.type) << property.name;
    }
    EXPECT_TRUE(reading.notes.empty());
  }
}

TEST(WriteMesh, StlHasTheTrianglesAlone) {
  const PolygonMesh mesh = awkward_mesh();
  const PolygonMesh read = again(mesh, MeshFormat::stl).mesh;
  const std::vector<Triangle> triangles = triangulate(mesh);
  ASSERT_EQ(read.face_count(), triangles.size());
  EXPECT_TRUE(read.properties.empty());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(glm::vec3(read.positions[read.face(f)[k]]), glm::vec3(mesh.positions[triangles[f][k]]));
    }
  }
}

TEST(WriteMesh, ConvertsBetweenAllFormats) {
  const PolygonMesh mesh = awkward_mesh();
  PolygonMesh current = mesh;
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::om, MeshFormat::off, MeshFormat::ply,
                                  MeshFormat::obj, MeshFormat::ply}) {
    current = again(current, format).mesh;
    expect_same_shape(current, mesh);
  }
}

TEST(WriteMesh, WidensTheTypesThatDoNotSuffice) {
  PolygonMesh mesh = awkward_mesh();
  std::vector<std::uint32_t> large(300);
  for (std::size_t k = 0; k < large.size(); ++k) large[k] = static_cast<std::uint32_t>(k % 7);
  mesh.add_face(large);
  mesh.positions[6].x = 1e39;  // no float32
  for (const MeshFormat format : {MeshFormat::ply, MeshFormat::om})
    expect_same_shape(again(mesh, format).mesh, mesh);
}

TEST(WriteMesh, RefusesOrLeavesOutFacesThatAFormatCannotHold) {
  PolygonMesh mesh = awkward_mesh();
  mesh.add_face({});
  EXPECT_EQ(again(mesh, MeshFormat::ply).mesh.face_count(), 5u);
  EXPECT_EQ(again(mesh, MeshFormat::obj).mesh.face_count(), 4u);
  mesh.add_face(std::vector<std::uint32_t>(65536, 1u));
  EXPECT_EQ(again(mesh, MeshFormat::ply).mesh.face(5).size(), 65536u);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { written(mesh, MeshFormat::om); }),
            "face 4 has no vertices; OM holds none such");
}

TEST(WriteMesh, RefusesWhatOpenMeshWouldSpoil) {
  PolygonMesh mesh = awkward_mesh();
  mesh.positions[6].x = 1e39;
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::stl}) {
    EXPECT_EQ(message_of<std::invalid_argument>([&] { written(mesh, format); }),
              "a vertex is at (1e+39, 8, 9), beyond the numbers of OFF and STL; PLY holds it");
  }
  // Vertices in no face, which OpenMesh would number in as many bits as its edges take.
  PolygonMesh points = awkward_mesh();
  points.properties.clear();
  points.positions.resize(128);
  expect_same_shape(again(points, MeshFormat::om).mesh, points);
  points.positions.resize(129);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { written(points, MeshFormat::om); }),
            "there are 129 vertices but 10 edges; OM gives them 8 bits");
}

TEST(WriteMesh, DoesNotHeedTheLocale) {
  class Commas : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  PolygonMesh mesh = awkward_mesh();
  mesh.positions[6] = {12345.5, 0.1, 1e6};
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Commas));
  for (const MeshFormat format : {MeshFormat::ply, MeshFormat::obj, MeshFormat::off}) {
    const std::string text = written(mesh, format, {.ply = PlyEncoding::ascii});
    EXPECT_EQ(text.find(','), std::string::npos);
    expect_same_shape(read_mesh(text, format, "again").mesh, mesh);
  }
  std::locale::global(before);
}

TEST(WriteMesh, RefusesUnsoundProperties) {
  const auto refusal = [](VertexProperty property) {
    PolygonMesh mesh = awkward_mesh();
    mesh.properties.push_back(std::move(property));
    return message_of<std::invalid_argument>([&] { written(mesh, MeshFormat::ply); });
  };
  const std::vector<double> values(7, 0.0);
  EXPECT_EQ(refusal({"short", ScalarType::float32, {1.0}}), "property short has 1 values for 7 vertices");
  EXPECT_EQ(refusal({"x", ScalarType::float32, values}), "there are two properties 'x'");
  EXPECT_EQ(refusal({"noise", ScalarType::float32, values}), "there are two properties 'noise'");
  EXPECT_EQ(refusal({"my noise", ScalarType::float32, values}),
            "'my noise' cannot be a property's name: it is empty or has blanks");
}

class MeshFiles : public testing::Test {
 protected:
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  TemporaryFolder folder_;
};

TEST_F(MeshFiles, AreFoundByTheirExtensionInAnyCase) {
  const PolygonMesh mesh = awkward_mesh();
  for (const std::string name : {"a.PLY", "b.Obj", "c.oFF", "d.OM"}) {
    write_mesh(folder_ / name, mesh);
    expect_same_shape(read_mesh(folder_ / name).mesh, mesh);
  }
  put("e.STL",
      "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
  EXPECT_EQ(read_mesh(folder_ / "e.STL").mesh.face_count(), 1u);
  EXPECT_TRUE(is_mesh_path("x.Stl"));
  EXPECT_FALSE(is_mesh_path("x.vdb"));
}

TEST_F(MeshFiles, AreNamedInErrors) {
  const auto refusal = [&](const std::string& name) {
    return message_of<std::runtime_error>([&] { read_mesh(folder_ / name); });
  };
  const std::string folder = (folder_ / "").string();
  EXPECT_EQ(refusal("no.obj"), folder + "no.obj: cannot be read: No such file or directory");
  EXPECT_EQ(refusal("mesh.fbx"), folder +
                                     "mesh.fbx: is not a mesh by its name; .ply, .obj, .off, .stl and .om "
                                     "are known, and .glb, .gltf to read and .usda to write");
  EXPECT_EQ(refusal("mesh"), folder +
                                 "mesh: is not a mesh by its name; .ply, .obj, .off, .stl and .om are known, "
                                 "and .glb, .gltf to read and .usda to write");
  std::filesystem::create_directory(folder_ / "folder.ply");
  EXPECT_EQ(refusal("folder.ply"), folder + "folder.ply: is a folder, not a file");
  for (const std::string name : {"empty.ply", "empty.obj", "empty.off", "empty.stl", "empty.om"}) {
    put(name, "");
    EXPECT_EQ(refusal(name), folder + name + ": the file is empty");
  }
  put("points.obj", "v 0 0 0\n");
  EXPECT_EQ(refusal("points.obj"), folder + "points.obj: the mesh has 1 vertices but no faces");
}

TEST_F(MeshFiles, AreNotReplacedUnlessAsked) {
  put("x.ply", "precious");
  EXPECT_THROW(write_mesh(folder_ / "x.ply", awkward_mesh()), OutputExists);
  EXPECT_EQ(read("x.ply"), "precious");
  write_mesh(folder_ / "x.ply", awkward_mesh(), {.existing = Existing::replace});
  EXPECT_EQ(read("x.ply"), written(awkward_mesh(), MeshFormat::ply));
  EXPECT_EQ(folder_.count(), 1u);
}

// A limit on the size of files stands for a disk that is full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(MeshFiles, AreWholeOrNotThere) {
  put("x.ply", "precious");
  for (const std::string name : {"x.ply", "x.obj", "x.off", "x.stl", "x.om"}) {
    const FileSizeLimit limit(100);
    const std::string message = message_of<std::runtime_error>(
        [&] { write_mesh(folder_ / name, awkward_mesh(), {.existing = Existing::replace}); });
    EXPECT_EQ(message, (folder_ / name).string() + ": writing failed: File too large");
  }
  EXPECT_EQ(read("x.ply"), "precious");
  EXPECT_EQ(folder_.count(), 1u);
}

TEST_F(MeshFiles, AreNotLeftBehindByACancelledWrite) {
  class Stop : public Progress {
    void advance(std::uint64_t, std::uint64_t) override {}
    bool cancelled() override { return true; }
  } stop;
  EXPECT_THROW(write_mesh(folder_ / "x.ply", awkward_mesh(), {.progress = &stop}), Cancelled);
  EXPECT_EQ(folder_.count(), 0u);
}

}  // namespace
}  // namespace solidnoise::write_mesh_test
