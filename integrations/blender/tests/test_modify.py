"""Object > Solidnoise on a volume: erode, detail, mask by a mesh; again from what it was; undo; what is refused."""

import json
import os
import shutil

import bpy
import numpy as np
import pytest
import solidnoise
from solidnoise_blender import masks, recipes
from solidnoise_blender.clip import clipped


def grid_of(obj, name: str = "density", bounds=None) -> np.ndarray:
    return solidnoise.read_volume(bpy.path.abspath(obj.data.filepath)).grids[name].to_numpy(bounds)


@pytest.fixture
def smoke(add):
    obj = add(preset="smoke", domain_dim=40)
    bpy.context.view_layer.update()
    return obj


@pytest.mark.parametrize("name", ["erode", "detail"])
def test_it_is_what_the_librarys_recipe_makes_of_the_file(name: str, smoke) -> None:
    source = bpy.path.abspath(smoke.data.filepath)
    before = grid_of(smoke)
    assert bpy.ops.object.solidnoise_volume_modify(preset=name, noise_frequency=4) == {"FINISHED"}
    recipe = recipes.preset(recipes.MODIFY, name)
    expected = solidnoise.make_volume({**recipe, "noise": {**recipe["noise"], "frequency": 4}}, on={"file": source})
    np.testing.assert_array_equal(grid_of(smoke), expected.to_numpy("density"))
    assert not np.array_equal(grid_of(smoke), before)
    assert os.path.exists(source)  # it can be modified again from what it was
    assert [grid.name for grid in smoke.data.grids] == ["density"]


def test_a_mesh_limits_the_change(smoke) -> None:
    before = grid_of(smoke)
    bounds = solidnoise.read_volume(bpy.path.abspath(smoke.data.filepath)).grids["density"].bounds
    bpy.ops.mesh.primitive_cube_add(size=10, location=(5, 0, 0))  # x > 0
    bpy.context.view_layer.objects.active = smoke
    bpy.ops.object.solidnoise_volume_modify(preset="erode", mask="Cube")
    after = grid_of(smoke, bounds=bounds)
    zero = -bounds[0][0]  # the index of x = 0; the mask ends over two voxels
    np.testing.assert_array_equal(after[:zero - 2], before[:zero - 2])
    assert (after[zero + 2:] < before[zero + 2:]).mean() > 0.3
    bpy.ops.object.solidnoise_volume_modify_again()
    np.testing.assert_array_equal(grid_of(smoke, bounds=bounds), after)


@pytest.mark.parametrize("outside", [False, True])
def test_a_mesh_cuts_all_grids(outside: bool, add) -> None:
    fire = add(preset="fire", domain_dim=40)
    bpy.context.view_layer.update()
    volume = solidnoise.read_volume(bpy.path.abspath(fire.data.filepath))
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, 5.5))
    bpy.context.object.scale = (10, 10, 10)  # what is over z = 0.5 of the scene, which is y of the file
    bpy.context.view_layer.update()
    bpy.context.view_layer.objects.active = fire
    bpy.ops.object.solidnoise_volume_modify(preset="mask", mask="Cube", outside=outside)
    for name in ("density", "temperature"):
        grid = volume.grids[name]
        before, after = grid.to_numpy(), grid_of(fire, name, grid.bounds)
        height = round(0.5 / grid.voxel_size[1]) - grid.bounds[0][1]
        kept, cut = (slice(None, height - 2), slice(height + 3, None)) if outside else (slice(height + 3, None), slice(None, height - 2))
        np.testing.assert_array_equal(after[:, kept], before[:, kept])
        assert before[:, cut].max() > 0 and after[:, cut].max() == 0


def shown(path: str):
    """An object that shows a file."""
    obj = bpy.data.objects.new("Shown", bpy.data.volumes.new("Shown"))
    obj.data.filepath = path
    obj.data.grids.load()
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    bpy.context.view_layer.update()
    return obj


def write(path, **keys) -> str:
    solidnoise.make_volume({"noise": {"type": "gabor", "frequency": 1}, "shaping": {"type": "raw"}, **keys}).write(path)
    return str(path)


@pytest.mark.parametrize("values, frequency", [({}, 0.35), ({"preset": "erode"}, 0.35), ({"preset": "detail"}, 0.5),
                                               ({"preset": "erode", "noise_frequency": 4}, 4)])
