#include <cstddef>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/geometry/mesh_file.h"
#include "support/mesh_text.h"
#include "support/sample_meshes.h"
#include "support/sound_mesh.h"

namespace solidnoise::damaged_mesh_test {
namespace {

// A file that is damaged is either refused by one line that begins with its name, or read as a sound mesh.
void expect_refused_or_sound(const std::string& bytes, MeshFormat format) {
  try {
    const PolygonMesh mesh = read_mesh(bytes, format, "mesh").mesh;
    ASSERT_EQ(fault_of(mesh), "");
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
  damage(om_triangle(), MeshFormat::om);
}

TEST(DamagedMesh, OfGltfIsRefusedOrSound) {
  damage(written(awkward_mesh(), MeshFormat::glb), MeshFormat::glb);
  damage(gltf_scene(), MeshFormat::gltf);
}

TEST(DamagedMesh, OfStlIsRefusedOrSound) {
  damage(stl_binary(), MeshFormat::stl);
  damage(stl_text(), MeshFormat::stl);
}

}  // namespace
}  // namespace solidnoise::damaged_mesh_test
