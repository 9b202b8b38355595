#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <OpenMesh/Core/IO/Options.hh>
#include <OpenMesh/Core/IO/exporter/BaseExporter.hh>

#include "solidnoise/geometry/openmesh_session.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// The half-edges of a mesh's faces, as OpenMesh's own format has them. Half-edges 2 e and 2 e + 1 are the two
// directions of edge e; those of one face make a loop, in the face's order, and so do those of no face,
// around each hole. Any faces with vertices will do: an edge joins two faces that go along it in opposite
// directions, in the order of the faces; where more meet, or where two agree in direction, there are several
// edges between the same two vertices, open on one side.
struct HalfEdges {
  struct HalfEdge {
    std::int32_t next = -1;
    std::int32_t vertex = -1;  // that it points to
    std::int32_t face = -1;    // -1: of none
  };

  std::vector<HalfEdge> halfedges;
  std::vector<std::int32_t> of_face;  // one of each face, that points to its first corner
  std::vector<std::int32_t>
      of_vertex;  // one that leaves it, of no face if there is such; -1 if there is none

  // Throws std::invalid_argument: a face without vertices, more half-edges than an int32 can number.
  explicit HalfEdges(const PolygonMesh& mesh);
};

// Shows a PolygonMesh to OpenMesh's writers: positions, faces, and the normals, colours and texture
// coordinates that it has. Normals that are not finite are 0; colours have 8 bits, and are opaque if there is
// no alpha.
class MeshExporter : public OpenMesh::IO::BaseExporter {
 public:
  explicit MeshExporter(const PolygonMesh& mesh);

  // Makes what OpenMesh's own format wants besides: half-edges, and a property of every number of the
  // vertices that is no part of a normal or a colour. Throws what HalfEdges does.
  void add_connectivity();
  void add_properties();

  // That say what there is to write.
  OpenMesh::IO::Options options() const;

  OpenMesh::Vec3f point(OpenMesh::VertexHandle vertex) const override;
  OpenMesh::Vec3d pointd(OpenMesh::VertexHandle vertex) const override;
  bool is_point_double() const override { return position_type_ == ScalarType::float64; }
  OpenMesh::Vec3f normal(OpenMesh::VertexHandle vertex) const override;
  OpenMesh::Vec3uc color(OpenMesh::VertexHandle vertex) const override;
  OpenMesh::Vec4uc colorA(OpenMesh::VertexHandle vertex) const override;
  OpenMesh::Vec2f texcoord(OpenMesh::VertexHandle vertex) const override;
  unsigned int get_vhandles(OpenMesh::FaceHandle face,
                            std::vector<OpenMesh::VertexHandle>& corners) const override;
  int get_halfedge_id(OpenMesh::VertexHandle vertex) override;
  int get_halfedge_id(OpenMesh::FaceHandle face) override;
  int get_next_halfedge_id(OpenMesh::HalfedgeHandle halfedge) override;
  int get_to_vertex_id(OpenMesh::HalfedgeHandle halfedge) override;
  int get_face_id(OpenMesh::HalfedgeHandle halfedge) override;
  const OpenMesh::BaseKernel* kernel() override { return &kernel_; }
  std::size_t n_vertices() const override { return mesh_.positions.size(); }
  std::size_t n_faces() const override { return mesh_.face_count(); }
  std::size_t n_edges() const override { return halfedges_.size() / 2; }
  bool is_triangle_mesh() const override { return is_triangle_mesh_; }
  bool has_vertex_normals() const override { return !normals_.empty(); }
  bool has_vertex_colors() const override { return !colors_.empty(); }
  bool has_vertex_texcoords() const override { return !texture_.empty(); }

  // What the writers do not ask for with these options.
  using Vertex = OpenMesh::VertexHandle;
  using Halfedge = OpenMesh::HalfedgeHandle;
  using Edge = OpenMesh::EdgeHandle;
  using Face = OpenMesh::FaceHandle;
  using Status = OpenMesh::Attributes::StatusInfo;
  OpenMesh::Vec3d normald(Vertex) const override { return OpenMesh::Vec3d(0); }
  bool is_normal_double() const override { return false; }
  OpenMesh::Vec3ui colori(Vertex) const override { return OpenMesh::Vec3ui(0); }
  OpenMesh::Vec4ui colorAi(Vertex) const override { return OpenMesh::Vec4ui(0); }
  OpenMesh::Vec3f colorf(Vertex) const override { return OpenMesh::Vec3f(0); }
  OpenMesh::Vec4f colorAf(Vertex) const override { return OpenMesh::Vec4f(0); }
  OpenMesh::Vec2f texcoord(Halfedge) const override { return OpenMesh::Vec2f(0); }
  Status status(Vertex) const override { return {}; }
  Halfedge getHeh(Face, Vertex) const override { return Halfedge(); }
  unsigned int get_face_texcoords(std::vector<OpenMesh::Vec2f>&) const override { return 0; }
  OpenMesh::Vec3f normal(Face) const override { return OpenMesh::Vec3f(0); }
  OpenMesh::Vec3d normald(Face) const override { return OpenMesh::Vec3d(0); }
  OpenMesh::Vec3uc color(Face) const override { return OpenMesh::Vec3uc(0); }
  OpenMesh::Vec4uc colorA(Face) const override { return OpenMesh::Vec4uc(0); }
  OpenMesh::Vec3ui colori(Face) const override { return OpenMesh::Vec3ui(0); }
  OpenMesh::Vec4ui colorAi(Face) const override { return OpenMesh::Vec4ui(0); }
  OpenMesh::Vec3f colorf(Face) const override { return OpenMesh::Vec3f(0); }
  OpenMesh::Vec4f colorAf(Face) const override { return OpenMesh::Vec4f(0); }
  Status status(Face) const override { return {}; }
  OpenMesh::Vec3uc color(Edge) const override { return OpenMesh::Vec3uc(0); }
  OpenMesh::Vec4uc colorA(Edge) const override { return OpenMesh::Vec4uc(0); }
  OpenMesh::Vec3ui colori(Edge) const override { return OpenMesh::Vec3ui(0); }
  OpenMesh::Vec4ui colorAi(Edge) const override { return OpenMesh::Vec4ui(0); }
  OpenMesh::Vec3f colorf(Edge) const override { return OpenMesh::Vec3f(0); }
  OpenMesh::Vec4f colorAf(Edge) const override { return OpenMesh::Vec4f(0); }
  Status status(Edge) const override { return {}; }
  Status status(Halfedge) const override { return {}; }

 private:
  bool is_shown_otherwise(const VertexProperty& property) const;

  const PolygonMesh& mesh_;
  ScalarType position_type_;
  bool is_triangle_mesh_;
  std::vector<const VertexProperty*> normals_;
  std::vector<const VertexProperty*> colors_;
  std::vector<const VertexProperty*> texture_;
  std::vector<HalfEdges::HalfEdge> halfedges_;
  std::vector<std::int32_t> halfedge_of_face_;
  std::vector<std::int32_t> halfedge_of_vertex_;
  VertexKernel kernel_;
};

}  // namespace solidnoise
