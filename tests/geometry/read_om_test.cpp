#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "support/mesh_text.h"
#include "support/message_of.h"
#include "support/sample_meshes.h"

namespace solidnoise::read_om_test {
namespace {

MeshReading read(const std::string& bytes) {
  return read_mesh(bytes, MeshFormat::om, "mesh.om");
}

std::string refusal(const std::string& bytes) {
  return message_of<std::runtime_error>([&] { read(bytes); });
}

using OpenMesh::IO::OMFormat::mk_version;

std::string positions(float z = 0.0f) {
  std::string bytes = om_chunk(kOmPositions);
  for (const float number : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, z}) bytes += bytes_of(number);
  return bytes;
}

TEST(ReadOm, ReadsFacesAsListsOfVertices) {
  const std::string start = om_header('T', mk_version(1, 0), 3, 1, 0) + positions() + om_chunk(kOmFaces);
  EXPECT_EQ(corners_of(read(start + std::string("\2\0\1", 3)).mesh, 0),
            (std::vector<std::uint32_t>{2, 0, 1}));
  EXPECT_EQ(refusal(start + std::string("\2\0\3", 3)),
            "mesh.om: face 0: it has vertex 3, but there are 3 vertices");
  EXPECT_EQ(refusal(start + std::string("\2\0", 2)), "mesh.om: the file ends at face 0 of 1");
  EXPECT_EQ(refusal(om_header('P', mk_version(1, 0), 3, 2000000000, 0) + positions() + om_chunk(kOmFaces)),
            "mesh.om: the file ends at face 0 of 2000000000");
}

TEST(ReadOm, ReadsFacesAsLoopsOfHalfEdges) {
  EXPECT_EQ(corners_of(read(om_triangle(kTriangleHalfedges)).mesh, 0), (std::vector<std::uint32_t>{1, 2, 0}));
  EXPECT_EQ(refusal(om_triangle(kTriangleHalfedges, 6)),
            "mesh.om: face 0: it has half-edge 6, but there are 6");
  EXPECT_EQ(refusal(om_triangle(kTriangleHalfedges, -1)),
            "mesh.om: face 0: it has half-edge -1, but there are 6");
  std::string endless = kTriangleHalfedges;
  endless[12] = 2;  // the third half-edge's next is the second
  EXPECT_EQ(refusal(om_triangle(endless)), "mesh.om: face 0: its half-edges are no loop of its own");
  std::string far = kTriangleHalfedges;
  far[1] = -2;
  EXPECT_EQ(refusal(om_triangle(far)), "mesh.om: face 0: it has vertex -2, but there are 3 vertices");
  EXPECT_EQ(
      refusal(om_header('P', mk_version(2, 2), 3, 1, 2000000000) + positions() + om_chunk(kOmHalfedges)),
      "mesh.om: the file ends at half-edge 0 of 4000000000");
}

// OpenMesh would end the name at the zero, and look for another property; no mesh can have two of a name.
TEST(ReadOm, DropsNumbersThatCannotBeNamedSo) {
  for (const std::string& name : {std::string("a\0b", 3), std::string("a b"), std::string("z")}) {
    std::string bytes = om_triangle();
    OmChunk::Header named = om_chunk_of(OmChunk::Entity_Vertex, OmChunk::Type_Custom);
    named.name_ = 1;
    bytes.resize(bytes.size() - 2);  // what ends the file
    bytes += om_chunk(named) + static_cast<char>(name.size()) + name + "\5float" +
             bytes_of(std::uint32_t{12}) + std::string(12, '\1');
    const MeshReading reading = read(bytes);
    EXPECT_TRUE(reading.mesh.properties.empty());
    EXPECT_EQ(reading.notes.size(), 1u);
  }
}

TEST(ReadOm, RefusesWhatIsNotThereOrNotKnown) {
  EXPECT_EQ(refusal("OFF"), "mesh.om: is not an OM file: it does not begin with 'OM'");
  EXPECT_EQ(refusal(om_header('X', mk_version(1, 2), 3, 1, 0)), "mesh.om: the kind of faces is unknown");
  EXPECT_EQ(refusal(om_header('T', mk_version(3, 1), 3, 1, 0)), "mesh.om: version 3.1 is unknown");
  const std::string start = om_header('T', mk_version(1, 2), 3, 1, 0);
  EXPECT_EQ(refusal(start), "mesh.om: the vertices have no positions");
  EXPECT_EQ(refusal(start + positions()), "mesh.om: the faces have no vertices");
  EXPECT_EQ(refusal(start + positions(std::numeric_limits<float>::infinity()) + om_chunk(kOmFaces) +
                    std::string("\2\0\1", 3)),
            "mesh.om: vertex 2: its z is not finite");
  EXPECT_EQ(refusal(om_header('T', mk_version(1, 2), 2000000000, 1, 0) + positions()),
            "mesh.om: the file ends at vertex 3 of 2000000000");
  OmChunk::Header whole = kOmPositions;
  whole.float_ = 0;
  EXPECT_EQ(refusal(start + om_chunk(whole)), "mesh.om: a number has an unknown type");
  OmChunk::Header large = kOmFaces;
  large.bits_ = OmChunk::Integer_64;
  EXPECT_EQ(refusal(start + positions() + om_chunk(large)), "mesh.om: a number has an unknown type");
  OmChunk::Header flat = kOmPositions;
  flat.dim_ = OmChunk::Dim_2D;
  EXPECT_EQ(refusal(start + om_chunk(flat)), "mesh.om: positions have 2 dimensions");
  OmChunk::Header strange = kOmPositions;
  strange.entity_ = 3;
  EXPECT_EQ(refusal(start + om_chunk(strange)), "mesh.om: unknown kind of element 3");
  OmChunk::Header named = om_chunk_of(OmChunk::Entity_Vertex, OmChunk::Type_Custom);
  named.name_ = 1;
  EXPECT_EQ(refusal(start + om_chunk(named) + "\7noi"), "mesh.om: the file ends in a name");
  EXPECT_EQ(refusal(start + om_chunk(named) + "\5noise" + bytes_of(std::uint32_t{2000000000})),
            "mesh.om: the file ends in property 'noise'");
  EXPECT_EQ(refusal(om_header('T', mk_version(1, 2), 0, 0, 0)), "mesh.om: the mesh has no vertices");
}

}  // namespace
}  // namespace solidnoise::read_om_test
