#pragma once

#include <cstdint>

namespace solidnoise {

// OpenMesh's binary format, as its header OMFormat.hh lays it down, little-endian: "OM", a letter for the
// kind of faces ([T]riangles, [Q]uads, [P]olygons), the version (major in the upper three bits), the counts
// of vertices, faces and edges as uint32, then chunks: a header of 16 bits, the name of the property if it
// has one, and the numbers of all vertices, faces, edges or half-edges.
inline constexpr std::uint8_t om_version(unsigned major, unsigned minor) {
  return static_cast<std::uint8_t>(major << 5 | minor);
}

struct OmChunk {
  enum Entity : unsigned { vertex = 0, mesh = 1, face = 2, edge = 4, halfedge = 6, end = 7 };
  enum Type : unsigned {
    position = 0,
    normal = 1,
    texture = 2,
    status = 3,
    color = 4,
    custom = 6,
    topology = 7
  };

  bool named = false;
  unsigned entity = vertex;
  unsigned type = position;
  bool is_signed = false;
  bool is_float = false;
  unsigned dimensions = 1;  // 1 .. 8
  unsigned bits = 0;        // of integers: 8 << bits; of floats: 32 << bits

  std::uint16_t pack() const {
    return static_cast<std::uint16_t>((named ? 1u : 0u) << 1 | entity << 2 | type << 5 |
                                      (is_signed ? 1u : 0u) << 9 | (is_float ? 1u : 0u) << 10 |
                                      (dimensions - 1) << 11 | bits << 14);
  }

  static OmChunk unpack(std::uint16_t word) {
    OmChunk chunk;
    chunk.named = (word >> 1 & 1) != 0;
    chunk.entity = word >> 2 & 7;
    chunk.type = word >> 5 & 15;
    chunk.is_signed = (word >> 9 & 1) != 0;
    chunk.is_float = (word >> 10 & 1) != 0;
    chunk.dimensions = (word >> 11 & 7u) + 1;
    chunk.bits = word >> 14 & 3;
    return chunk;
  }
};

}  // namespace solidnoise
