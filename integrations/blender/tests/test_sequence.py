"""Object > Solidnoise > Sequence: a file for each frame of the scene, shown as a sequence."""

import json
import os
from pathlib import Path

import bpy
import numpy as np
import pytest
import solidnoise
from solidnoise_blender import sequence, waits, worker

FRAMES = range(11, 15)


@pytest.fixture
def smoke(add):
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = FRAMES[0], FRAMES[-1], 2
    return add(preset="smoke", domain_dim=24)


def folder_of(obj) -> Path:
    return Path(bpy.path.abspath(obj.data.filepath)).parent


def density(path) -> np.ndarray:
    return solidnoise.read_volume(path).to_numpy("density")


def test_every_frame_is_the_recipes_moment_at_one_scale(smoke) -> None:
    recipe = json.loads(smoke["solidnoise_recipe"])
    assert bpy.ops.object.solidnoise_sequence(evolve=0.4, loops=False) == {"FINISHED"}
    assert sorted(os.listdir(folder_of(smoke))) == [f"frame.{frame:04d}.vdb" for frame in FRAMES]
    recipe["noise"]["evolve"] = 0.4
    first = solidnoise.make_volume(recipe)
    factor = first.grids["density"].metadata["solidnoise:density_factor"]
    recipe["grids"][0]["scale"]["factor"] = factor
    for place, frame in enumerate(FRAMES):
        expected = solidnoise.make_volume(recipe, time=place / 2)
        np.testing.assert_array_equal(density(folder_of(smoke) / f"frame.{frame:04d}.vdb"), expected.to_numpy("density"))


@pytest.mark.parametrize("loops, after", [(True, 11), (False, 14)])
def test_blender_shows_the_frame_of_the_scene(loops: bool, after: int, smoke) -> None:
    bpy.ops.object.solidnoise_sequence(loops=loops)
    for frame, shown in ((11, 11), (12, 12), (14, 14), (15, after)):
        bpy.context.scene.frame_set(frame)
        volume = smoke.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        volume.grids.load()
        assert os.path.basename(volume.grids.frame_filepath) == f"frame.{shown:04d}.vdb"
        assert [grid.name for grid in volume.grids] == ["density"]


@pytest.mark.parametrize("changed", ["{", "[1]", 7])
def test_what_is_no_recipe_any_more_is_refused(changed, smoke) -> None:
    smoke["solidnoise_recipe"] = changed
    with pytest.raises(RuntimeError, match="Error: its custom property solidnoise_recipe is no recipe any more"):
        bpy.ops.object.solidnoise_sequence()
    assert not smoke.data.is_sequence


def test_a_recipe_of_few_words_will_do(smoke) -> None:
    smoke["solidnoise_recipe"] = json.dumps({"dim": 16, "noise": {"type": "gabor", "frequency": 2}, "shaping": {"type": "cloud"}})
    assert bpy.ops.object.solidnoise_sequence(loops=False) == {"FINISHED"}
    volumes = [solidnoise.read_volume(folder_of(smoke) / f"frame.{frame:04d}.vdb") for frame in FRAMES]
    assert len({volume.grids["density"].metadata["solidnoise:density_factor"] for volume in volumes}) == 1


def test_a_loop_ends_where_it_began(smoke) -> None:
    bpy.ops.object.solidnoise_sequence(loops=True)
    recipe = json.loads(smoke["solidnoise_recipe"])
    assert recipe["noise"]["loop"] == len(FRAMES) / 2
    files = [density(folder_of(smoke) / f"frame.{frame:04d}.vdb") for frame in FRAMES]
    again = solidnoise.make_volume(recipe, time=len(FRAMES) / 2)
    np.testing.assert_array_equal(again.to_numpy("density"), files[0])
    assert not np.array_equal(files[0], files[1])


