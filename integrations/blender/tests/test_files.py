"""Where volumes are: in the temporary folder, beside the .blend once that is saved, and made again where they are missing."""

import json
import os

import bpy
import pytest


def test_volumes_move_beside_the_blend_when_it_is_saved(tmp_path, add) -> None:
    obj = add(preset="smoke")
    in_temporary = bpy.path.abspath(obj.data.filepath)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    assert obj.data.filepath.startswith("//solidnoise/smoke-")
    assert os.listdir(tmp_path / "solidnoise") == [os.path.basename(in_temporary)]
    assert not os.path.exists(in_temporary)
    later = add(preset="raw")
    assert later.data.filepath.startswith("//solidnoise/raw-")


def test_what_is_opened_again_is_shown_and_can_be_changed(tmp_path, add) -> None:
    add(preset="smoke", noise_seed=5)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    obj = bpy.data.objects["Smoke"]
    assert obj.data.grids.load() and [grid.name for grid in obj.data.grids] == ["density"]
    assert (obj.solidnoise_volume.preset, obj.solidnoise_volume.noise_seed, obj.solidnoise_volume.domain_dim) == ("smoke", 5, 24)
    obj.solidnoise_volume.noise_seed = 6
    obj.name = "../Of many: words"
    bpy.context.view_layer.objects.active = obj
    before = obj.data.filepath
    bpy.ops.ed.undo_push(message="opened")
    assert bpy.ops.object.solidnoise_volume_remake("EXEC_DEFAULT", True) == {"FINISHED"}
    assert json.loads(obj["solidnoise_recipe"])["noise"]["seed"] == 6
    assert obj.data.filepath.startswith("//solidnoise/_") and obj.data.grids.load()
    bpy.ops.ed.undo()
    assert bpy.data.objects["../Of many: words"].data.filepath == before


def test_a_missing_file_is_made_again_from_the_recipe(tmp_path, add) -> None:
    add(preset="raw")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    path = bpy.path.abspath(bpy.context.object.data.filepath)
    with open(path, "rb") as file:
        before = file.read()
    os.remove(path)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    with open(path, "rb") as file:
        assert file.read() == before


def test_a_preset_chosen_in_the_panel_brings_its_values(add) -> None:
    settings = add(preset="smoke", noise_seed=5).solidnoise_volume
    settings.preset = "fire"
    assert (settings.noise_seed, round(settings.scale_optical_depth, 5), settings.domain_dim) == (3, 2.5, 256)


def test_what_was_not_made_here_is_not_remade() -> None:
    bpy.ops.object.volume_add()
    with pytest.raises(RuntimeError, match="Volume has no recipe; it was not made here"):
        bpy.ops.object.solidnoise_volume_remake()
    bpy.ops.mesh.primitive_cube_add()
    with pytest.raises(RuntimeError, match="the active object is mesh; it must be a volume"):
        bpy.ops.object.solidnoise_volume_remake()
