#include "meshnoise/mesh_input.h"

#include <iostream>

#include <fmt/format.h>

#include "solidnoise/geometry/inspect_mesh.h"

namespace solidnoise {

MeshReading read_input_mesh(const std::string& path, Notes notes) {
  MeshReading reading = read_mesh(path);
  if (notes == Notes::keep_quiet) return reading;
  for (const std::string& note : reading.notes) std::cerr << fmt::format("meshnoise: {}: {}\n", path, note);
  for (const std::string& warning : mesh_warnings(inspect_mesh(reading.mesh))) {
    std::cerr << fmt::format("meshnoise: warning: {}: {}\n", path, warning);
  }
  return reading;
}

}  // namespace solidnoise
