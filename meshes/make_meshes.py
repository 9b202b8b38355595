#!/usr/bin/env python3
"""make_meshes.py [FOLDER]: makes the sample meshes wyrm.ply, torus.obj and bowl.obj in FOLDER (default: beside this script).

Needs NumPy. Makes the same files every time, but for the last digits of what the machine's NumPy computes.
The wyrm is the zero set of a distance to tapered chains of balls: it is cut out of a grid by dual contouring without
normals, then its vertices are drawn towards curved places and moved at random along the surface, so that the triangles are
as uneven as those of a scan.
"""
import pathlib
import sys

import numpy as np


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def spline(points, count):
    """A uniform cubic B-spline through the neighbourhood of points, from the first to the last, as `count` samples."""
    points = np.asarray(points, float)
    padded = np.vstack([2 * points[0] - points[1], points, 2 * points[-1] - points[-2]])
    t = np.linspace(0, len(points) - 1 - 1e-9, count)
    i, u = t.astype(int), (t % 1)[:, None]
    a, b, c = padded[i], padded[i + 1], padded[i + 2]
    d = padded[np.minimum(i + 3, len(padded) - 1)]
    return ((1 - u) ** 3 * a + (3 * u**3 - 6 * u**2 + 4) * b + (-3 * u**3 + 3 * u**2 + 3 * u + 1) * c + u**3 * d) / 6


def transported(tangents, start):
    """Normals along a curve that turn as little as possible."""
    normals = [unit(start - tangents[0] * np.dot(start, tangents[0]))]
    for t in tangents[1:]:
        n = normals[-1] - t * np.dot(normals[-1], t)
        normals.append(unit(n))
    return np.array(normals)


def capsule_distance(p, a, b, radius_a, radius_b):
    """Roughly the distance to balls whose centre and radius go from a to b."""
    axis = b - a
    along = np.clip((p - a) @ axis / max(axis @ axis, 1e-12), 0, 1)[..., None]
    return np.linalg.norm(p - a - along * axis, axis=-1) - (radius_a + along[..., 0] * (radius_b - radius_a))


def smooth_minimum(a, b, blend):
    h = np.clip(0.5 + 0.5 * (a - b) / blend, 0, 1)
    return a * (1 - h) + b * h - blend * h * (1 - h)


class Shape:
    """Chains of tapered capsules, joined smoothly. Groups are joined over `blend` world units, which leaves creases."""

    def __init__(self):
        self.groups = []  # (ends a, ends b, radii a, radii b, blend)

    def add_chain(self, points, radii, blend):
        points, radii = np.asarray(points, float), np.asarray(radii, float)
        self.groups.append((points[:-1], points[1:], radii[:-1], radii[1:], blend))

    def bounds(self):
        low = np.min([np.min(np.minimum(a - ra[:, None], b - rb[:, None]), axis=0) for a, b, ra, rb, _ in self.groups], axis=0)
        high = np.max([np.max(np.maximum(a + ra[:, None], b + rb[:, None]), axis=0) for a, b, ra, rb, _ in self.groups], axis=0)
        return low, high

    def distance(self, p, reach=0.12):
        """Distance at points p, negative inside; where it is above `reach` it may be that."""
        total = np.full(len(p), reach)
        for a, b, ra, rb, blend in self.groups:
            group = np.full(len(p), reach)
            for k in range(len(a)):
                some = np.flatnonzero(np.all(np.abs(p - (a[k] + b[k]) / 2) < np.abs(b[k] - a[k]) / 2 + max(ra[k], rb[k]) + reach,
                                             axis=1))
                group[some] = np.minimum(group[some], capsule_distance(p[some], a[k], b[k], ra[k], rb[k]))
            total = smooth_minimum(total, group, blend)
        return total

    def distance_on_grid(self, axes, reach):
        """The same at every point of a grid."""
        shape = [len(axis) for axis in axes]
        total = np.full(shape, reach)
        for a, b, ra, rb, blend in self.groups:
            group = np.full(shape, reach)
            for k in range(len(a)):
                r = max(ra[k], rb[k]) + reach
                box = tuple(slice(*np.searchsorted(axes[i], [min(a[k][i], b[k][i]) - r, max(a[k][i], b[k][i]) + r]))
                            for i in range(3))
                p = np.stack(np.meshgrid(*[axes[i][box[i]] for i in range(3)], indexing="ij"), axis=-1)
                group[box] = np.minimum(group[box], capsule_distance(p, a[k], b[k], ra[k], rb[k]))
            low = [max(np.min(np.minimum(a[:, i] - ra, b[:, i] - rb)) - reach, axes[i][0]) for i in range(3)]
            high = [np.max(np.maximum(a[:, i] + ra, b[:, i] + rb)) + reach for i in range(3)]
            box = tuple(slice(*np.searchsorted(axes[i], [low[i], high[i]])) for i in range(3))
            total[box] = smooth_minimum(total[box], group[box], blend)
        return total


