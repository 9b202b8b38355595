#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "support/mesh_text.h"
#include "support/message_of.h"

namespace solidnoise::read_ply_test {
namespace {

MeshReading read(const std::string& bytes) {
  return read_mesh(bytes, MeshFormat::ply, "mesh.ply");
}

std::string refusal(const std::string& bytes) {
  return message_of<std::runtime_error>([&] { read(bytes); });
}

const std::string kPositions = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";

// An ascii file of a triangle, with other lines in the header and other rows.
std::string triangle(const std::string& vertices, const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex 3\n" + kPositions + "element face 1\n" + kFaces +
         "end_header\n" + vertices + faces;
}

TEST(ReadPly, ReadsTextWithEveryType) {
  const MeshReading reading = read(
      "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nobj_info scanned\r\nelement vertex 3\r\n"
      "property char a\nproperty uint8 b\nproperty int16 c\nproperty ushort d\nproperty int32 e\n"
      "property uint f\nproperty double x\nproperty float64 y\nproperty float z\nproperty float32 quality\n"
      "element face 1\nproperty list uint8 uint32 vertex_index\nend_header\n"
      "-128 255 -32768 65535 -2147483648 4294967295 0.1 0 0 nan\n\n"
      "0 0 0 0 0 0 1 0 0 -inf\n 1 2 3 4 5 6 0 1 0 0.5\n3 0 1 2\n");
  EXPECT_EQ(reading.notes, std::vector<std::string>{"lines of obj_info become comments"});
  const PolygonMesh& mesh = reading.mesh;
  EXPECT_EQ(mesh.position_type, ScalarType::float64);
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[0], Vec<3>(0.1, 0, 0));
  EXPECT_EQ(corners_of(mesh, 0), (std::vector<std::uint32_t>{0, 1, 2}));
  ASSERT_EQ(mesh.properties.size(), 7u);
  const double first[] = {-128, 255, -32768, 65535, -2147483648.0, 4294967295.0};
  const ScalarType types[] = {ScalarType::int8,   ScalarType::uint8, ScalarType::int16,
                              ScalarType::uint16, ScalarType::int32, ScalarType::uint32};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(mesh.properties[i].name, std::string(1, static_cast<char>('a' + i)));
    EXPECT_EQ(mesh.properties[i].type, types[i]);
    EXPECT_EQ(mesh.properties[i].values[0], first[i]);
    EXPECT_EQ(mesh.properties[i].values[2], static_cast<double>(i + 1));
  }
  // Only positions must be finite.
  EXPECT_TRUE(std::isnan(mesh.properties[6].values[0]));
  EXPECT_TRUE(std::isinf(mesh.properties[6].values[1]));
  EXPECT_EQ(reading.comments, (std::vector<std::string>{"made by hand", "scanned"}));
}

// The same mesh with lists and elements of no use everywhere, in either order of bytes.
std::string binary(std::endian order) {
  const auto put = [order](auto number) { return bytes_of(number, order); };
  std::string text = "ply\nformat binary_" + std::string(order == std::endian::big ? "big" : "little") +
                     "_endian 1.0\n"
                     "element camera 2\nproperty uchar lens\nproperty list ushort double view\n"
                     "element vertex 3\nproperty list uchar short rings\nproperty float x\n"
                     "property uchar red\nproperty float y\nproperty float z\nproperty double t\n"
                     "element nothing 4000000000\n"
                     "element face 2\nproperty float area\n" +
                     kFaces +
                     "property list uchar float texcoord\nelement edge 1\nproperty int a\nend_header\n";
  for (int camera = 0; camera < 2; ++camera) {
    text += put(std::uint8_t{1}) + put(std::uint16_t{2}) + put(1.0) + put(2.0);
  }
  for (int v = 0; v < 3; ++v) {
    text += put(static_cast<std::uint8_t>(v));
    for (int ring = 0; ring < v; ++ring) text += put(std::int16_t{7});
    text += put(static_cast<float>(v == 1)) + put(static_cast<std::uint8_t>(200 + v)) +
            put(static_cast<float>(v == 2)) + put(0.25f) + put(0.1 * v);
  }
  for (int f = 0; f < 2; ++f) {
    text += put(0.5f) + put(std::uint8_t{3}) + put(f) + put((f + 1) % 3) + put((f + 2) % 3) +
            put(static_cast<std::uint8_t>(f));
    for (int k = 0; k < f; ++k) text += put(0.5f);
  }
  return text + put(77);
}