def test_frequencies_suit_the_volumes_size_unless_they_are_set(values: dict, frequency: float, tmp_path) -> None:
    obj = shown(write(tmp_path / "raw.vdb", box=[-10, -10, -10, 10, 10, 10], dim=16))  # 20 units wide, whose leaves are all full
    bpy.ops.object.solidnoise_volume_modify(**values)
    assert json.loads(obj["solidnoise_recipe"])["noise"]["frequency"] == pytest.approx(frequency, rel=0.1)


def test_the_density_is_changed_and_said_to_be_where_it_is_not_the_first(tmp_path, capfd) -> None:
    recipe = {"noise": {"type": "gabor", "frequency": 1}, "dim": 16,
              "grids": [{"name": name, "shaping": {"type": "raw"}} for name in ("a", "density")]}
    solidnoise.make_volume(recipe).write(tmp_path / "two.vdb")
    before = solidnoise.read_volume(tmp_path / "two.vdb")
    obj = shown(str(tmp_path / "two.vdb"))
    bpy.ops.object.solidnoise_volume_modify(preset="detail")
    assert "the grid density of Shown is changed" in capfd.readouterr().out
    np.testing.assert_array_equal(grid_of(obj, "a"), before.to_numpy("a"))
    assert not np.array_equal(grid_of(obj), before.to_numpy("density"))
    assert json.loads(obj["solidnoise_recipe"])["on"]["grid"] == "density"


def test_a_linked_duplicate_stays_as_it_is(smoke) -> None:
    other = smoke.copy()
    bpy.context.scene.collection.objects.link(other)
    before = other.data.filepath
    bpy.ops.object.solidnoise_volume_modify(preset="erode", noise_frequency=4)
    assert other.data.filepath == before != smoke.data.filepath and "solidnoise_sources" not in other.data


@pytest.mark.parametrize("matrix", [[[0.8, 0.6, 0], [-0.6, 0.8, 0], [0, 0, 1]], [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]])
@pytest.mark.parametrize("outside", [False, True])
def test_a_rotated_or_mirrored_grid_is_cut_where_the_mesh_is(outside: bool, matrix, tmp_path) -> None:
    vdb = pytest.importorskip("pyopenvdb")
    grid = vdb.FloatGrid()
    grid.name = "density"
    grid.copyFromArray(np.ones((24, 24, 24), np.float32))
    axes = np.eye(4)
    axes[:3, :3] = np.array(matrix) / 24
    grid.transform = vdb.createLinearTransform(axes.tolist())
    vdb.write(str(tmp_path / "turned.vdb"), grids=[grid])
    obj = shown(str(tmp_path / "turned.vdb"))
    center = np.array([12, 4, 12]) @ axes[:3, :3]  # of a row of voxels
    bpy.ops.mesh.primitive_cube_add(size=0.25, location=center)
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.solidnoise_volume_modify(preset="mask", mask="Cube", outside=outside)
    kept = vdb.read(bpy.path.abspath(obj.data.filepath), "density").getConstAccessor()
    assert [kept.getValue((12, y, 12)) for y in (4, 14)] == ([0, 1] if outside else [1, 0])


def test_a_mesh_far_larger_than_the_volume_cuts_it_as_one_of_its_size(smoke) -> None:
    after = []
    for size in (6, 300):  # which would be 6000^3 voxels of the volume's
        bpy.ops.mesh.primitive_cube_add(size=size, location=(size / 2, 0, 0))
        bpy.context.object.name = f"Cube of {size}"
        bpy.context.view_layer.objects.active = smoke
        (bpy.ops.object.solidnoise_volume_modify_again if after else bpy.ops.object.solidnoise_volume_modify)(
            **({} if after else {"preset": "mask", "mask": "Cube of 6"}))
        smoke.solidnoise_modify.mask = "Cube of 300"
        after.append(grid_of(smoke))
    np.testing.assert_array_equal(*after)


def test_what_is_clipped_of_a_mesh_is_closed_and_has_its_holes(tmp_path) -> None:
    bpy.ops.mesh.primitive_torus_add(major_segments=24, minor_segments=12)
    mesh = masks.surface(bpy.context, bpy.context.object, bpy.context.object)
    counts = []
    for corner in ((9, 9, 9), (9, 9, 0), (9, 0, 9), (9, 1e-3, 9)):  # all of it, a ring, two circles, through vertices and beside them
        part = masks.Mask("", "", *clipped(*mesh, np.full(3, -9), np.array(corner), 0.0), feather=0, is_inside=True, must_touch=True, matrices={})
        folder = tmp_path / str(len(counts))
        folder.mkdir()
        counts.append((solidnoise.read_volume(part._inside(folder, part.vertices, part.faces, 0.025)).to_numpy("density") > 0.5).sum())
    assert counts[1:] == pytest.approx([counts[0] / 2] * 3, rel=0.08)  # a layer of voxels is in a cut


