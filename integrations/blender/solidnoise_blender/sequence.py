"""Object > Solidnoise > Sequence: a volume that moves, a file for each of the scene's frames."""

import json
import os
import shutil
from typing import Callable, Sequence

import bpy
import solidnoise

from . import files, memory, recipes, volumes, waits, worker
from .errors import Refused, reported, require_object
from .fields import plain

_jobs: list[worker.Job] = []  # of sequences that are being made
_table = solidnoise.schema("volume")["$defs"]["noise"]["oneOf"][0]["properties"]


def moving(recipe, evolve: float, loop: float):
    """The recipe with all of its noises turning on the spot."""
    if isinstance(recipe, list):
        return [moving(item, evolve, loop) for item in recipe]
    if not isinstance(recipe, dict):
        return recipe
    result = {key: moving(value, evolve, loop) for key, value in recipe.items()}
    if "type" in result and "frequency" in result:
        result |= {"evolve": evolve, "loop": loop}
    return result


def scaled_as(volume) -> dict:
    """A volume's recipe with the factors that its densities were multiplied by, so that frames do not flicker."""
    result = volume.recipe
    for grid, made in zip(result["grids"], volume.grids.values()):
        factor = made.metadata.get("solidnoise:density_factor")
        if factor is not None and "scale" in grid:
            grid["scale"]["factor"] = factor
    return result


def frame_path(folder: str, frame: int) -> str:
    return os.path.join(folder, f"frame.{frame:04d}.vdb")


def moments(recipe: dict):
    """A recipe's volume at a time, with the scale of the first that was asked for."""
    of_all = None

    def make(frame: int, time: float, tell):
        nonlocal of_all
        volume = memory.make_volume(of_all or recipe, time=time, progress=tell)
        of_all = of_all or scaled_as(volume)
        return volume

    return make


def making(make: Callable, folder: str, frames: Sequence[int], fps: float) -> Callable:
    """Work that makes the files of all frames, or none: of a frame's number, its time, and what it tells of its progress, `make` makes the
    volume. A folder that is there is what it was until all are made."""

    def work(tell) -> None:
        begun = f"{folder}.{os.getpid()}"
        try:
            os.makedirs(begun, exist_ok=True)
            for place, frame in enumerate(frames):
                volume = make(frame, (frame - frames[0]) / fps, lambda part: tell((place + part) / len(frames)))
                volume.write(frame_path(begun, frame), force=True, frame=frame, fps=fps)
            shutil.rmtree(folder, ignore_errors=True)
            os.rename(begun, folder)
        except BaseException:
            shutil.rmtree(begun, ignore_errors=True)
            raise

    return work


class OBJECT_OT_solidnoise_sequence(bpy.types.Operator):
    """Make the volume move: a file for each frame of the scene. Esc stops it"""

    bl_idname, bl_label = "object.solidnoise_sequence", "Sequence"
    bl_options = {"UNDO"}

    evolve: bpy.props.FloatProperty(name="Evolve", description=f"{_table['evolve']['description']}; a unit of time is a second", default=0.3,
                                    min=0.0, soft_max=4.0)
    loops: bpy.props.BoolProperty(name="Loop", description="After the scene's last frame the first follows, to the last bit", default=True)

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self)

    @reported
    def execute(self, context):
        obj, scene = context.object, context.scene
        require_object(obj, "VOLUME")
        if volumes.RECIPE not in obj or obj.data.get(files.SOURCES):
            raise Refused(f"{obj.name} has no recipe of its own; it must be a volume of Add > Volume > Solidnoise")
        fps = scene.render.fps / scene.render.fps_base
        self._frames = range(scene.frame_start, scene.frame_end + 1)
        self._recipe = moving(recipes.of_object(obj), plain(self.evolve), len(self._frames) / fps if self.loops else 0.0)
        key = {**self._recipe, "frames": [scene.frame_start, scene.frame_end, fps]}
        self._folder = files.path_for(obj.name, recipes.digest(key), "")
        self._name = obj.name
        self._job = worker.Job(self._folder, making(moments(self._recipe), files.absolute(self._folder), self._frames, fps))
        self._token = waits.mark(obj, self._job)
        _jobs.append(self._job)
        if bpy.app.background:
            self._job.is_over(None)
            return self._finish(context)
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        context.window_manager.progress_begin(0, 100)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._job.stops = True
        elif event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not self._job.is_over():
            context.window_manager.progress_update(int(100 * self._job.fraction))
            context.workspace.status_text_set(f"Solidnoise: {self._job.fraction:.0%} of {len(self._frames)} frames, Esc stops")
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        for workspace in bpy.data.workspaces:  # all that it was shown in
            with context.temp_override(workspace=workspace):
                workspace.status_text_set(None)
        return reported(type(self)._finish)(self, context)

    def cancel(self, context):
        """Blender ends, or opens another file."""
        self._job.stops = True

    def _finish(self, context):
        """Shows the sequence, or raises what went wrong; then nothing is left of it."""
        obj = next(iter(waits.found(self._token)), None) or bpy.data.objects.get(self._name)  # of this name after an undo
        waits.forget(self._token)
        _jobs.remove(self._job)
        self._job.settle()
        files.made(self._folder)
        if obj is None or obj.type != "VOLUME":
            files.tidy()
            raise Refused(f"{self._name} is gone")
        volumes.own_data(obj)
        first = frame_path(self._folder, self._frames[0])
        obj.data.filepath, obj.data.is_sequence = first, True
        obj.data.frame_start, obj.data.frame_duration, obj.data.frame_offset = self._frames[0], len(self._frames), self._frames[0] - 1
        obj.data.sequence_mode = "REPEAT" if self.loops else "EXTEND"
        obj[volumes.RECIPE] = json.dumps(self._recipe)
        files.tidy()
        return {"FINISHED"}


CLASSES = (OBJECT_OT_solidnoise_sequence,)


def register() -> None:
    """Nothing but its class."""


def unregister() -> None:
    for job in _jobs:
        job.stops = True
    for job in _jobs:
        job.is_over(None)
    _jobs.clear()
