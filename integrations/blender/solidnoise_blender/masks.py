"""Masks of volumes by a mesh: what is in it, or what is not."""

import hashlib
import itertools
import os
from dataclasses import dataclass

import numpy as np

from .clip import clipped
from .errors import Refused
from .memory import make_volume

_NO_NOISE = {"type": "gabor", "frequency": 1}
_AROUND = 3  # voxels around a volume that its mask has, so that it ends out of it


def _constant(value: float, file: str, grid: str) -> dict:
    """A recipe that has a grid's active voxels be the same everywhere."""
    return {"noise": _NO_NOISE, "layers": [{"weight": 0, "bias": value}], "shaping": {"type": "raw"}, "combine": "replace",
            "on": {"file": file, "grid": grid}}


def surface(context, mesh_object, volume_object) -> tuple[np.ndarray, np.ndarray]:
    """A mesh as it is seen, with its modifiers, in the volume's coordinates."""
    evaluated = mesh_object.evaluated_get(context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    try:
        if len(mesh.vertices) == 0:
            raise Refused(f"{mesh_object.name}: the mesh has no vertices")
        mesh.calc_loop_triangles()
        positions = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", positions)
        faces = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", faces)
    finally:
        evaluated.to_mesh_clear()
    to_volume = np.array(volume_object.matrix_world.inverted_safe() @ mesh_object.matrix_world)
    return positions.reshape(-1, 3) @ to_volume[:3, :3].T + to_volume[:3, 3], faces.reshape(-1, 3)


@dataclass(frozen=True)
class Mask:
    """A closed mesh that limits the change of a volume, in the volume's coordinates: to what is in it, or out of it; between, the change ends
    over `feather` world units of the volume, or two voxels. `matrices` of grids take voxels to world units; without one a grid's axes are those."""

    mesh_name: str
    volume_name: str
    vertices: np.ndarray
    faces: np.ndarray
    feather: float
    is_inside: bool
    must_touch: bool  # the volume; frames of a sequence may go by it
    matrices: dict

    def key(self) -> list:
        """The same for the same mask."""
        return [hashlib.sha256(self.vertices.tobytes() + self.faces.tobytes()).hexdigest(), self.feather, self.is_inside]

    def limits(self, folder: str, file: str, grids: list) -> dict:
        """For each of a file's grids that has anything to change, what of a recipe limits the change. The files are in the folder."""
        boxes = [self._box(grid) for grid in grids]
        voxel = min(min(grid.voxel_size) for grid in grids)
        vertices, faces = clipped(self.vertices, self.faces, np.min([lower for lower, _ in boxes], 0),
                                  np.max([upper for _, upper in boxes], 0), self.feather + _AROUND * voxel)
        touched = [len(faces) > 0 and (vertices.max(0) >= lower).all() and (vertices.min(0) <= upper).all() for lower, upper in boxes]
        if self.must_touch and not any(touched):
            raise Refused(f"{self.mesh_name} does not touch {self.volume_name}")
        inside = self._inside(folder, vertices, faces, voxel) if any(touched) else ""
        if self.is_inside:
            return {grid.name: {"mask": {"file": inside}} for grid, is_touched in zip(grids, touched) if is_touched}
        return {grid.name: {"mask": _outside(folder, file, grid.name, inside)} if is_touched else {} for grid, is_touched in zip(grids, touched)}

    def _box(self, grid) -> tuple[np.ndarray, np.ndarray]:
        """Of a grid's active voxels, in world units."""
        lower, upper = np.array(grid.bounds)
        matrix = self.matrices.get(grid.name)
        if matrix is None:
            matrix = np.diag([*grid.voxel_size, 1.0])
            matrix[:3, 3] = grid.origin - lower * grid.voxel_size
        corners = np.array(list(itertools.product(*zip(lower - 0.5, upper + 0.5)))) @ matrix[:3, :3].T + matrix[:3, 3]
        return corners.min(0), corners.max(0)

    def _inside(self, folder: str, vertices: np.ndarray, faces: np.ndarray, voxel: float) -> str:
        """The file of a mask that is 1 in the mesh."""
        mesh, path = (os.path.join(folder, name) for name in ("mask.obj", "inside.vdb"))
        with open(mesh, "w") as file:
            file.writelines("v {:.9g} {:.9g} {:.9g}\n".format(*vertex) for vertex in vertices)
            file.writelines("f {} {} {}\n".format(*(corners + 1)) for corners in faces)
        recipe = {"noise": _NO_NOISE, "layers": [{"weight": 0, "bias": 1}], "shaping": {"type": "remap", "threshold": 0, "softness": 1},
                  "density": 1, "shape": {"type": "mesh", "file": mesh}, "voxel": voxel, **({"edge": self.feather} if self.feather else {})}
        make_volume(recipe).write(path)
        return path


def _outside(folder: str, file: str, grid: str, inside: str) -> dict:
    """A mask that is 1 at a grid's active voxels, but for what is in the mesh."""
    whole, outside = (os.path.join(folder, f"{name}.vdb") for name in ("whole", f"outside-{grid}"))
    make_volume(_constant(1, file, grid)).write(whole, force=True)
    make_volume({**_constant(0, whole, grid), "mask": {"file": inside}}).write(outside, force=True)
    return {"file": outside, "grid": grid}
