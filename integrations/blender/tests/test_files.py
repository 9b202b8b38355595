"""Where volumes are: in the temporary folder, beside the .blend once that is saved, and made again where they are missing."""

import json
import os
import shutil

import bpy
import pytest
from solidnoise_blender import volumes, worker


def save(path) -> None:
    os.makedirs(path.parent, exist_ok=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))


def step() -> None:
    """Something of the user's that can be undone."""
    bpy.context.scene.frame_current += 1
    bpy.ops.ed.undo_push(message="step")


def is_shown(name: str) -> bool:
    return bpy.data.objects[name].data.grids.load() and len(bpy.data.objects[name].data.grids) > 0


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


def test_what_was_saved_stays_whatever_is_undone(tmp_path, add) -> None:
    add(preset="smoke")
    bpy.context.scene.frame_end = 2
    bpy.ops.object.solidnoise_sequence("EXEC_DEFAULT", True)
    add(preset="raw")
    save(tmp_path / "scene.blend")
    there = sorted(path for path in (tmp_path / "solidnoise").rglob("*"))
    step()
    bpy.ops.ed.undo()
    assert bpy.data.objects["Raw"].data.filepath.startswith("//solidnoise/raw-") and is_shown("Raw")
    for _ in range(2):
        bpy.ops.ed.undo()
    assert not bpy.data.objects["Smoke"].data.is_sequence and "Raw" not in bpy.data.objects
    assert set(there) <= set((tmp_path / "solidnoise").rglob("*"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    assert bpy.data.objects["Smoke"].data.is_sequence and is_shown("Raw")


def test_what_a_version_before_shows_stays(tmp_path, add) -> None:
    obj = add(preset="smoke")
    save(tmp_path / "v1.blend")
    first = bpy.path.abspath(obj.data.filepath)
    save(tmp_path / "v2.blend")
    obj.solidnoise_volume.noise_seed = 8
    bpy.ops.object.solidnoise_volume_remake("EXEC_DEFAULT", True)
    assert os.path.exists(first)
    second = bpy.path.abspath(obj.data.filepath)
    obj.solidnoise_volume.noise_seed = 9
    bpy.ops.object.solidnoise_volume_remake("EXEC_DEFAULT", True)
    assert not os.path.exists(second)  # which no .blend shows


def test_work_ends_with_the_file_that_it_is_for(tmp_path) -> None:
    begun = []

    def work(tell) -> None:
        while True:
            begun.append(tell(0.5))

    save(tmp_path / "scene.blend")
    job = worker.Job(str(tmp_path), work, failed=begun.clear)
    worker.go_on(job)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    assert job.is_over() and not worker.jobs and begun


def test_a_missing_file_of_another_kind_is_not_made_up(tmp_path, add) -> None:
    obj = add(preset="raw")
    obj.data.filepath = str(tmp_path / "simulation_0001.vdb")
    save(tmp_path / "scene.blend")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    assert not (tmp_path / "simulation_0001.vdb").exists()


def test_what_cannot_be_made_again_is_told_and_the_rest_is(tmp_path, add, capfd) -> None:
    names = [add(preset="raw").name for _ in range(3)]
    bpy.data.objects[names[0]]["solidnoise_recipe"] = "{broken"
    bpy.data.objects[names[1]].data.filepath = "//solidnoise/raw-0123456789ab.vdb"
    smoke = add(preset="smoke")
    bpy.context.view_layer.update()
    bpy.ops.object.solidnoise_volume_modify(preset="erode", noise_frequency=4)
    smoke.name = "Worn"
    save(tmp_path / "scene.blend")
    shutil.rmtree(tmp_path / "solidnoise")
    capfd.readouterr()
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    told = capfd.readouterr().out
    assert "Raw: its custom property solidnoise_recipe is no recipe any more" in told
    assert "Worn: //solidnoise/smoke-" in told and "is missing, and what was modified is not made again by itself" in told
    assert is_shown("Raw.001") and is_shown("Raw.002")


def test_the_backup_is_of_what_was_overwritten(tmp_path, add) -> None:
    bpy.context.scene.name = "Precious"
    save(tmp_path / "scene.blend")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    add(preset="raw")
    save(tmp_path / "scene.blend")
    assert bpy.context.preferences.filepaths.save_version == 1
    with bpy.data.libraries.load(str(tmp_path / "scene.blend1")) as (there, _):
        assert there.scenes == ["Precious"]


def test_a_copy_of_what_was_never_saved_says_so_and_makes_its_volumes_again(tmp_path, add, capfd) -> None:
    path = bpy.path.abspath(add(preset="raw").data.filepath)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "copy.blend"), copy=True)
    assert "the copy has no volumes with it" in capfd.readouterr().out
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    os.remove(path)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "copy.blend"))
    assert bpy.data.objects["Raw"].data.filepath.startswith("//solidnoise/raw-") and is_shown("Raw")


def test_the_bin_has_what_all_steps_to_undo_need(tmp_path, add) -> None:
    bpy.context.preferences.edit.undo_steps = 24
    add(preset="raw", domain_dim=8)
    for seed in range(22):
        bpy.data.objects["Raw"].solidnoise_volume.noise_seed = seed + 100
        bpy.ops.object.solidnoise_volume_remake("EXEC_DEFAULT", True)
    made, again = volumes.making, []
    volumes.making = lambda recipe, path: again.append(path) or made(recipe, path)
    for _ in range(22):
        bpy.ops.ed.undo()
        assert is_shown("Raw")
    volumes.making = made
    assert not again


def test_deleted_and_saved_it_leaves_no_file(tmp_path, add) -> None:
    save(tmp_path / "scene.blend")
    obj = add(preset="raw")
    bpy.data.objects.remove(obj)
    save(tmp_path / "scene.blend")
    assert not (tmp_path / "solidnoise").exists()


def test_the_recipe_of_what_is_modified_names_the_file_where_it_is(tmp_path, add) -> None:
    obj = add(preset="smoke")
    bpy.context.view_layer.update()
    bpy.ops.object.solidnoise_volume_modify(preset="erode", noise_frequency=4)
    save(tmp_path / "scene.blend")
    source = json.loads(obj["solidnoise_recipe"])["on"]["file"]
    assert source == bpy.path.abspath(obj.data["solidnoise_sources"]) and os.path.exists(source)


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