@pytest.mark.parametrize("size", [1, 8])
def test_a_feather_is_as_wide_as_it_says_in_the_scene(size: float, add) -> None:
    obj = add(preset="raw", domain_dim=48, size=size)
    bpy.context.view_layer.update()
    before = np.abs(grid_of(obj)).sum((1, 2))
    bpy.ops.mesh.primitive_cube_add(size=size * 2, location=(size, 0, 0))
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.solidnoise_volume_modify(preset="mask", mask="Cube", feather=size / 4)
    part = np.abs(grid_of(obj)).sum((1, 2)) / before
    assert ((part > 0.01) & (part < 0.99)).sum() == pytest.approx(48 / 4, abs=3)




def test_undo_brings_back_what_was_and_redo_what_became_of_it(smoke) -> None:
    first = smoke.data.filepath
    bpy.ops.object.solidnoise_volume_modify("EXEC_DEFAULT", True, preset="erode")
    second = smoke.data.filepath
    bpy.ops.ed.undo()
    smoke = bpy.data.objects["Smoke"]
    assert smoke.data.filepath == first and smoke.data.grids.load() and not os.path.exists(second)
    bpy.ops.ed.redo()
    smoke = bpy.data.objects["Smoke"]
    assert smoke.data.filepath == second and smoke.data.grids.load()


def test_saved_and_opened_again_it_is_modified_from_what_it_was(smoke, tmp_path) -> None:
    bpy.ops.object.solidnoise_volume_modify(preset="erode", noise_seed=9)
    bpy.ops.object.solidnoise_volume_modify(preset="detail")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    smoke = bpy.data.objects["Smoke"]
    after = grid_of(smoke)
    sources = smoke.data["solidnoise_sources"].split("\n")
    assert len(sources) == 2 and all(source.startswith("//solidnoise/") for source in sources)
    bpy.context.view_layer.objects.active = smoke
    settings = smoke.solidnoise_modify
    assert settings.preset == "detail"
    settings.modify_amount = 0.1
    bpy.ops.object.solidnoise_volume_modify_again()
    assert smoke.data["solidnoise_sources"].split("\n") == sources
    settings.modify_amount = 0.9
    bpy.ops.object.solidnoise_volume_modify_again()
    np.testing.assert_array_equal(grid_of(smoke), after)


def test_all_frames_of_a_sequence_are_modified(smoke) -> None:
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = 9, 11, 2
    bpy.ops.object.solidnoise_sequence(loops=False)
    folder = os.path.dirname(bpy.path.abspath(smoke.data.filepath))
    bpy.ops.ed.undo_push(message="sequence")
    bpy.ops.object.solidnoise_volume_modify("EXEC_DEFAULT", True, preset="erode", noise_frequency=4, noise_evolve=0.5)
    recipe = recipes.preset(recipes.MODIFY, "erode")
    recipe = {**recipe, "noise": {**recipe["noise"], "frequency": 4, "evolve": 0.5}}
    assert smoke.data.is_sequence and (smoke.data.frame_start, smoke.data.frame_duration) == (9, 3)
    for place, frame in enumerate((9, 10, 11)):
        name = f"frame.{frame:04d}.vdb"
        made = os.path.join(os.path.dirname(bpy.path.abspath(smoke.data.filepath)), name)
        assert made != os.path.join(folder, name)
        expected = solidnoise.make_volume(recipe, on={"file": os.path.join(folder, name)}, time=place / 2)
        np.testing.assert_array_equal(solidnoise.read_volume(made).to_numpy("density"), expected.to_numpy("density"))
        scene.frame_set(frame)
        shown = smoke.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        assert shown.grids.load() and os.path.normpath(shown.grids.frame_filepath) == made
    smoke.solidnoise_modify.modify_amount = 1.0
    bpy.ops.object.solidnoise_volume_modify_again()  # from what it was
    assert smoke.data["solidnoise_sources"] == os.path.join(folder, "frame.0009.vdb") and smoke.data.is_sequence
    bpy.ops.ed.undo()  # and what was made again after its step
    smoke = bpy.data.objects["Smoke"]
    assert os.path.dirname(bpy.path.abspath(smoke.data.filepath)) == folder and len(os.listdir(folder)) == 3


