#pragma once

#include <cstddef>
#include <locale>
#include <mutex>

#include <OpenMesh/Core/Mesh/BaseKernel.hh>

namespace solidnoise {

// A time in which OpenMesh's readers and writers may be called. They are one of each for the whole program
// and keep between two calls what they are at, so that sessions wait for each other. In a session OpenMesh
// prints nothing, and the program's locale is "C", which is what OpenMesh reads numbers by.
class OpenMeshSession {
 public:
  OpenMeshSession();
  ~OpenMeshSession();
  OpenMeshSession(const OpenMeshSession&) = delete;
  OpenMeshSession& operator=(const OpenMeshSession&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  std::locale locale_;
  bool prints_errors_;
  bool prints_log_;
};

// Holds properties of vertices for OpenMesh's readers and writers, without a mesh.
class VertexKernel : public OpenMesh::BaseKernel {
 public:
  explicit VertexKernel(std::size_t vertices) : vertices_(vertices) {}
  std::size_t n_vertices() const override { return vertices_; }

 private:
  std::size_t vertices_;
};

}  // namespace solidnoise
