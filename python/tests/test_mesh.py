"""Meshes: what is baked is what meshnoise bakes, bit for bit; curvature, parameters of each vertex, faces of every kind."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
import solidnoise

Array = npt.NDArray[Any]
Tool = Callable[..., str]


def sphere(rings: int = 24, segments: int = 48) -> tuple[Array, list[list[int]]]:
    """Of radius 1: quads, and triangles at the poles."""
    theta = np.linspace(0.0, np.pi, rings + 2)[1:-1]
    phi = np.arange(segments) * 2.0 * np.pi / segments
    t, p = np.meshgrid(theta, phi, indexing="ij")
    vertices = np.stack([np.sin(t) * np.cos(p), np.cos(t), np.sin(t) * np.sin(p)], axis=-1).reshape(-1, 3)
    vertices = np.concatenate([vertices, [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]])
    faces = []
    for j in range(segments):
        k = (j + 1) % segments
        faces.append([rings * segments, k, j])
        for i in range(rings - 1):
            faces.append([i * segments + j, i * segments + k, (i + 1) * segments + k, (i + 1) * segments + j])
        faces.append([rings * segments + 1, (rings - 1) * segments + j, (rings - 1) * segments + k])
    return vertices, faces


def write_ply(path: Path, vertices: Array, faces: list[list[int]]) -> None:
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    lines += [f"property double {axis}" for axis in "xyz"]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    corners = b"".join(bytes([len(face)]) + np.array(face, "<i4").tobytes() for face in faces)
    path.write_bytes("\n".join([*lines, ""]).encode() + np.asarray(vertices, "<f8").tobytes() + corners)


def read_ply(path: Path) -> dict[str, Array]:
    """The numbers of the vertices of a binary file, by name."""
    header, data = path.read_bytes().split(b"end_header\n", 1)
    types = {b"float": "<f4", b"double": "<f8", b"uchar": "u1", b"int": "<i4"}
    fields, count = [], 0
    for line in header.split(b"\n"):
        words = line.split()
        if words[:2] == [b"element", b"vertex"]:
            count = int(words[2])
        if words[:1] == [b"property"] and len(words) == 3:
            fields.append((words[2].decode(), types[words[1]]))
    rows = np.frombuffer(data, dtype=fields, count=count)
    return {name: rows[name] for name, _ in fields}


VERTICES, FACES = sphere()


@pytest.mark.parametrize("name", ["rust", "scales", "stone", "bark", "skin", "moss", "car-paint", "raw"])
def test_values_are_those_of_meshnoise(name: str, tool: Tool, tmp_path: Path) -> None:
    recipe = {**solidnoise.preset(name, "bake"), "refine": {"mode": "off"}}
    write_ply(tmp_path / "in.ply", VERTICES, FACES)
    (tmp_path / "recipe.json").write_text(json.dumps(recipe))
    tool("meshnoise", "bake", "in.ply", "--recipe", "recipe.json", "--out", "out.ply")
    by_tool = read_ply(tmp_path / "out.ply")
    baked = solidnoise.bake(VERTICES, FACES, recipe)
    np.testing.assert_array_equal(baked["noise"], by_tool["noise"])
    shown = np.clip(baked["colors"], 0, 1)  # of an exemplar, some are beyond what a file can hold
    encoded = np.where(shown <= 0.0031308, 12.92 * shown, 1.055 * shown ** (1 / 2.4) - 0.055)
    for channel, color in enumerate(("red", "green", "blue")):
        # The file's bytes; rounding of the formula in another precision may fall on the other side.
        assert np.abs(encoded[:, channel] * 255 - by_tool[color]).max() < 0.501


def test_arrays_of_a_bake() -> None:
    baked = solidnoise.bake(VERTICES, FACES, solidnoise.preset("rust"), keep=["frequency", "weight"])
    count = len(VERTICES)
    assert list(baked) == ["vertices", "faces", "normals", "colors", "noise", "height", "roughness", "frequency", "weight"]
    np.testing.assert_array_equal(baked["vertices"], VERTICES)
    assert isinstance(baked["faces"], list) and [list(face) for face in baked["faces"]] == FACES
    assert baked["colors"].shape == (count, 3) and baked["noise"].dtype == np.float32
    np.testing.assert_allclose((baked["normals"] * VERTICES).sum(axis=1), 1.0, atol=2e-3)
    triangles = np.array([[face[0], face[i], face[i + 1]] for face in FACES for i in range(1, len(face) - 1)])
    refined = solidnoise.bake(VERTICES, triangles, refine={"mode": "rounds", "rounds": 1})
    assert refined["faces"].shape == (4 * len(triangles), 3) and len(refined["vertices"]) > count
    np.testing.assert_array_equal(refined["vertices"][:count], VERTICES)


def test_faces_of_mixed_sizes_stay_what_they_are() -> None:
    vertices = np.random.default_rng(1).uniform(-1, 1, (8, 3))
    mixed = [[0, 1, 2, 3], [1, 4, 2], [0, 3, 7, 6, 5]]  # as many corners as three quads have
    assert [list(face) for face in solidnoise.bake(vertices, mixed)["faces"]] == mixed


def test_gradients_and_curls_are_vectors() -> None:
    baked = solidnoise.bake(VERTICES, FACES, frequency=4, keep=["gradient", "curl"])
    assert baked["gradient"].shape == baked["curl"].shape == VERTICES.shape
    np.testing.assert_allclose((baked["gradient"] * baked["curl"]).sum(axis=1), 0.0, atol=1e-3 * np.abs(baked["gradient"]).max() ** 2)


@pytest.mark.parametrize("noise", ["surface", "oriented", "solid", "kensler"])
def test_values_of_a_vertex_depend_on_no_other(noise: str) -> None:
    normals = np.tile([0.0, 0.0, 1.0], (9, 1))
    options: dict[str, Any] = {"noise": noise, "directions": np.tile([1.0, 0.0, 0.0], (9, 1))} if noise == "oriented" else {"noise": noise}
    points = np.random.default_rng(0).uniform(0, 1, (9, 3))
    frequency, bandwidth = np.linspace(2, 9, 9), np.linspace(0.5, 2, 9)
    if noise != "kensler":
        options["bandwidth"] = bandwidth
    whole = solidnoise.surface_noise(points, normals, frequency=frequency, **options)
    for part in (slice(0, 1), slice(1, 5), slice(5, 9)):
        some = {key: value[part] if isinstance(value, np.ndarray) else value for key, value in options.items()}
        np.testing.assert_array_equal(solidnoise.surface_noise(points[part], normals[part], frequency=frequency[part], **some), whole[part])


def test_ranges_follow_an_attribute() -> None:
    height = VERTICES[:, 1]
    baked = solidnoise.bake(VERTICES, FACES, frequency=(4, 16), by={"attribute": "paint", "percentiles": [0, 100]},
                            attributes={"paint": height}, keep=["frequency"])
    np.testing.assert_allclose(baked["frequency"], 4.0 * 4.0 ** ((height + 1) / 2), rtol=1e-3)
    with pytest.raises(ValueError, match="paint has 3 numbers"):
        solidnoise.bake(VERTICES, FACES, attributes={"paint": [1, 2, 3]})


def test_curvature_of_a_sphere() -> None:
    measured = solidnoise.curvature(VERTICES, FACES, smooth=0)
    # The error is of the order of the squared length of edges, 0.13^2 = 0.017, some times that; K has that of both.
    for name in ("k1", "k2", "mean", "gaussian"):
        np.testing.assert_allclose(measured[name], 1.0, atol=0.06)
    assert measured["k1_direction"].shape == VERTICES.shape
    np.testing.assert_allclose((measured["k1_direction"] * measured["k2_direction"]).sum(axis=1), 0.0, atol=1e-6)


def test_surface_noise_has_parameters_of_each_vertex() -> None:
    count = len(VERTICES)
    plain = solidnoise.surface_noise(VERTICES, VERTICES, frequency=6, seed=3)
    assert plain.shape == (count,) and plain.dtype == np.float32
    np.testing.assert_array_equal(solidnoise.surface_noise(VERTICES, VERTICES, {"seed": 3}, frequency=6), plain)
    scaled = solidnoise.surface_noise(VERTICES, VERTICES, frequency=6, seed=3, magnitude=np.linspace(0, 2, count))
    np.testing.assert_allclose(scaled, plain * np.linspace(0, 2, count, dtype=np.float32), rtol=1e-6)
    varying = solidnoise.surface_noise(VERTICES, VERTICES, frequency=np.linspace(4, 8, count))
    assert not np.array_equal(varying, plain)
    oriented = solidnoise.surface_noise(VERTICES, VERTICES, noise="oriented", frequency=6, directions=np.tile([0.0, 1.0, 0.0], (count, 1)))
    assert oriented.std() > 0.5


REFUSED: list[tuple[Callable[[], object], type[Exception], str]] = [
    (lambda: solidnoise.bake(VERTICES, [[0, 1, 99999]]), ValueError, r"faces\[0\] has the vertex 99999; it must be between 0 and"),
    (lambda: solidnoise.bake(VERTICES, [[0, 1, -1]]), ValueError, r"faces\[0\] has the vertex -1"),
    (lambda: solidnoise.bake(VERTICES, [[0, 1]]), ValueError, r"faces\[0\] has 2 corners; it must have 3 at least"),
    (lambda: solidnoise.bake(VERTICES, np.zeros((2, 0), int)), ValueError, r"faces\[0\] has 0 corners"),
    (lambda: solidnoise.bake(VERTICES, FACES, attributes={5: VERTICES[:, 0]}), TypeError, "names of attributes must be texts"),  # type: ignore[dict-item]
    (lambda: solidnoise.bake(VERTICES, FACES, properties={"vertices": {}}), ValueError, "properties has vertices, which is the name of another"),
    (lambda: solidnoise.bake(VERTICES, FACES, properties={"frequency": {}}, keep=["frequency"]), ValueError, "properties has frequency"),
    (lambda: solidnoise.bake(VERTICES, FACES, seed=10**400), ValueError, "too large"),
    (lambda: solidnoise.bake(VERTICES, np.zeros((2, 3))), TypeError, "faces must be whole numbers"),
    (lambda: solidnoise.bake(VERTICES, np.zeros(3, int)), ValueError, "faces must have the shape"),
    (lambda: solidnoise.bake(VERTICES[:, :2], FACES), ValueError, "vertices has the shape"),
    (lambda: solidnoise.bake(VERTICES * np.nan, FACES), ValueError, "finite"),
    (lambda: solidnoise.bake(np.zeros((0, 3)), FACES), ValueError, "vertices is empty; there must be one at least"),
    (lambda: solidnoise.bake([[0, 0, 0], [1]], FACES), ValueError, "vertices must be an array, or lists"),
    (lambda: solidnoise.bake(VERTICES, [[[0, 1], [2]]]), ValueError, "faces must be an array, or lists"),
    (lambda: solidnoise.bake(VERTICES, FACES, attributes={"paint": np.full(len(VERTICES), np.nan)}), ValueError, "paint is nan; it must be"),
    (lambda: solidnoise.bake(VERTICES, FACES, surface={"noise": "spectrum"}), ValueError, "surface.exemplar is missing"),
    (lambda: solidnoise.bake(VERTICES, FACES, bandwidth=-1), ValueError, r"bandwidth is -1; it must be between 0.1 and 4"),
    (lambda: solidnoise.bake(VERTICES, FACES, ramp="rusty"), ValueError, "ramp"),
    (lambda: solidnoise.bake(VERTICES, FACES, keep=["colour"]), ValueError, "keep is colour; it must be one of"),
    (lambda: solidnoise.surface_noise(VERTICES, VERTICES[:5]), ValueError, "normal"),
    (lambda: solidnoise.surface_noise(VERTICES, VERTICES, frequency=[1, 2]), ValueError, "frequency has 2 numbers"),
    (lambda: solidnoise.curvature(VERTICES, FACES, smooth=-1), ValueError, "smooth|rounds"),
]


@pytest.mark.parametrize("call, error, message", REFUSED)
def test_what_is_wrong_is_said(call: Callable[[], object], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message) as raised:
        call()
    assert "\n" not in str(raised.value)


def test_a_mesh_without_anything() -> None:
    for vertices, faces in ((np.zeros((0, 3)), np.zeros((0, 3), int)), (VERTICES[:3], np.zeros((0, 3), int))):
        try:
            assert len(solidnoise.bake(vertices, faces, frequency=4)["noise"]) == len(vertices)
        except ValueError as error:
            assert str(error)
