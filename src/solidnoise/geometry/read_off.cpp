#include <cerrno>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <fmt/format.h>

#include "solidnoise/geometry/check_off.h"
#include "solidnoise/geometry/mesh_codecs.h"
#include "solidnoise/geometry/mesh_importer.h"
#include "solidnoise/geometry/openmesh_session.h"

namespace solidnoise {
namespace {

// OpenMesh's reader of streams does not look at the keyword: what a vertex has it knows from the last file
// that it was asked about by name. So it is asked about one that has the keyword alone.
void announce(const std::string& keyword, const std::string& name) {
  std::string path = (std::filesystem::temp_directory_path() / "solidnoise-XXXXXX.off").string();
  const int file = mkstemps(path.data(), 4);
  const std::string line = keyword + '\n';
  const bool written = file >= 0 && write(file, line.data(), line.size()) == std::ssize(line);
  const int fault = errno;
  const bool known = written && OpenMesh::IO::OFFReader().can_u_read(path);
  if (file >= 0) {
    close(file);
    std::filesystem::remove(path);
  }
  if (!known) {
    throw std::runtime_error(
        fmt::format("{}: reading OFF takes a temporary file, and {} cannot be written: {}", name, path,
                    std::generic_category().message(fault)));
  }
}

}  // namespace

MeshReading read_off(std::string_view bytes, const std::string& name) {
  CheckedOff checked = check_off(bytes, name);
  MeshReading reading;
  reading.comments = std::move(checked.comments);
  reading.notes = std::move(checked.notes);
  MeshImporter importer(name);
  {
    const OpenMeshSession session;
    announce(checked.keyword, name);
    std::istringstream stream(std::move(checked.text));
    OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexNormal | OpenMesh::IO::Options::VertexColor |
                                  OpenMesh::IO::Options::VertexTexCoord);
    OpenMesh::IO::OFFReader().read(stream, importer, options);
  }
  reading.mesh = importer.take_mesh();
  reading.mesh.positions = std::move(checked.positions);
  reading.mesh.position_type = checked.position_type;
  return reading;
}

}  // namespace solidnoise
