#include "solidnoise/geometry/rewrite_mesh.h"

#include <sstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "support/mesh_text.h"
#include "support/message_of.h"

namespace solidnoise::rewrite_mesh_test {
namespace {

// A mesh that was read from the bytes, moved and coloured.
std::string rewritten(const std::string& bytes, MeshFormat format) {
  PolygonMesh mesh = read_mesh(bytes, format, "mesh").mesh;
  for (Vec<3>& position : mesh.positions) position.z += 1.0;
  for (const char* name : {"red", "green", "blue"}) {
    mesh.set_property({name, ScalarType::uint8, std::vector<double>(mesh.positions.size(), 255.0)});
  }
  std::ostringstream stream;
  rewrite_mesh(stream, bytes, format, "mesh", mesh, {.comments = {"baked"}});
  return stream.str();
}

TEST(RewriteObj, ChangesTheLinesOfVerticesAlone) {
  const std::string head = "# made elsewhere \\\nmtllib a.mtl\no body\n";
  const std::string tail =
      "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\ng arm hand\nusemtl skin\ns 1\nf 1/1/1 2/2/1 \\\n 3/3/1\n# inside\nl "
      "1 2\n"
      "v 0 1 0\np 4";
  EXPECT_EQ(rewritten(head + "v 0 0 0\r\nv 1 0 \\\n 0\nv 1 1 0 # a comment\n" + tail, MeshFormat::obj),
            "# baked\nmtllib a.mtl\no body\nv 0 0 1 1 1 1\nv 1 0 1 1 1 1\nv 1 1 1 1 1 1\n" +
                tail.substr(0, tail.find("v 0 1 0")) + "v 0 1 1 1 1 1\np 4");
}

TEST(RewriteObj, ChangesNormalsThatAreOfVertices) {
  const std::string bytes =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\ng a\nf 1//1 2//2 3//3\n";
  PolygonMesh mesh = read_mesh(bytes, MeshFormat::obj, "mesh").mesh;
  mesh.set_property({"nz", ScalarType::float32, {-1.0, -1.0, -1.0}});
  std::ostringstream stream;
  rewrite_mesh(stream, bytes, MeshFormat::obj, "mesh", mesh, {});
  EXPECT_EQ(stream.str(),
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 -1\nvn 0 0 -1\nvn 0 0 -1\ng a\nf 1//1 2//2 3//3\n");
}

std::string ply_head(const std::string& format, const std::string& more) {
  return "ply\nformat " + format + " 1.0\n" + more +
         "element camera 1\nproperty double focus\nelement vertex 3\n" +
         "property float x\nproperty float y\nproperty float z\nproperty float heat\n";
}
const std::string kColorLines = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
const std::string kRest =
    "element face 1\nproperty list uchar int vertex_indices\nproperty int part\nelement edge 2\nproperty int "
    "vertex1\n"
    "property int vertex2\nend_header\n";

TEST(RewritePly, KeepsOtherElementsOfATextAsTheyAre) {
  const std::string rows = "3 0 1 2   7\n0 1\n1  2\n";
  EXPECT_EQ(rewritten(ply_head("ascii", "comment old\n") + kRest + "0.50\n0 0 0 5\n1 0 0 6\n1 1 0 7\n" + rows,
                      MeshFormat::ply),
            ply_head("ascii", "comment baked\n") + kColorLines + kRest +
                "0.50\n0 0 1 5 255 255 255\n1 0 1 6 255 255 255\n1 1 1 7 255 255 255\n" + rows);
}

TEST(RewritePly, KeepsOtherElementsOfBinaryFilesAsTheyAre) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::string format = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    const auto vertices = [&](double z, const std::string& colors) {
      std::string bytes = bytes_of(0.5, order);
      for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1)}) {
        for (const double number : {1.0 * x, 1.0 * y, z, 5.0})
          bytes += bytes_of(static_cast<float>(number), order);
        bytes += colors;
      }
      return bytes;
    };
    std::string rows = "\3";
    for (const std::int32_t number : {0, 1, 2, 7, 0, 1, 1, 2}) rows += bytes_of(number, order);
    EXPECT_EQ(
        rewritten(ply_head(format, "") + kRest + vertices(0.0, "") + rows, MeshFormat::ply),
        ply_head(format, "comment baked\n") + kColorLines + kRest + vertices(1.0, "\xff\xff\xff") + rows);
  }
}

TEST(RewriteMesh, RefusesAnotherNumberOfVertices) {
  const std::string bytes = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  PolygonMesh mesh = read_mesh(bytes, MeshFormat::obj, "mesh").mesh;
  mesh.positions.emplace_back(0.0, 0.0, 0.0);
  std::ostringstream stream;
  EXPECT_EQ(message_of<std::invalid_argument>(
                [&] { rewrite_mesh(stream, bytes, MeshFormat::obj, "mesh", mesh, {}); }),
            "the mesh has 4 vertices; mesh has another number of them");
}

}  // namespace
}  // namespace solidnoise::rewrite_mesh_test
