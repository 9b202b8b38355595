#include <cstddef>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/geometry/read_mesh.h"
#include "support/mesh_text.h"
#include "support/sample_meshes.h"

namespace solidnoise {
namespace {

// A file that is damaged is either refused by one line that begins with its name, or read as a mesh that is
// sound: properties of the vertices' count, corners that are vertices, finite positions.
void expect_refused_or_sound(const std::string& bytes, MeshFormat format) {
  try {
    const PolygonMesh mesh = read_mesh(bytes, format, "mesh").mesh;
    for (const std::uint32_t corner : mesh.corners) ASSERT_LT(corner, mesh.positions.size());
    ASSERT_EQ(mesh.face_starts.back(), mesh.corners.size());
    for (const VertexProperty& property : mesh.properties) {
      ASSERT_EQ(property.values.size(), mesh.positions.size());
    }
    for (const Vec<3>& p : mesh.positions) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    }
    inspect_mesh(mesh);
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    ASSERT_TRUE(message.starts_with("mesh:")) << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

void damage(const std::string& whole, MeshFormat format) {
  std::mt19937_64 random(format == MeshFormat::ply ? whole.size() : static_cast<std::uint64_t>(format));
  for (int trial = 0; trial < 2000 && !testing::Test::HasFatalFailure(); ++trial) {
    std::string bytes = whole;
    const int kind = trial % 4;
    if (kind == 0) bytes.resize(random() % bytes.size());
    // One to four changed bytes: a bit flipped, any byte, or an extreme one.
    for (std::size_t n = kind == 0 ? 0 : 1 + random() % 4; n > 0; --n) {
      char& byte = bytes[random() % bytes.size()];
      const char replaced[] = {static_cast<char>(byte ^ 1 << random() % 8),
                               static_cast<char>(random() & 0xff), random() % 2 == 0 ? '\xff' : '9'};
      byte = replaced[kind - 1];
    }
    SCOPED_TRACE(trial);
    expect_refused_or_sound(bytes, format);
  }
}

TEST(DamagedMesh, OfPlyIsRefusedOrSound) {
  const PolygonMesh mesh = awkward_mesh();
  damage(written(mesh, MeshFormat::ply), MeshFormat::ply);
  damage(written(mesh, MeshFormat::ply, {.ply = PlyEncoding::binary_big_endian}), MeshFormat::ply);
  damage(written(mesh, MeshFormat::ply, {.ply = PlyEncoding::ascii}), MeshFormat::ply);
}

TEST(DamagedMesh, OfObjIsRefusedOrSound) {
  damage(written(awkward_mesh(), MeshFormat::obj), MeshFormat::obj);
}

TEST(DamagedMesh, OfOffIsRefusedOrSound) {
  damage(written(awkward_mesh(), MeshFormat::off), MeshFormat::off);
}

TEST(DamagedMesh, OfOmIsRefusedOrSound) {
  damage(written(awkward_mesh(), MeshFormat::om), MeshFormat::om);
}

TEST(DamagedMesh, OfStlIsRefusedOrSound) {
  std::string binary(80, ' ');
  binary += bytes_of(std::uint32_t{6});
  for (int number = 0; number < 6 * 12; ++number) {
    binary += bytes_of(static_cast<float>(number % 7));
    if (number % 12 == 11) binary += bytes_of(std::uint16_t{0});
  }
  damage(binary, MeshFormat::stl);
  std::string text = "solid name\n";
  for (int facet = 0; facet < 6; ++facet) {
    text +=
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e-3 0.25\nendloop\nendfacet\n";
  }
  damage(text + "endsolid name\n", MeshFormat::stl);
}

}  // namespace
}  // namespace solidnoise
