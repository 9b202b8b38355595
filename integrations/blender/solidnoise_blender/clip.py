"""The part of a mesh that is in a box: what is far from a volume takes no voxels of its mask."""

import bmesh
import numpy as np
from mathutils import Vector
from mathutils.geometry import delaunay_2d_cdt

_INSIDE = 1  # of delaunay_2d_cdt()
_WIDER = (0.0, 0.1, 0.3)  # of the box's margin, tried one after the other: a cut beside a vertex may not close


def clipped(vertices: np.ndarray, faces: np.ndarray, lower: np.ndarray, upper: np.ndarray, margin: float) -> tuple[np.ndarray, np.ndarray]:
    """What is in a box, or about a margin around it, of a closed mesh of triangles, closed again; all of it where that fails, as of an open one."""
    if (vertices.min(0) >= lower - margin).all() and (vertices.max(0) <= upper + margin).all():
        return vertices, faces
    welded, places = np.unique(vertices, axis=0, return_inverse=True)
    for wider in _WIDER:
        around = margin * (1 + wider)
        result = _cut(welded, places.reshape(-1)[faces], lower - around, upper + around)
        if _is_closed(result[1]):
            return result
    return vertices, faces


def _is_closed(faces: np.ndarray) -> bool:
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), 1)
    return (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()


def _cut(vertices: np.ndarray, faces: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    shape = bmesh.new()
    corners = [shape.verts.new(vertex) for vertex in vertices]
    for face in faces:
        triangle = [corners[index] for index in face]
        if len(set(face)) == 3 and not shape.faces.get(triangle):
            shape.faces.new(triangle)
    rounding = 1e-6 * np.abs(vertices).max()
    for sign, axis, bound in [(sign, axis, bound[axis]) for sign, bound in ((-1, lower), (1, upper)) for axis in range(3)]:
        normal = sign * np.eye(3)[axis]
        bmesh.ops.bisect_plane(shape, geom=[*shape.verts, *shape.edges, *shape.faces], dist=rounding, plane_co=abs(normal) * bound,
                               plane_no=normal, clear_outer=True)
        _close(shape, axis, [edge for edge in shape.edges if edge.is_boundary and
                             all(abs(vertex.co[axis] - bound) <= 2 * rounding for vertex in edge.verts)])
    bmesh.ops.triangulate(shape, faces=shape.faces[:])
    shape.verts.index_update()
    result = (np.array([vertex.co for vertex in shape.verts]).reshape(-1, 3),
              np.array([[vertex.index for vertex in face.verts] for face in shape.faces], np.int32).reshape(-1, 3))
    shape.free()
    return result


def _close(shape, axis: int, rim: list) -> None:
    """Fills what edges in a plane enclose, but for the holes in it."""
    vertices = list({vertex: None for edge in rim for vertex in edge.verts})
    places = {vertex: place for place, vertex in enumerate(vertices)}
    flat = np.array([np.delete(vertex.co, axis) for vertex in vertices]).reshape(-1, 2)
    edges = np.array([[places[vertex] for vertex in edge.verts] for edge in rim]).reshape(-1, 2)
    points, _, triangles, origins, _, _ = delaunay_2d_cdt([Vector(point) for point in flat], edges.tolist(), [], _INSIDE, 0.0)
    for triangle in triangles:
        corners = [vertices[origins[place][0]] for place in triangle if origins[place]]
        if len(set(corners)) == 3 and _is_enclosed(np.mean([points[place] for place in triangle], 0), flat[edges]):
            shape.faces.new(corners)


def _is_enclosed(point: np.ndarray, edges: np.ndarray) -> bool:
    """Whether a ray from the point crosses an odd number of edges."""
    (x0, y0), (x1, y1) = edges[:, 0].T, edges[:, 1].T
    crosses = (y0 > point[1]) != (y1 > point[1])
    ends = x0[crosses] + (point[1] - y0[crosses]) / (y1 - y0)[crosses] * (x1 - x0)[crosses]
    return (ends > point[0]).sum() % 2 == 1