def test_it_is_of_the_objects_own_recipe_and_a_linked_duplicate_stays(smoke) -> None:
    other = smoke.copy()
    bpy.context.scene.collection.objects.link(other)
    recipe = json.loads(smoke["solidnoise_recipe"])
    smoke.solidnoise_volume.noise_seed = 99  # and not remade
    bpy.ops.object.solidnoise_sequence(evolve=0.4)
    assert json.loads(smoke["solidnoise_recipe"])["noise"]["seed"] == recipe["noise"]["seed"]
    assert smoke.data.is_sequence and not other.data.is_sequence and "solidnoise_waits" not in smoke


def test_a_volume_renamed_meanwhile_is_found_and_nothing_waits_after_opening(smoke, tmp_path) -> None:
    token = waits.mark(smoke, object())
    smoke.name = "Renamed"
    assert waits.found(token) == [smoke]
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    assert not waits.found(token)


def test_undo_brings_back_the_volume_and_takes_the_files_along(smoke) -> None:
    single = smoke.data.filepath
    bpy.ops.object.solidnoise_sequence("EXEC_DEFAULT", True)
    folder = folder_of(smoke)
    bpy.ops.ed.undo()
    smoke = bpy.data.objects["Smoke"]
    assert (smoke.data.filepath, smoke.data.is_sequence) == (single, False)
    assert smoke.data.grids.load() and not folder.exists()
    bpy.ops.ed.redo()
    assert bpy.data.objects["Smoke"].data.is_sequence and len(os.listdir(folder)) == len(FRAMES)


def test_saved_and_opened_again_it_is_a_sequence_and_can_be_a_single_volume(smoke, tmp_path, capfd) -> None:
    bpy.ops.object.solidnoise_sequence()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    smoke = bpy.data.objects["Smoke"]
    assert smoke.data.filepath.startswith("//solidnoise/smoke-") and len(os.listdir(folder_of(smoke))) == len(FRAMES)
    bpy.context.view_layer.objects.active = smoke
    bpy.ops.object.solidnoise_volume_remake()
    assert not smoke.data.is_sequence and smoke.data.grids.load()
    assert "Smoke is a single volume again" in capfd.readouterr().out


def test_one_that_is_there_stays_where_making_it_again_is_stopped(smoke) -> None:
    bpy.ops.object.solidnoise_sequence()
    folder = folder_of(smoke)
    before = {path: path.read_bytes() for path in folder.iterdir()}

    def stop(fraction: float) -> None:
        if fraction > 0.5:
            raise worker.Stopped

    work = sequence.making(sequence.moments(json.loads(smoke["solidnoise_recipe"])), str(folder), FRAMES, 2)
    with pytest.raises(worker.Stopped):
        work(stop)
    assert {path: path.read_bytes() for path in folder.iterdir()} == before
    assert [path for path in folder.parent.iterdir() if path.name.startswith(folder.name)] == [folder]
    values = {path: density(path) for path in before}
    work(lambda fraction: None)
    assert set(folder.iterdir()) == set(before)
    for path in before:
        np.testing.assert_array_equal(density(path), values[path])


def test_a_job_that_fails_as_it_ends_leaves_the_others_to_go_on() -> None:
    def fail(_) -> None:
        raise KeyError("gone")

    ended = []
    for done in (fail, ended.append):
        job = worker.Job(str(done), lambda tell: 7, done=done)
        job.is_over(None)
        worker.go_on(job)
    assert worker._attend() is None and ended == [7]


def test_what_cannot_be_is_refused_and_leaves_nothing(smoke) -> None:
    smoke.solidnoise_volume.noise_type = "kensler"  # which does not turn on the spot
    bpy.ops.object.solidnoise_volume_remake()
    there = sorted(os.listdir(os.path.join(bpy.app.tempdir, "solidnoise")))
    before = smoke.data.filepath

    def refused(message: str) -> None:
        with pytest.raises(RuntimeError, match=f"Error: {message}"):
            bpy.ops.object.solidnoise_sequence()
        assert smoke.data.filepath == before and not smoke.data.is_sequence
        assert sorted(os.listdir(os.path.join(bpy.app.tempdir, "solidnoise"))) == there

    refused("noise.evolve is unknown")
    bpy.ops.object.volume_add()
    refused("Volume has no recipe of its own")