TEST(ReadPly, ReadsBothByteOrdersAndSkipsTheRest) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const MeshReading reading = read(binary(order));
    const PolygonMesh& mesh = reading.mesh;
    EXPECT_EQ(mesh.position_type, ScalarType::float32);
    EXPECT_EQ(mesh.positions, (std::vector<Vec<3>>{{0, 0, 0.25}, {1, 0, 0.25}, {0, 1, 0.25}}));
    ASSERT_EQ(mesh.properties.size(), 2u);
    EXPECT_EQ(mesh.properties[0].name, "red");
    EXPECT_EQ(mesh.properties[0].values, (std::vector<double>{200, 201, 202}));
    EXPECT_EQ(mesh.properties[1].values, (std::vector<double>{0, 0.1, 0.2}));
    ASSERT_EQ(mesh.face_count(), 2u);
    EXPECT_EQ(corners_of(mesh, 1), (std::vector<std::uint32_t>{1, 2, 0}));
    EXPECT_EQ(
        reading.notes,
        (std::vector<std::string>{
            "element camera (2 of it) is dropped", "the vertices' lists 'rings' are dropped",
            "element nothing (4000000000 of it) is dropped",
            "properties of element face are dropped: area, texcoord", "element edge (1 of it) is dropped"}));
  }
  EXPECT_EQ(read(binary(std::endian::big) + "x").notes.back(), "what follows the last element is ignored");
}

TEST(ReadPly, EveryTruncationIsRefused) {
  const std::string whole = binary(std::endian::little);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string message = refusal(whole.substr(0, size));
    EXPECT_TRUE(message.starts_with("mesh.ply: ") || message.starts_with("mesh.ply:")) << size << message;
  }
}

TEST(ReadPly, CutsStripsIntoTriangles) {
  const MeshReading reading = read("ply\nformat ascii 1.0\nelement vertex 4\n" + kPositions +
                                   "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                                   "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 3 2 1\n");
  EXPECT_EQ(triangulate(reading.mesh), (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 2, 1}}));
}

TEST(ReadPly, NamesLineAndElementOfAnErrorInText) {
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string face = "3 0 1 2\n";
  EXPECT_EQ(refusal(triangle("0 0 0\n1 nan 0\n0 1 0\n", face)), "mesh.ply:11: vertex 1: its y is not finite");
  EXPECT_EQ(refusal(triangle("0 0 0\n1 0 1e999\n0 1 0\n", face)),
            "mesh.ply:11: vertex 1: its z is not finite");
  EXPECT_EQ(refusal(triangle("0 0 0\n1 0,5 0\n0 1 0\n", face)),
            "mesh.ply:11: vertex 1: '0,5' is not a number");
  EXPECT_EQ(refusal(triangle("0 0 0\n1 0\n0 1 0\n", face)), "mesh.ply:11: vertex 1: a value is missing");
  EXPECT_EQ(refusal(triangle("0 0 0\n1 0 0 7\n0 1 0\n", face)),
            "mesh.ply:11: vertex 1: there is '7' after the last value");
  EXPECT_EQ(refusal(triangle(vertices, "3 0 1 3\n")),
            "mesh.ply:13: face 0: it has vertex 3, but there are 3 vertices");
  EXPECT_EQ(refusal(triangle(vertices, "3 0 1 -1\n")),
            "mesh.ply:13: face 0: it has vertex -1, but there are 3 vertices");
  EXPECT_EQ(refusal(triangle(vertices, "3 0 1 1.5\n")),
            "mesh.ply:13: face 0: '1.5' is not an integer of type int");
  EXPECT_EQ(refusal(triangle(vertices, "256 0 1 2\n")),
            "mesh.ply:13: face 0: '256' is not an integer of type uchar");
  EXPECT_EQ(refusal(triangle(vertices, "9 0 1 2\n")),
            "mesh.ply:13: face 0: a list of 9 values is more than there is");
  EXPECT_EQ(refusal(triangle(vertices, "4 0   1 2\n")), "mesh.ply:13: face 0: a value is missing");
  EXPECT_EQ(refusal(triangle(vertices, "\n\n\n")), "mesh.ply: the file ends at face 0 of 1");
}