def make_wyrm_shape():
    shape = Shape()

    # The centre line: a spiral on the ground from the tail inwards, an arched neck, the head.
    control = []
    for angle in np.linspace(0, 2 * np.pi * 1.55, 26):
        part = angle / (2 * np.pi * 1.55)
        radius = 1.12 - 0.68 * part
        control.append([radius * np.cos(angle + 2.6), 0.02 + 0.2 * part**0.6 + 0.2 * max(part - 0.8, 0) ** 2 / 0.04, radius * np.sin(angle + 2.6)])
    end = np.array(control[-1])
    out = unit(end - np.array(control[-2]))
    control += [end + out * 0.14 + [0, 0.1, 0], 0.6 * (end + out * 0.2) + [0.05, 0.42, -0.08], [0.12, 0.84, -0.22], [0.08, 1.06, -0.2],
                [0.06, 1.24, -0.02], [0.06, 1.27, 0.2], [0.06, 1.22, 0.34]]
    centre = spline(control, 220)
    t = np.linspace(0, 1, len(centre))
    radii = np.interp(t, [0, 0.08, 0.3, 0.5, 0.66, 0.78, 0.9, 1], [0.012, 0.05, 0.15, 0.205, 0.2, 0.165, 0.135, 0.15])
    # Ribs that swell the body a little.
    radii *= 1 + 0.035 * np.sin(2 * np.pi * 26 * t) * np.clip(t / 0.1, 0, 1)
    tangents = unit(np.gradient(centre, axis=0))
    backs = transported(tangents, np.array([0.0, 1.0, 0.0]))
    # The back ends on top of the head: the neck turns by what is missing.
    sides = np.cross(tangents, backs)
    missing = np.arctan2(sides[-1][1], backs[-1][1])
    turn = (missing * np.clip((t - 0.5) / 0.4, 0, 1) ** 2 * (3 - 2 * np.clip((t - 0.5) / 0.4, 0, 1)))[:, None]
    backs = np.cos(turn) * backs + np.sin(turn) * sides
    # The body in pieces: where coils touch, they meet in a crease; neighbours overlap and are one.
    shape.add_chain(centre, radii, 0.03)

    # A crest of thorns along the back, leaning towards the tail.
    for place in np.linspace(0.06, 0.93, 44):
        i = int(place * (len(centre) - 1))
        r = radii[i]
        root = centre[i] + backs[i] * 0.75 * r
        tip = centre[i] + backs[i] * (1.5 * r + 0.045) - tangents[i] * (0.5 * r + 0.01)
        shape.add_chain([root, 0.45 * root + 0.55 * tip, tip], [0.34 * r + 0.006, 0.2 * r + 0.004, 0.009], 0.35 * r)

    # The head, in a frame of its own: forwards, up, sideways.
    forward = unit(np.array([0.0, -0.28, 1.0]))
    side = unit(np.cross([0.0, 1.0, 0.0], forward))
    up = np.cross(forward, side)

    def head(points):
        return centre[-1] + np.array([p[0] * forward + p[1] * up + p[2] * side for p in np.asarray(points, float)])

    shape.add_chain(head([[-0.06, 0.01, 0], [0.12, 0.03, 0]]), [0.17, 0.165], 0.06)
    shape.add_chain(head([[0.12, 0.0, 0], [0.3, -0.02, 0], [0.47, -0.035, 0]]), [0.14, 0.105, 0.082], 0.05)
    shape.add_chain(head([[-0.02, -0.1, 0], [0.2, -0.15, 0], [0.43, -0.135, 0]]), [0.1, 0.075, 0.045], 0.012)
    for mirror in (-1, 1):
        at = lambda points: head([[p[0], p[1], p[2] * mirror] for p in points])
        shape.add_chain(at([[0.49, 0.015, 0.045], [0.46, 0.04, 0.05]]), [0.026, 0.02], 0.015)
        shape.add_chain(at([[0.26, 0.075, 0.075], [0.12, 0.14, 0.12], [-0.06, 0.16, 0.15]]), [0.028, 0.045, 0.03], 0.02)
        shape.add_chain(at([[0.155, 0.075, 0.122], [0.15, 0.075, 0.125]]), [0.042, 0.042], 0.006)
        shape.add_chain(at(spline([[-0.04, 0.12, 0.09], [-0.14, 0.24, 0.14], [-0.3, 0.33, 0.2], [-0.48, 0.34, 0.24],
                                   [-0.62, 0.27, 0.24]], 20)), np.linspace(0.058, 0.009, 20), 0.03)
        for reach, height in ((0.3, -0.02), (0.26, -0.1), (0.2, -0.17)):
            shape.add_chain(at([[-0.02, height, 0.1], [-0.12, height - 0.01, 0.1 + 0.6 * (reach - 0.1)],
                                [-0.22, height + 0.01, reach]]), [0.05, 0.03, 0.009], 0.02)
    for k in range(4):
        shape.add_chain(head([[0.4 - 0.1 * k, 0.03 + 0.03 * k, 0], [0.37 - 0.1 * k, 0.1 + 0.035 * k, 0]]), [0.022, 0.008], 0.02)
    return shape


