#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <OpenMesh/Core/IO/OMFormat.hh>

#include "solidnoise/geometry/polygon_mesh.h"
#include "support/mesh_text.h"

namespace solidnoise {

// Seven vertices, one in no face; a square, triangles, an edge in three faces, a face of two corners, and
// properties of every type, in an order that none would choose.
inline PolygonMesh awkward_mesh() {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.25}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}, {7, 8, 9}};
  for (Vec<3>& p : mesh.positions) p.x = static_cast<double>(static_cast<float>(p.x) * 0.1f);
  mesh.add_face(std::array{0u, 1u, 2u, 3u});
  mesh.add_face(std::array{0u, 1u, 4u});
  mesh.add_face(std::array{1u, 0u, 5u});
  mesh.add_face(std::array{2u, 3u});
  const auto add = [&](const std::string& name, ScalarType type, double first, double step) {
    VertexProperty property{name, type, {}};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const double value = first + step * static_cast<double>(v);
      property.values.push_back(type == ScalarType::float32 ? static_cast<double>(static_cast<float>(value))
                                                            : value);
    }
    mesh.properties.push_back(property);
  };
  add("quality", ScalarType::float64, 0.1, 1e-9);
  add("blue", ScalarType::uint8, 255, -17);
  add("green", ScalarType::uint8, 0, 31);
  add("a", ScalarType::int8, -128, 40);
  add("nx", ScalarType::float32, 0.1, 0.1);
  add("b", ScalarType::int16, -32768, 10000);
  add("c", ScalarType::uint16, 65535, -9999);
  add("d", ScalarType::int32, -2147483648.0, 7e8);
  add("e", ScalarType::uint32, 4294967295.0, -6e8);
  add("nz", ScalarType::float32, -1, 0.3);
  add("ny", ScalarType::float32, 1e-30, 3e30);
  add("red", ScalarType::uint8, 128, 19);
  add("noise", ScalarType::float32, -1.23456789, 0.7);
  return mesh;
}

// Six facets as an STL file, in bytes and in words.
inline std::string stl_binary() {
  std::string bytes(80, ' ');
  bytes += bytes_of(std::uint32_t{6});
  for (int number = 0; number < 6 * 12; ++number) {
    bytes += bytes_of(static_cast<float>(number % 7));
    if (number % 12 == 11) bytes += bytes_of(std::uint16_t{0});
  }
  return bytes;
}
inline std::string stl_text() {
  std::string text = "solid name\n";
  for (int facet = 0; facet < 6; ++facet) {
    text +=
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e-3 0.25\nendloop\nendfacet\n";
  }
  return text + "endsolid name\n";
}

// The head of an OM file, and of a chunk of one.
inline std::string om_header(char kind, std::uint8_t version, std::uint32_t vertices, std::uint32_t faces,
                             std::uint32_t edges) {
  return std::string("OM") + kind + bytes_of(version) + bytes_of(vertices) + bytes_of(faces) +
         bytes_of(edges);
}
using OmChunk = OpenMesh::IO::OMFormat::Chunk;
inline std::string om_chunk(const OmChunk::Header& chunk) {
  std::uint16_t bytes = 0;
  OpenMesh::IO::OMFormat::operator<<(bytes, chunk);
  return bytes_of(bytes);
}
inline constexpr OmChunk::Header om_chunk_of(OmChunk::Entity entity, OmChunk::Type type,
                                             OmChunk::Dim dimensions = OmChunk::Dim_1D) {
  OmChunk::Header chunk{};
  chunk.entity_ = entity;
  chunk.type_ = type;
  chunk.signed_ = 1;
  chunk.float_ = 1;
  chunk.dim_ = dimensions;
  return chunk;
}
inline constexpr OmChunk::Header kOmPositions =
    om_chunk_of(OmChunk::Entity_Vertex, OmChunk::Type_Pos, OmChunk::Dim_3D);
inline constexpr OmChunk::Header kOmFaces = om_chunk_of(OmChunk::Entity_Face, OmChunk::Type_Topology);
inline constexpr OmChunk::Header kOmHalfedges =
    om_chunk_of(OmChunk::Entity_Halfedge, OmChunk::Type_Topology, OmChunk::Dim_3D);

// A triangle as an OM file of version 2, whose faces are loops of half-edges: 0 2 4 go around it, the others
// back. A half-edge is the next one, the vertex it points to and the face.
inline const std::string kTriangleHalfedges("\2\1\0\5\0\xff\4\2\0\1\1\xff\0\0\0\3\2\xff", 18);
inline std::string om_triangle(const std::string& halfedges = kTriangleHalfedges, char first_of_face = 0) {
  std::string bytes =
      om_header('P', OpenMesh::IO::OMFormat::mk_version(2, 2), 3, 1, 3) + om_chunk(kOmPositions);
  for (const float number : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) bytes += bytes_of(number);
  bytes += om_chunk(kOmHalfedges) + halfedges + om_chunk(kOmFaces) + first_of_face;
  return bytes + om_chunk(om_chunk_of(OmChunk::Entity_Sentinel, OmChunk::Type_Pos));
}

// A square as a .gltf whose bytes are in its text: two of its nodes have it, the first of twice the size and
// moved by 5 along z; with a material, texture coordinates, an animation and an extension.
inline std::string gltf_scene() {
  return R"({"asset":{"version":"2.0","extras":{"comments":["made by hand"]}},"scene":0,"scenes":[{"nodes":[)"
         R"(0]}],"nodes":[{"name":"root","translation":[0,0,5],"children":[1,2]},{"name":"one","mesh":0,"sca)"
         R"(le":[2,2,2]},{"name":"again","mesh":0}],"meshes":[{"name":"square","primitives":[{"attributes":{)"
         R"("POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],"materials":[{"name":"paint","extensio)"
         R"(ns":{"KHR_materials_unlit":{}}}],"extensionsUsed":["KHR_materials_unlit"],"animations":[{"channe)"
         R"(ls":[{"sampler":0,"target":{"node":1,"path":"translation"}}],"samplers":[{"input":3,"output":4}])"
         R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max")"
         R"(:[1,1,0]},{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":2,"compone)"
         R"(ntType":5123,"count":6,"type":"SCALAR"},{"bufferView":3,"componentType":5126,"count":2,"type":"S)"
         R"(CALAR","min":[0],"max":[1]},{"bufferView":4,"componentType":5126,"count":2,"type":"VEC3"}],"buff)"
         R"(erViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":3)"
         R"(2},{"buffer":0,"byteOffset":80,"byteLength":12},{"buffer":0,"byteOffset":92,"byteLength":8},{"bu)"
         R"(ffer":0,"byteOffset":100,"byteLength":24}],"buffers":[{"byteLength":124,"uri":"data:application/)"
         R"(octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8A)"
         R"(AIA/AACAPwAAgD8AAAAAAAAAAAAAAAAAAAEAAgAAAAIAAwAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAA=="}]})";
}

}  // namespace solidnoise
