"""What only a window shows: work goes on behind it, can be stopped and undone, Esc ends a sequence, and panels draw themselves."""

import os
import shutil
import sys
import threading

import addon_utils
import bpy

sys.path.insert(0, os.path.dirname(__file__))
from drive import in_view, open_panel, open_redo_panel, press, tell

TEMPORARY = os.path.join(bpy.app.tempdir, "solidnoise")


def made() -> list[str]:
    return os.listdir(TEMPORARY) if os.path.isdir(TEMPORARY) else []


def add(**values):
    with in_view():
        assert bpy.ops.object.solidnoise_volume_add("INVOKE_DEFAULT", True, **values) == {"FINISHED"}
    return bpy.data.objects[bpy.context.view_layer.objects.active.name]


def until_done(worker, most: float = 120, turn=lambda job: None):
    """Lets the window go on until no work is left, with a look at it in each turn."""
    while worker.jobs:
        turn(worker.jobs[0])
        most -= 0.1
        assert most > 0, "the work does not end"
        yield 0.1


def long_work_goes_on_behind_the_window(worker):
    # However fast the machine is: the first that is told of the progress waits until the window has had its turn.
    places, seen, told, turn, tell_fraction = set(), set(), [], threading.Event(), worker.Job.tell

    def wait_once(job, fraction):
        told.append(fraction)
        tell_fraction(job, fraction)
        if 0.0 < fraction < 1.0 and not places:
            places.add(fraction)
            assert turn.wait(timeout=60)

    def look(job):
        seen.add(job.fraction)
        if places & seen:
            turn.set()

    worker.Job.tell = wait_once
    obj = add(preset="explosion", domain_dim=160)
    assert worker.jobs and told[0] == 0.0  # it is the library's work by now
    assert not os.path.exists(obj.data.filepath)  # it is in the scene, its file is not there yet
    yield from until_done(worker, turn=look)
    worker.Job.tell = tell_fraction
    assert places and places <= seen, (places, seen)  # the window had its turns, and the progress to show
    assert sorted(grid.name for grid in obj.data.grids) == ["density", "flame", "temperature", "vel"]


def undone_or_stopped_nothing_is_left_of_it(worker):
    before = made()
    add(preset="explosion", domain_dim=160, noise_seed=1)
    with in_view():
        bpy.ops.ed.undo()
    yield from until_done(worker)
    assert "Explosion.001" not in bpy.data.objects and made() == before
    add(preset="explosion", domain_dim=160, noise_seed=2)
    bpy.ops.wm.solidnoise_stop(subject=worker.jobs[0].subject)
    yield from until_done(worker)
    assert "Explosion.001" not in bpy.data.objects and made() == before


def what_fails_later_is_told_and_leaves_nothing(worker):
    before = len(bpy.data.objects), len(bpy.data.volumes), len(bpy.data.materials)
    path = add(preset="explosion", domain_dim=160, noise_seed=3).data.filepath
    os.makedirs(os.path.join(path, "in the way"))
    yield from until_done(worker)
    yield from press("ESC")  # the message
    assert (len(bpy.data.objects), len(bpy.data.volumes), len(bpy.data.materials)) == before
    shutil.rmtree(path)


def a_bake_comes_when_it_is_ready_and_is_undone_in_a_step(worker):
    with in_view():
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=150, y_subdivisions=150)
        bpy.ops.object.solidnoise_bake("INVOKE_DEFAULT", True, preset="rust")
    assert worker.jobs and "noise" not in bpy.data.objects["Grid"].data.attributes
    yield from until_done(worker)
    assert "noise" in bpy.data.objects["Grid"].data.attributes
    with in_view():
        bpy.ops.ed.undo()
    assert "noise" not in bpy.data.objects["Grid"].data.attributes
    for renames in (True, False):
        with in_view():
            bpy.ops.mesh.primitive_grid_add(x_subdivisions=20, y_subdivisions=20)
            obj = bpy.context.view_layer.objects.active
            bpy.ops.object.solidnoise_bake("INVOKE_DEFAULT", True, preset="raw")
        if renames:
            obj.name = "Renamed"
        else:
            obj.data.vertices.add(1)
        yield from until_done(worker)
        assert ("noise" in obj.data.attributes) == renames and "solidnoise_waits" not in obj
    yield from press("ESC")  # the message that the noise is dropped


def escape_ends_a_sequence(worker):
    obj = add(preset="smoke", domain_dim=48)
    yield from until_done(worker)
    before, name = (made(), obj.data.filepath), obj.name
    for ends in (True, False):
        bpy.context.scene.frame_end = 250 if ends else 3
        with in_view():
            assert bpy.ops.object.solidnoise_sequence("EXEC_DEFAULT", True) == {"RUNNING_MODAL"}
        if ends:
            bpy.data.objects[name].name = name = "Renamed smoke"
        yield 0.5
        if ends:
            yield from press("ESC")
            yield 2
            assert (made(), bpy.data.objects[name].data.filepath) == before
        for _ in range(300):
            if ends or bpy.data.objects[name].data.is_sequence:
                break
            yield 0.1
        assert bpy.data.objects[name].data.is_sequence != ends


def panels_draw_themselves(worker):
    obj = add(preset="cumulus", domain_dim=24)
    yield from until_done(worker)
    yield from open_panel()
    yield from open_redo_panel()
    for settings in (obj.solidnoise_volume, obj.solidnoise_modify):
        settings.advanced = True
    yield 1
    with in_view():
        bpy.ops.object.solidnoise_volume_modify("INVOKE_DEFAULT", True, preset="erode")
    yield from until_done(worker)
    yield 1
    recipe, obj["solidnoise_recipe"] = obj["solidnoise_recipe"], "{"
    yield 0.5
    obj["solidnoise_recipe"] = recipe
    for name in ("Grid", obj.name):
        bpy.context.view_layer.objects.active = bpy.data.objects[name]
        for menu in ("VIEW3D_MT_solidnoise_object", "VIEW3D_MT_solidnoise_volume_add"):
            with in_view():
                bpy.ops.wm.call_menu(name=menu)
            yield 0.5
            yield from press("ESC")


def what_is_at_work_as_the_file_is_saved_arrives_beside_it(worker):
    obj = add(preset="explosion", domain_dim=160, noise_seed=5)
    os.makedirs(os.path.join(bpy.app.tempdir, "saved"))
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(bpy.app.tempdir, "saved", "scene.blend"))
    yield from until_done(worker)
    assert obj.data.filepath.startswith("//solidnoise/") and os.path.exists(bpy.path.abspath(obj.data.filepath))
    assert obj.data.grids.load() and len(obj.data.grids) == 4


def story():
    yield 1
    addon_utils.enable("solidnoise_blender", default_set=True)
    from solidnoise_blender import worker
    worker.PATIENCE = 0.0  # so that all work goes on behind the window
    for part in (long_work_goes_on_behind_the_window, undone_or_stopped_nothing_is_left_of_it, what_fails_later_is_told_and_leaves_nothing,
                 a_bake_comes_when_it_is_ready_and_is_undone_in_a_step, escape_ends_a_sequence, panels_draw_themselves,
                 what_is_at_work_as_the_file_is_saved_arrives_beside_it):
        yield from part(worker)
        print(f"{part.__name__}: yes")


tell(story())
