"""Masks of volumes by a mesh: what is in it, or what is not."""

import os

import numpy as np
import solidnoise

from .errors import Refused

_NO_NOISE = {"type": "gabor", "frequency": 1}


def constant(value: float) -> dict:
    """The keys of a recipe for a field that is the same everywhere."""
    return {"noise": _NO_NOISE, "layers": [{"weight": 0, "bias": value}], "shaping": {"type": "raw"}}


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


def make(folder: str, mesh: tuple, grid, *, feather: float, is_inside: bool) -> str:
    """The file of a mask that is 1 in the mesh, or out of it, within the box of a grid, and 0 elsewhere; between, it goes over `feather`
    world units of the volume, or two voxels."""
    path = os.path.join(folder, "mask.obj")
    with open(path, "w") as file:
        file.writelines("v {:.9g} {:.9g} {:.9g}\n".format(*vertex) for vertex in mesh[0])
        file.writelines("f {} {} {}\n".format(*(corners + 1)) for corners in mesh[1])
    voxel = min(grid.voxel_size)
    recipe = {"noise": _NO_NOISE, "layers": [{"weight": 0, "bias": 1}], "shaping": {"type": "remap", "threshold": 0, "softness": 1},
              "density": 1, "shape": {"type": "mesh", "file": path}, "voxel": voxel, **({"edge": feather} if feather else {})}
    inside = os.path.join(folder, "inside.vdb")
    solidnoise.make_volume(recipe).write(inside)
    if is_inside:
        return inside
    lower, upper = (np.array(corner) * grid.voxel_size for corner in grid.bounds)
    origin = np.array(grid.origin) - lower  # of a volume that is moved in its file
    box = [*(lower + origin - voxel), *(upper + origin + 1.5 * voxel)]
    whole, outside = (os.path.join(folder, f"{name}.vdb") for name in ("whole", "outside"))
    solidnoise.make_volume({**constant(1), "box": box, "voxel": voxel}).write(whole)
    solidnoise.make_volume({**constant(0), "on": {"file": whole}, "combine": "replace", "mask": {"file": inside}}).write(outside)
    return outside
