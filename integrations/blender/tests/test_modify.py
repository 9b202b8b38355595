"""Object > Solidnoise on a volume: erode, detail, mask by a mesh; again from what it was; undo; what is refused."""

import json
import os

import bpy
import numpy as np
import pytest
import solidnoise
from solidnoise_blender import recipes


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


def test_frequencies_suit_the_volumes_size(add) -> None:
    add(preset="raw", domain_dim=16)  # 2 units wide, whose leaves are all full
    bpy.context.view_layer.update()
    bpy.ops.object.solidnoise_volume_modify(preset="detail")
    assert json.loads(bpy.context.object["solidnoise_recipe"])["noise"]["frequency"] == pytest.approx(5, rel=0.1)


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


def test_what_cannot_be_is_refused_and_changes_nothing(smoke, blocks) -> None:
    modify = bpy.ops.object.solidnoise_volume_modify
    bpy.ops.mesh.primitive_plane_add()
    bpy.context.object.name = "Open"
    empty = bpy.data.objects.new("Empty", bpy.data.meshes.new("Empty"))
    bpy.context.scene.collection.objects.link(empty)
    bpy.context.view_layer.objects.active = smoke
    before, path, there = blocks(), smoke.data.filepath, os.listdir(os.path.join(bpy.app.tempdir, "solidnoise"))
    for values, message in (({"preset": "mask"}, "no mask is chosen"), ({"mask": "nothing"}, "mask is nothing; it must be a mesh of the scene"),
                            ({"mask": "Empty"}, "Empty: the mesh has no vertices"), ({"mask": "Open"}, ".*closed")):
        with pytest.raises(RuntimeError, match=f"Error: {message}"):
            modify(**values)
        assert (blocks(), smoke.data.filepath) == (before, path) and "solidnoise_sources" not in smoke.data
    assert os.listdir(os.path.join(bpy.app.tempdir, "solidnoise")) == there
    with pytest.raises(RuntimeError, match="Smoke is not modified"):
        bpy.ops.object.solidnoise_volume_modify_again()
    smoke.data.filepath = ""
    with pytest.raises(RuntimeError, match="Smoke has no file; it must be a volume of a .vdb"):
        modify()
    smoke.data.filepath, smoke.data.is_sequence, smoke.data.frame_duration = path, True, 3
    with pytest.raises(RuntimeError, match="Smoke has no files of frames 1 to 3"):
        modify()