@pytest.mark.parametrize("outside", [False, True])
def test_frames_that_are_empty_or_out_of_the_mask_go_with_the_others(outside: bool, tmp_path) -> None:
    empty = {"shape": {"type": "sphere"}, "layers": [{"weight": 0, "bias": 0}], "sparse": True}
    for frame, keys in ((1, {}), (2, {"box": [8, 8, 8, 10, 10, 10]}), (3, empty)):
        write(tmp_path / f"sim_{frame:04d}.vdb", dim=8, **keys)
    obj = shown(str(tmp_path / "sim_0001.vdb"))
    obj.data.is_sequence, obj.data.frame_duration = True, 3
    bpy.ops.mesh.primitive_cube_add(size=2, location=(1, 0, 0))
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.solidnoise_volume_modify(preset="mask", mask="Cube", outside=outside)
    folder = os.path.dirname(bpy.path.abspath(obj.data.filepath))
    parts = []
    for frame in (1, 2, 3):
        after, before = (solidnoise.read_volume(os.path.join(path, f"{name}{frame:04d}.vdb")).grids["density"] for path, name in (
            (folder, "frame."), (tmp_path, "sim_")))
        parts.append(np.abs(after.to_numpy(before.bounds)).sum() / np.abs(before.to_numpy()).sum() if before.bounds else after.active_voxels)
    assert 0.2 < parts[0] < 0.8 and parts[1:] == [int(outside), 0]


def test_what_cannot_be_is_refused_and_changes_nothing(smoke, blocks, tmp_path) -> None:
    modify = bpy.ops.object.solidnoise_volume_modify
    bpy.ops.mesh.primitive_plane_add(location=(0, 0, 1))
    bpy.context.object.name = "Open"
    empty = bpy.data.objects.new("Empty", bpy.data.meshes.new("Empty"))
    bpy.context.scene.collection.objects.link(empty)
    bpy.context.view_layer.objects.active = smoke
    before, path, there = blocks(), smoke.data.filepath, os.listdir(os.path.join(bpy.app.tempdir, "solidnoise"))
    bpy.ops.mesh.primitive_cube_add(location=(9, 0, 0))
    bpy.context.object.name = "Far"
    bpy.context.view_layer.objects.active = smoke
    before = blocks()
    for values, message in (({"mask": "Far"}, "Far does not touch Smoke"), ({"preset": "mask"}, "no mask is chosen"),
                            ({"mask": "nothing"}, "mask is nothing; it must be a mesh of the scene"),
                            ({"mask": "Empty"}, "Empty: the mesh has no vertices"), ({"mask": "Open"}, ".*closed")):
        with pytest.raises(RuntimeError, match=f"Error: {message}"):
            modify(**values)
        assert (blocks(), smoke.data.filepath) == (before, path) and "solidnoise_sources" not in smoke.data
    assert os.listdir(os.path.join(bpy.app.tempdir, "solidnoise")) == there
    with pytest.raises(RuntimeError, match="Smoke is not modified"):
        bpy.ops.object.solidnoise_volume_modify_again()
    for file, message in ((write(tmp_path / "velocity.vdb", output="curl", dim=8), "velocity.vdb has no grid of floats"),
                          (write(tmp_path / "empty.vdb", dim=8, shape={"type": "sphere"}, layers=[{"weight": 0, "bias": 0}], sparse=True),
                           "empty.vdb has no active voxels to change")):
        shown(file)
        with pytest.raises(RuntimeError, match=f"Error: {message}"):
            modify(preset="mask", mask="Far")
    bpy.context.view_layer.objects.active = smoke
    smoke.data.filepath = ""
    with pytest.raises(RuntimeError, match="Smoke has no file; it must be a volume of a .vdb"):
        modify()
    still = shutil.copy(path, tmp_path / "still.vdb")  # a name without digits, which would be a frame's
    smoke.data.filepath, smoke.data.is_sequence, smoke.data.frame_duration = str(still), True, 3
    with pytest.raises(RuntimeError, match="Smoke has no files of frames 1 to 3"):
        modify()
