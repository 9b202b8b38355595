#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <OpenMesh/Core/IO/OMFormat.hh>

#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// A file of OpenMesh's own format with the chunks of it that OpenMesh's reader is to take.
struct CheckedOm {
  OpenMesh::IO::OMFormat::Header header;
  std::string bytes;
  std::vector<std::pair<std::string, ScalarType>> properties;  // numbers of the vertices, by name
  std::vector<std::string> notes;
};

// Goes through the file's chunks by their headers, and throws std::runtime_error that names the file and what
// is wrong: a header that is not known, more than the file can hold, positions or faces that are not there.
// OpenMesh's reader looks neither at the end of the file nor at the types that chunks say they have, so that
// it is given none but those that it reads as they are: positions, normals and colours of the vertices,
// numbers of theirs, faces, half-edges. Whether these fit together is for MeshImporter to see.
CheckedOm check_om(std::string_view bytes, const std::string& name);

}  // namespace solidnoise
