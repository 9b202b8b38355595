#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "support/mesh_text.h"
#include "support/message_of.h"

namespace solidnoise::read_off_test {
namespace {

MeshReading read(const std::string& text) {
  return read_mesh(text, MeshFormat::off, "mesh.off");
}

std::string refusal(const std::string& text) {
  return message_of<std::runtime_error>([&] { read(text); });
}

std::vector<double> values(const PolygonMesh& mesh, const std::string& name) {
  const VertexProperty* const property = mesh.property(name);
  return property == nullptr ? std::vector<double>() : property->values;
}

TEST(ReadOff, ReadsCountsAndCommentsAnywhere) {
  for (const std::string head :
       {"OFF\n3 1 0\n", "OFF 3 1 0\n", "3 1\n", "# first\n\nOFF # second\n# third\n3 1 3\r\n"}) {
    const MeshReading reading = read(head + "0 0 0\n\n1 0 0 # a corner\n 0 1e0 0\r\n3 0 1 2\n");
    EXPECT_EQ(reading.mesh.positions, (std::vector<Vec<3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(corners_of(reading.mesh, 0), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(reading.mesh.properties.empty());
    EXPECT_TRUE(reading.notes.empty());
    EXPECT_EQ(reading.comments.size(), head.starts_with('#') ? 3u : 0u);
  }
}

TEST(ReadOff, ReadsEveryPrefix) {
  const PolygonMesh bytes =
      read("COFF\n3 1 0\n0 0 0 255 0 1 255\n1 0 0 1 1 1\n0 1 0 0 128 0 255\n3 0 1 2\n").mesh;
  EXPECT_EQ(values(bytes, "green"), (std::vector<double>{0, 1, 128}));
  EXPECT_EQ(bytes.property("red")->type, ScalarType::uint8);
  EXPECT_EQ(bytes.property("alpha"), nullptr) << "opaque everywhere";

  const PolygonMesh floats =
      read("COFF\n3 1 0\n0 0 0 0.5 0 1 0.25\n1 0 0 1 1 1 1\n0 1 0 0 0 0 1\n3 0 1 2\n").mesh;
  EXPECT_EQ(values(floats, "red"), (std::vector<double>{0.5, 1, 0}));
  EXPECT_EQ(values(floats, "alpha"), (std::vector<double>{0.25, 1, 1}));
  EXPECT_EQ(floats.property("alpha")->type, ScalarType::float32);

  const PolygonMesh all = read(
                              "STCNOFF\n3 1 0\n0 0 0 0 0 1 9 8 7 255 .5 1\n1 0 0 0 0 1 6 5 4 255 0 0\n0 1 0 "
                              "0 1 0 3 2 1 255 1 0\n3 0 1 2\n")
                              .mesh;
  ASSERT_EQ(all.properties.size(), 8u);
  EXPECT_EQ(values(all, "nz"), (std::vector<double>{1, 1, 0}));
  EXPECT_EQ(values(all, "blue"), (std::vector<double>{7, 4, 1}));
  EXPECT_EQ(values(all, "s"), (std::vector<double>{0.5, 0, 1}));
}

TEST(ReadOff, SkipsWhatIsNoPartOfTheMesh) {
  const MeshReading reading =
      read("OFF\n3 1 0\n0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n# made by us\n1 2 3\n");
  EXPECT_EQ(reading.notes, (std::vector<std::string>{"numbers after those of the vertices are dropped",
                                                     "the colours of faces are dropped",
                                                     "what follows the last face is ignored"}));
  EXPECT_EQ(reading.comments, std::vector<std::string>{"made by us"});
}

// OpenMesh's reader knows what a vertex has by the last file that it looked at, whichever that was.
TEST(ReadOff, DoesNotDependOnTheFileBefore) {
  const std::string normals = "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n";
  const std::string plain = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const std::string& text : {normals, plain, normals, plain}) {
    const PolygonMesh mesh = read(text).mesh;
    EXPECT_EQ(mesh.positions, (std::vector<Vec<3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.properties.size(), text == normals ? 3u : 0u);
  }
}

TEST(ReadOff, KeepsDoublesAndHasZeroForNormalsThatAreNotFinite) {
  const PolygonMesh mesh =
      read(
          "STNOFF\n3 1 0\n0.12345678901234 1e300 0 nan 1e39 1 0.5 0\n1\t0 0 0 0  1e-60 0 1\n0 "
          "1 0 0 0 1 0 0\n3 0 1 2\n")
          .mesh;
  EXPECT_EQ(mesh.position_type, ScalarType::float64);
  EXPECT_EQ(mesh.positions[0], (Vec<3>{0.12345678901234, 1e300, 0}));
  EXPECT_EQ(values(mesh, "nx"), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(values(mesh, "ny"), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(values(mesh, "nz"), (std::vector<double>{1, 0, 1}));
  EXPECT_EQ(values(mesh, "t"), (std::vector<double>{0, 1, 0}));
}

TEST(ReadOff, NamesLineAndElementOfAnError) {
  const std::string head = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(refusal("ply\n"), "mesh.off: is not an OFF file: it does not begin with 'OFF'");
  EXPECT_EQ(refusal("# only\n"), "mesh.off: the file holds no mesh");
  EXPECT_EQ(refusal("4OFF\n"), "mesh.off:1: '4OFF' is not known; OFF with ST, C and N before it is");
  EXPECT_EQ(refusal("OFF BINARY\n"), "mesh.off:1: binary OFF is not known; write it as text");
  EXPECT_EQ(refusal("OFF\n"), "mesh.off: the file ends at its counts");
  EXPECT_EQ(refusal("OFF\n3\n"), "mesh.off:2: the counts of vertices and faces are needed");
  EXPECT_EQ(refusal("OFF\n2000000000 1 0\n0 0 0\n"),
            "mesh.off:2: 2000000000 vertices are promised, but there is no room for them");
  EXPECT_EQ(refusal("OFF\n1 2000000000 0\n0 0 0\n"),
            "mesh.off:2: 2000000000 faces are promised, but there is no room for them");
  EXPECT_EQ(refusal("OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
            "mesh.off:4: vertex 1: 'nan' is not a finite number");
  EXPECT_EQ(refusal("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), "mesh.off:4: vertex 1: numbers are missing");
  EXPECT_EQ(refusal("OFF\n3 1 0\n0 0 0\n1 0 O\n0 1 0\n3 0 1 2\n"),
            "mesh.off:4: vertex 1: 'O' is not a number");
  EXPECT_EQ(refusal("COFF\n3 1 0\n0 0 0 1 1\n1 0 0 1 1\n0 1 0 1 1\n3 0 1 2\n"),
            "mesh.off:3: vertex 0: numbers are missing");
  EXPECT_EQ(refusal("OFF\n3 1 0\n0 0 0 # no more room needed\n1 0 0\n"),
            "mesh.off: the file ends at vertex 2 of 3");
  EXPECT_EQ(refusal(head + "# nothing\n"), "mesh.off: the file ends at face 0 of 1");
  EXPECT_EQ(refusal(head + "3 0 1 3\n"), "mesh.off:6: face 0: it has vertex 3, but there are 3 vertices");
  EXPECT_EQ(refusal(head + "3 0 1 -1\n"), "mesh.off:6: face 0: it has vertex -1, but there are 3 vertices");
  EXPECT_EQ(refusal(head + "3 0 1\n"), "mesh.off:6: face 0: it has fewer vertices than it says");
  EXPECT_EQ(refusal(head + "99999999999 0 1\n"), "mesh.off:6: face 0: it has fewer vertices than it says");
  EXPECT_EQ(refusal(head + "3 0 x 2\n"), "mesh.off:6: face 0: 'x' is not a vertex index");
  EXPECT_EQ(refusal(head + "x\n"), "mesh.off:6: face 0: 'x' is not a number of vertices");
  EXPECT_EQ(refusal("OFF\n0 0 0\n"), "mesh.off: the mesh has no vertices");
}

}  // namespace
}  // namespace solidnoise::read_off_test
