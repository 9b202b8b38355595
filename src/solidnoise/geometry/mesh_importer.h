#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>

#include "solidnoise/geometry/openmesh_session.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// Takes what OpenMesh's readers find into a PolygonMesh. A mesh of OpenMesh's own would refuse faces at an
// edge that has two already, copy vertices, or drop what is degenerate; here vertices and faces stay what and
// where the file has them, and faces that come as loops of half-edges are walked only when all of them are
// there.
//
// Its functions throw std::runtime_error naming the file and the vertex or face: a position that is not
// finite, a face of a vertex that is not there, half-edges that are no loop.
class MeshImporter : public OpenMesh::IO::BaseImporter {
 public:
  // `name` stands for the path in messages. Properties of OpenMesh's files have `vertices` numbers.
  explicit MeshImporter(const std::string& name, std::size_t vertices = 0) : name_(name), kernel_(vertices) {}

  // What was read: the file's positions and faces; nx ny nz, red green blue alpha, s t where there are any.
  PolygonMesh take_mesh();

  // The numbers of a property of an .om file, as set_property() takes them; none if there is no such one.
  VertexProperty property(const std::string& name, ScalarType type) const;

  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& point) override;
  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3d& point) override;
  OpenMesh::FaceHandle add_face(const VHandles& corners) override;
  OpenMesh::HalfedgeHandle add_edge(OpenMesh::VertexHandle from, OpenMesh::VertexHandle to) override;
  OpenMesh::FaceHandle add_face(OpenMesh::HalfedgeHandle halfedge) override;
  void set_next(OpenMesh::HalfedgeHandle halfedge, OpenMesh::HalfedgeHandle next) override;
  void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal) override;
  void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3d& normal) override;
  void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3uc& color) override;
  void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4uc& color) override;
  void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& color) override;
  void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4f& color) override;
  void set_texcoord(OpenMesh::VertexHandle vertex, const OpenMesh::Vec2f& place) override;
  OpenMesh::BaseKernel* kernel() override { return &kernel_; }
  std::size_t n_vertices() const override { return mesh_.positions.size(); }
  std::size_t n_faces() const override { return mesh_.face_count(); }
  std::size_t n_edges() const override { return halfedges_.size() / 2; }

  // What a PolygonMesh has no place for, and what follows from the rest.
  using Vertex = OpenMesh::VertexHandle;
  using Halfedge = OpenMesh::HalfedgeHandle;
  using Edge = OpenMesh::EdgeHandle;
  using Face = OpenMesh::FaceHandle;
  using Status = OpenMesh::Attributes::StatusInfo;
  Vertex add_vertex() override { return Vertex(); }
  void set_point(Vertex, const OpenMesh::Vec3f&) override {}
  void set_halfedge(Vertex, Halfedge) override {}
  void set_face(Halfedge, Face) override {}
  void add_face_texcoords(Face, Vertex, const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(Face, Vertex, const std::vector<OpenMesh::Vec3f>&) override {}
  void set_face_texindex(Face, int) override {}
  void request_face_texcoords2D() override {}
  void set_texcoord(Halfedge, const OpenMesh::Vec2f&) override {}
  void set_texcoord(Vertex, const OpenMesh::Vec3f&) override {}
  void set_texcoord(Halfedge, const OpenMesh::Vec3f&) override {}
  void set_status(Vertex, const Status&) override {}
  void set_status(Halfedge, const Status&) override {}
  void set_status(Edge, const Status&) override {}
  void set_status(Face, const Status&) override {}
  void set_color(Edge, const OpenMesh::Vec3uc&) override {}
  void set_color(Edge, const OpenMesh::Vec4uc&) override {}
  void set_color(Edge, const OpenMesh::Vec3f&) override {}
  void set_color(Edge, const OpenMesh::Vec4f&) override {}
  void set_normal(Face, const OpenMesh::Vec3f&) override {}
  void set_normal(Face, const OpenMesh::Vec3d&) override {}
  void set_color(Face, const OpenMesh::Vec3uc&) override {}
  void set_color(Face, const OpenMesh::Vec4uc&) override {}
  void set_color(Face, const OpenMesh::Vec3f&) override {}
  void set_color(Face, const OpenMesh::Vec4f&) override {}
  void add_texture_information(int, std::string) override {}

 private:
  struct HalfedgeEnds {
    std::int64_t next;
    std::int64_t vertex;  // that it points to
  };

  OpenMesh::VertexHandle add_position(const Vec<3>& position);
  void set_color(OpenMesh::VertexHandle vertex, const TextColor& color);
  void walk_loops();
  std::uint32_t checked_corner(std::size_t face, std::int64_t corner) const;
  [[noreturn]] void refuse(const std::string& what) const;

  const std::string& name_;
  VertexKernel kernel_;
  PolygonMesh mesh_;
  std::vector<std::array<double, 3>> normals_;
  std::vector<TextColor> colors_;
  std::vector<std::array<double, 2>> texture_;
  std::vector<HalfedgeEnds> halfedges_;
  std::vector<std::int64_t> loops_;  // a half-edge of each face
};

}  // namespace solidnoise