TEST(ReadPly, RefusesWhatTheHeaderGetsWrong) {
  const std::string ascii = "ply\nformat ascii 1.0\n";
  EXPECT_EQ(refusal("plyx\n"), "mesh.ply: is not a PLY file: it does not begin with 'ply'");
  EXPECT_EQ(refusal(ascii), "mesh.ply: the file ends within its header");
  EXPECT_EQ(refusal("ply\nend_header\n"), "mesh.ply: the header does not say the format");
  EXPECT_EQ(refusal("ply\nformat binary 1.0\n"), "mesh.ply:2: unknown format 'binary'");
  EXPECT_EQ(refusal("ply\nformat ascii 2.0\n"), "mesh.ply:2: unknown version '2.0'");
  EXPECT_EQ(refusal(ascii + "elephant\n"), "mesh.ply:3: 'elephant' has no place in the header");
  EXPECT_EQ(refusal(ascii + "element vertex -3\n"),
            "mesh.ply:3: an element needs a name and a count, not '-3'");
  EXPECT_EQ(refusal(ascii + "element vertex 3\nelement vertex 3\n"),
            "mesh.ply:4: there are two elements 'vertex'");
  EXPECT_EQ(refusal(ascii + "property float x\n"), "mesh.ply:3: a property before the first element");
  EXPECT_EQ(refusal(ascii + "element vertex 3\nproperty half x\n"), "mesh.ply:4: unknown type 'half'");
  EXPECT_EQ(refusal(ascii + "element vertex 3\nproperty float\n"), "mesh.ply:4: a property needs a name");
  EXPECT_EQ(refusal(ascii + "element vertex 3\nproperty list float int a\n"),
            "mesh.ply:4: the length of a list must be of a type of integers");
  EXPECT_EQ(refusal(ascii + "element vertex 3\nproperty float x\nproperty int x\n"),
            "mesh.ply:5: there are two properties 'x'");
  EXPECT_EQ(refusal(ascii + "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n"),
            "mesh.ply: the vertices have no x, y and z");
  EXPECT_EQ(refusal(ascii + "element face 1\nproperty int a\nend_header\n0\n"),
            "mesh.ply: element face has no list vertex_indices");
  EXPECT_EQ(refusal(ascii + "end_header\n"), "mesh.ply: the mesh has no vertices");
  EXPECT_EQ(refusal(ascii + "element vertex 1\n" + kPositions + "end_header\n0 0 0\n"),
            "mesh.ply: the mesh has 1 vertices but no faces");
}

// Memory is not asked for before the file is known to be long enough.
// Rows without properties take no room in the file: a count of them may not take any in memory.
TEST(ReadPly, RefusesCountlessVerticesWithoutProperties) {
  for (const char* count : {"150000000", "4000000000"}) {
    EXPECT_EQ(refusal(std::string("ply\nformat ascii 1.0\nelement vertex ") + count +
                      "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 2\n"),
              "mesh.ply: the vertices have no x, y and z");
  }
}

TEST(ReadPly, RefusesCountsThatTheFileCannotHold) {
  const auto header = [](const std::string& format, const std::string& vertices, const std::string& faces) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices + "\n" + kPositions +
           "element face " + faces + "\n" + kFaces + "end_header\n";
  };
  EXPECT_EQ(refusal(header("ascii", "2000000000", "1") + "0 0 0\n"),
            "mesh.ply: the header promises 2000000000 of element vertex, but there is room for 1");
  EXPECT_EQ(refusal(header("binary_big_endian", "2000000000", "1") + std::string(30, '\0')),
            "mesh.ply: the header promises 2000000000 of element vertex, but there is room for 2");
  EXPECT_EQ(refusal(header("ascii", "18446744073709551615", "1") + "0 0 0\n"),
            "mesh.ply: the header promises 18446744073709551615 of element vertex, but there is room for "
            "4294967295");
  EXPECT_EQ(refusal(header("binary_little_endian", "1", "4000000000") + std::string(30, '\0')),
            "mesh.ply: the header promises 4000000000 of element face, but there is room for 18");
  const std::string list = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + kPositions +
                           "element face 1\nproperty list uint int vertex_indices\nend_header\n" +
                           std::string(12, '\0');
  EXPECT_EQ(refusal(list + bytes_of(std::uint32_t{4000000000u}) + bytes_of(0)),
            "mesh.ply: face 0: a list of 4000000000 values is more than there is");
  EXPECT_EQ(refusal(list + bytes_of(std::uint32_t{1}) + bytes_of(9)),
            "mesh.ply: face 0: it has vertex 9, but there are 1 vertices");
}

}  // namespace
}  // namespace solidnoise::read_ply_test
