#pragma once

#include <bit>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// Writes numbers as text or as bytes to a stream, through a buffer. The destructor drops what finish() has
// not written.
class NumberWriter {
 public:
  explicit NumberWriter(std::ostream& stream, std::endian order = std::endian::little)
      : stream_(stream), order_(order) {}

  void text(std::string_view text);
  // A number as the shortest decimal that reads back as the same number of its type.
  void decimal(double value, ScalarType type);
  // The same, but 0 for what is not finite in its type.
  void finite_decimal(double value, ScalarType type);
  void decimal(std::uint64_t value);
  // The shortest that reads back as the same double; as if it were a float32 where it is one.
  void decimal(double value);
  // A number as the bytes of its type. What the type cannot hold is clamped, integers are rounded.
  void bytes(double value, ScalarType type);

  void finish();

 private:
  void flush_if_full();

  std::ostream& stream_;
  std::endian order_;
  std::string buffer_;
};

// Writes comments, a line each, behind `mark`; those of several lines are split.
void write_comments(NumberWriter& out, std::string_view mark, const std::vector<std::string>& comments);

// position_type, or float64 if a position is too large for a float32.
ScalarType stored_position_type(const PolygonMesh& mesh);

}  // namespace solidnoise
