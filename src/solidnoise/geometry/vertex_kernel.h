#pragma once

#include <cstddef>

#include <OpenMesh/Core/Mesh/BaseKernel.hh>

namespace solidnoise {

// Holds properties of vertices for OpenMesh's readers and writers, without a mesh.
class VertexKernel : public OpenMesh::BaseKernel {
 public:
  explicit VertexKernel(std::size_t vertices) : vertices_(vertices) {}
  std::size_t n_vertices() const override { return vertices_; }

 private:
  std::size_t vertices_;
};

}  // namespace solidnoise