def without_ambiguous_faces(values):
    """Where only two opposite corners of a cell's face are inside, an edge would belong to four quadrilaterals: puts another
    corner inside, too. The vertices find back to the surface when they are projected."""
    values = values.copy()
    while True:
        found = False
        for u, v in ((0, 1), (1, 2), (2, 0)):
            corner = {}
            for du in (0, 1):
                for dv in (0, 1):
                    part = [slice(None)] * 3
                    part[u] = slice(du, values.shape[u] - 1 + du)
                    part[v] = slice(dv, values.shape[v] - 1 + dv)
                    corner[du, dv] = values[tuple(part)]  # a view
            for one in ((0, 0), (0, 1)):
                other = (1 - one[0], 1 - one[1])
                beside = (one[0], 1 - one[1])
                bad = (corner[one] < 0) & (corner[other] < 0) & (corner[beside] >= 0) & (corner[1 - beside[0], 1 - beside[1]] >= 0)
                if bad.any():
                    corner[beside][bad] = -1e-6
                    found = True
        if not found:
            return values


def surface_net(shape, step):
    """Vertices and quadrilaterals of the zero set: a vertex in every cell that it crosses, at the mean of where it meets the
    cell's edges; a quadrilateral for every lattice edge that it crosses."""
    low, high = shape.bounds()
    low = low - 2.5 * step
    size = np.ceil((high + 2.5 * step - low) / step).astype(int) + 1
    axes = [low[i] + step * np.arange(size[i]) for i in range(3)]
    values = shape.distance_on_grid(axes, reach=4 * step)

    values = without_ambiguous_faces(values)

    inside = values < 0
    sums = np.zeros(tuple(size - 1) + (3,))
    counts = np.zeros(tuple(size - 1))
    crossings = []
    for axis in range(3):
        lower = [slice(None)] * 3
        upper = [slice(None)] * 3
        lower[axis], upper[axis] = slice(None, -1), slice(1, None)
        a, b = values[tuple(lower)], values[tuple(upper)]
        crossed = np.argwhere(inside[tuple(lower)] != inside[tuple(upper)])
        va, vb = a[tuple(crossed.T)], b[tuple(crossed.T)]
        points = crossed.astype(float)
        points[:, axis] += va / (va - vb)
        u, v = (axis + 1) % 3, (axis + 2) % 3
        cells = []
        for du, dv in ((-1, -1), (0, -1), (0, 0), (-1, 0)):
            cell = crossed.copy()
            cell[:, u] += du
            cell[:, v] += dv
            np.add.at(sums, tuple(cell.T), points)
            np.add.at(counts, tuple(cell.T), 1)
            cells.append(cell)
        crossings.append((cells, inside[tuple(lower)][tuple(crossed.T)]))

    used = counts > 0
    index = np.full(used.shape, -1)
    index[used] = np.arange(np.count_nonzero(used))
    vertices = low + step * sums[used] / counts[used][:, None]
    quads = []
    for cells, from_inside in crossings:
        corners = np.stack([index[tuple(cell.T)] for cell in cells], axis=1)
        corners[~from_inside] = corners[~from_inside][:, ::-1]
        quads.append(corners)
    return vertices, np.vstack(quads)


