#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "support/mesh_text.h"
#include "support/message_of.h"

namespace solidnoise::read_stl_test {
namespace {

MeshReading read(const std::string& bytes) {
  return read_mesh(bytes, MeshFormat::stl, "mesh.stl");
}

std::string refusal(const std::string& bytes) {
  return message_of<std::runtime_error>([&] { read(bytes); });
}

using Facet = std::array<std::array<float, 3>, 3>;

// A square of two facets.
const std::vector<Facet> kSquare{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}},
                                 {{{-0.0f, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};

std::string binary(const std::vector<Facet>& facets, std::string head = "exported",
                   std::uint16_t attribute = 0) {
  head.resize(80, ' ');
  std::string bytes = head + bytes_of(static_cast<std::uint32_t>(facets.size()));
  for (const Facet& facet : facets) {
    for (int axis = 0; axis < 3; ++axis) bytes += bytes_of(0.0f);
    for (const auto& corner : facet) {
      for (const float number : corner) bytes += bytes_of(number);
    }
    bytes += bytes_of(attribute);
  }
  return bytes;
}

const std::string kText =
    "solid a square\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 1 0\n"
    "  endloop\n endfacet\n facet normal 0 0 1\r\n  outer loop\r\n   vertex -0 0 0\r\n   vertex 1.0 1e0 0\r\n"
    "   vertex 0 1 0\r\n  endloop\n endfacet\nendsolid a square\n";

void expect_square(const PolygonMesh& mesh) {
  EXPECT_EQ(mesh.positions, (std::vector<Vec<3>>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(triangulate(mesh), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadStl, MergesCornersAtEqualPositions) {
  expect_square(read(binary(kSquare)).mesh);
  expect_square(read(kText).mesh);
  // Next to each other is not at the same place.
  std::vector<Facet> torn = kSquare;
  torn[1][1][0] = std::nextafter(1.0f, 2.0f);
  EXPECT_EQ(read(binary(torn)).mesh.positions.size(), 5u);
}

TEST(ReadStl, TellsBinaryFilesThatBeginLikeText) {
  expect_square(read(binary(kSquare, "solid made by a program")).mesh);
  const MeshReading longer = read(binary(kSquare, "solid made by a program") + "tail");
  expect_square(longer.mesh);
  EXPECT_EQ(longer.notes, std::vector<std::string>{"4 bytes after the last facet are ignored"});
  expect_square(read("\n \n" + kText).mesh);
  EXPECT_EQ(read(kText + kText).mesh.face_count(), 4u) << "a file may hold several solids";
}

TEST(ReadStl, CountsTheFacetsThatItDrops) {
  std::vector<Facet> facets = kSquare;
  facets.push_back({{{5, 5, 5}, {0, 0, 0}, {5, 5, 5}}});
  const MeshReading reading = read(binary(facets));
  EXPECT_EQ(reading.mesh.face_count(), 2u);
  EXPECT_EQ(reading.notes, std::vector<std::string>{"1 facets with two corners at one place are dropped"});
}

TEST(ReadStl, TakesNoFacetsFromNames) {
  std::string text = kText;
  text.replace(0, text.find('\n'), "solid outer router");
  expect_square(read(text).mesh);
}

TEST(ReadStl, NotesColoursOfFacets) {
  EXPECT_EQ(read(binary(kSquare, "colour", 0x7fff)).notes,
            std::vector<std::string>{"the attributes (colours) of facets are dropped"});
}

TEST(ReadStl, NamesFaceAndLineOfAnError) {
  EXPECT_EQ(refusal("garbage"), "mesh.stl: is not an STL file, or ends within its header");
  EXPECT_EQ(refusal(binary(kSquare).substr(0, 100)),
            "mesh.stl: the header promises 2 facets, but there is room for 0");
  EXPECT_EQ(refusal(std::string(200, '\xff')),
            "mesh.stl: the header promises 4294967295 facets, but there is room for 2");
  std::vector<Facet> broken = kSquare;
  broken[1][2][0] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refusal(binary(broken)), "mesh.stl: face 1: a vertex has a position that is not finite");
  EXPECT_EQ(refusal(binary({})), "mesh.stl: the mesh has no vertices");

  EXPECT_EQ(refusal("solid\nfacet\nvertex 0 nan 0\n"), "mesh.stl:3: face 0: 'nan' is not a finite number");
  EXPECT_EQ(refusal("solid\nfacet\nvertex 0 0\n"), "mesh.stl:3: face 0: a vertex needs three coordinates");
  EXPECT_EQ(refusal("solid\nfacet\nendloop\n"), "mesh.stl:3: face 0: it has 0 vertices; a facet has 3");
  EXPECT_EQ(refusal("solid\nfacet\nvertex 0 1e39 0\n"), "mesh.stl:3: face 0: '1e39' is not a finite number");
  EXPECT_EQ(refusal("solid\nfacet\nvortex 0 0 0\n"), "mesh.stl:3: 'vortex' has no place in an STL file");
  EXPECT_EQ(refusal(kText.substr(0, kText.find("endsolid"))),
            "mesh.stl: the file ends at face 2, before 'endsolid'");
  EXPECT_EQ(refusal("solid nothing\nendsolid\n"), "mesh.stl: the mesh has no vertices");
}

}  // namespace
}  // namespace solidnoise::read_stl_test
