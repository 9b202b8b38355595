// OFF without OpenMesh, whose reader is a library of its own: the text that the check makes for it holds a
// mesh already.

#include <cstdint>
#include <utility>
#include <vector>

#include "solidnoise/geometry/check_off.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {

MeshReading read_off(std::string_view bytes, const std::string& name) {
  CheckedOff checked = check_off(bytes, name);
  MeshReading reading{.comments = std::move(checked.comments), .notes = std::move(checked.notes)};
  TextLines lines(checked.text, name);
  // Keyword and counts, and a line of each vertex, are before the faces'.
  for (std::size_t i = 0; i < 2 + checked.positions.size(); ++i) lines.next();
  reading.mesh.positions = std::move(checked.positions);
  reading.mesh.position_type = checked.position_type;
  std::vector<std::uint32_t> corners;
  while (lines.next()) {
    std::string_view text = lines.line();
    corners.clear();
    take_word(text);  // how many there are
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
      corners.push_back(*parse_number<std::uint32_t>(word));
    }
    reading.mesh.add_face(corners);
  }
  return reading;
}

}  // namespace solidnoise