def gradient(shape, p, step=1e-4):
    columns = [(shape.distance(p + step * e) - shape.distance(p - step * e)) / (2 * step) for e in np.eye(3)]
    return np.stack(columns, axis=1)


def project(shape, p, passes=2):
    """Moves points onto the zero set, and gives its normals there."""
    for _ in range(passes):
        g = gradient(shape, p)
        p = p - g * (shape.distance(p) / np.maximum(np.sum(g * g, axis=1), 0.04))[:, None]
    return p, unit(gradient(shape, p) + 1e-12)


def relax(shape, vertices, quads, rounds, jitter, seed):
    """Evens out the spacing along the surface, denser where it is more curved; then moves each vertex at random."""
    edges = np.unique(np.sort(np.vstack([quads[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1), axis=0)
    a, b = edges.T
    p, n = project(shape, vertices)
    for _ in range(rounds):
        bend = np.linalg.norm(n[a] - n[b], axis=1) / np.maximum(np.linalg.norm(p[a] - p[b], axis=1), 1e-9)
        weight = 1 + np.minimum(0.06 * bend, 3.0)
        total = np.zeros(len(p))
        mean = np.zeros_like(p)
        for i, j in ((a, b), (b, a)):
            np.add.at(total, i, weight)
            np.add.at(mean, i, weight[:, None] * p[j])
        shift = mean / total[:, None] - p
        shift -= n * np.sum(shift * n, axis=1, keepdims=True)
        p, n = project(shape, p + 0.6 * shift, 1)
    spacing = np.full(len(p), np.inf)
    length = np.linalg.norm(p[a] - p[b], axis=1)
    np.minimum.at(spacing, a, length)
    np.minimum.at(spacing, b, length)
    random = np.random.default_rng(seed)
    shift = random.uniform(-1, 1, p.shape) * (jitter * spacing)[:, None]
    shift -= n * np.sum(shift * n, axis=1, keepdims=True)
    return project(shape, p + shift)[0]


def triangulate(p, quads):
    """Cuts quadrilaterals along the shorter diagonal."""
    first = np.linalg.norm(p[quads[:, 0]] - p[quads[:, 2]], axis=1) < np.linalg.norm(p[quads[:, 1]] - p[quads[:, 3]], axis=1)
    return np.vstack([quads[first][:, [0, 1, 2]], quads[first][:, [0, 2, 3]], quads[~first][:, [0, 1, 3]],
                      quads[~first][:, [1, 2, 3]]])


def largest_component(p, triangles):
    label = np.arange(len(p))
    while True:
        lowest = label[triangles].min(axis=1)
        new = label.copy()
        for k in range(3):
            np.minimum.at(new, triangles[:, k], lowest)
        new = new[new]
        if np.array_equal(new, label):
            break
        label = new
    keep = label == np.bincount(label).argmax()
    index = np.cumsum(keep) - 1
    return p[keep], index[triangles[keep[triangles[:, 0]]]]


def write_ply(path, p, triangles, comment):
    rows = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, triangles
    header = (f"ply\nformat binary_little_endian 1.0\ncomment {comment}\nelement vertex {len(p)}\n"
              "property float x\nproperty float y\nproperty float z\n"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(header.encode() + p.astype("<f4").tobytes() + rows.tobytes())


def make_wyrm(folder):
    shape = make_wyrm_shape()
    vertices, quads = surface_net(shape, step=0.0194)
    p = relax(shape, vertices, quads, rounds=12, jitter=0.22, seed=1)
    p, triangles = largest_component(p, triangulate(p, quads))
    # In an order that neighbours share, along the grid; centred over the origin, standing on the ground.
    low, high = p.min(axis=0), p.max(axis=0)
    p = p - [(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2]
    write_ply(folder / "wyrm.ply", p, triangles, "wyrm, made by make_meshes.py of Solidnoise, Apache-2.0; Y is up")
    print(f"wyrm.ply: {len(p)} vertices, {len(triangles)} triangles")


def make_torus(folder, around=72, across=28):
    """A torus of radii 1 and 0.4 about the Y axis, of quadrilaterals."""
    lines = ["# torus of radii 1 and 0.4, made by make_meshes.py of Solidnoise, Apache-2.0; Y is up"]
    for i in range(around):
        for j in range(across):
            a, b = 2 * np.pi * i / around, 2 * np.pi * j / across
            ring = 1 + 0.4 * np.cos(b)
            lines.append(f"v {ring * np.cos(a):.6f} {0.4 * np.sin(b):.6f} {ring * np.sin(a):.6f}")
    for i in range(around):
        for j in range(across):
            corners = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
            lines.append("f " + " ".join(str(1 + (u % around) * across + v % across) for u, v in corners))
    (folder / "torus.obj").write_text("\n".join(lines) + "\n")
    print(f"torus.obj: {around * across} vertices, {around * across} quadrilaterals")


def make_bowl(folder, around=64, up=20):
    """A fluted bowl on a foot about the Y axis, closed, with texture coordinates in two tiles: the outside as two islands
    in the first, the inside and the foot's sole as discs in the second."""
    s = np.linspace(0, 1, up + 1)
    outer = np.stack([0.3 + 0.6 * s**0.7, 0.62 * s**1.5], axis=1)  # radius and height, from the foot to the rim
    inner = np.stack([0.86 * np.cos(s * np.pi / 2), 0.06 + 0.58 * (1 - s) ** 1.9], axis=1)[:-1]  # from the rim down
    angle = 2 * np.pi * np.arange(around) / around

    def ring(radius, height, flute):
        r = radius * (1 + flute * np.cos(12 * angle))
        return np.stack([r * np.cos(angle), np.full(around, height), r * np.sin(angle)], axis=1)

    rings = [ring(r, y, 0.035 * np.sin(np.pi * t)) for (r, y), t in zip(outer, s)] + [ring(r, y, 0) for r, y in inner]
    vertices = np.vstack(rings + [[[0, 0.06, 0]], [[0, 0, 0]]])
    inside_pole, sole_pole = len(vertices) - 1, len(vertices)  # numbers of an .obj, from 1

    def number(row, i):
        return 1 + row * around + i % around

    def along(profile):
        length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
        return length / length[-1]

    def disc(centre, radius, i):
        a = 2 * np.pi * i / around
        return f"vt {centre[0] + radius * np.cos(a):.6f} {centre[1] - radius * np.sin(a):.6f}"

    places, faces = [], []
    for half in range(2):  # of the outside
        first = len(places) + 1
        v = 0.02 + 0.5 * half + 0.46 * along(outer)
        places += [f"vt {0.98 - 0.96 * i / (around // 2):.6f} {v[row]:.6f}" for row in range(up + 1) for i in range(around // 2 + 1)]
        for row in range(up):
            for i in range(around // 2):
                corners = [(row, i), (row + 1, i), (row + 1, i + 1), (row, i + 1)]
                faces.append([(number(j, k + half * around // 2), first + j * (around // 2 + 1) + k) for j, k in corners])
    first = len(places) + 1
    rim = np.vstack([outer[-1:], inner, [[0, 0.06]]])
    radii = 0.48 * (1 - along(rim))
    places += [disc((1.5, 0.5), radii[row], i) for row in range(up + 1) for i in range(around)] + ["vt 1.5 0.5"]
    for row in range(up):
        for i in range(around):
            corners = [(row, i), (row + 1, i), (row + 1, i + 1), (row, i + 1)]
            faces.append([(number(up + j, k), first + j * around + k % around) for j, k in corners])
    faces += [[(number(2 * up, i), first + up * around + i), (inside_pole, first + (up + 1) * around),
               (number(2 * up, i + 1), first + up * around + (i + 1) % around)] for i in range(around)]
    first = len(places) + 1
    places += [disc((1.085, 0.915), -0.08, -i) for i in range(around)] + ["vt 1.085 0.915"]
    faces += [[(number(0, i), first + i), (number(0, i + 1), first + (i + 1) % around), (sole_pole, first + around)]
              for i in range(around)]
    lines = ["# a bowl, made by make_meshes.py of Solidnoise, Apache-2.0; Y is up; texture coordinates in the tiles 1001 and 1002"]
    lines += [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in vertices] + places
    lines += ["f " + " ".join(f"{v}/{t}" for v, t in face) for face in faces]
    (folder / "bowl.obj").write_text("\n".join(lines) + "\n")
    print(f"bowl.obj: {len(vertices)} vertices, {len(faces)} faces")


if __name__ == "__main__":
    target = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    make_wyrm(target)
    make_torus(target)
    make_bowl(target)
