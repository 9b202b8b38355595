"""Work on threads of its own, so that the window never freezes: what takes long ends in a timer of Blender's, with progress, and can be
stopped. Scripts, and Blender without a window, wait for it."""

import functools
import threading
from typing import Callable, Optional

import bpy

PATIENCE = 0.4  # seconds that an operator waits, so that what is quick is there at once
_BETWEEN = 0.1
_BEGINS = 2.0  # at most: until work is the library's own, for Blender crashes of much Python on a thread while it goes on itself


class Stopped(Exception):
    """The work was told to stop."""


class Job:
    """`work` gets a function that it calls with the fraction that is done; what it returns is given to `done`, what it raises to
    `failed`, in Blender's own thread. It stops when it is not `wanted` any more. `subject` is what it makes."""

    def __init__(self, subject: str, work: Callable, *, done=lambda result: None, failed=lambda error: None, wanted=lambda: True):
        self.subject, self.fraction, self.result = subject, 0.0, None
        self.error: Optional[Exception] = None
        self.done, self.failed, self.wanted = done, failed, wanted
        self.stops = False
        self._work = work
        self._began = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        self._began.wait(_BEGINS)

    def _run(self) -> None:
        try:
            self.result = self._work(self.tell)
        except Exception as error:  # whatever it is, it is told by whoever waits
            self.error = error
        finally:
            self._began.set()

    def tell(self, fraction: float) -> None:
        self._began.set()
        self.fraction = fraction
        if self.stops:
            raise Stopped

    def is_over(self, wait: Optional[float] = 0.0) -> bool:
        self._thread.join(wait)
        return not self._thread.is_alive()

    def settle(self):
        """What came of it, once it is over. Raises what it raised."""
        if self.error:
            raise self.error
        return self.result


jobs: list[Job] = []  # that go on behind the window


def wait_a_little(job: Job) -> bool:
    """Whether the job is over by now; without a window it always is."""
    return job.is_over(None if bpy.app.background else PATIENCE)


def at_work(subject: str) -> Optional[Job]:
    """The job that makes it, if there is one."""
    return next((job for job in jobs if job.subject == subject and not job.stops), None)


def go_on(job: Job) -> None:
    """Leaves a job to the timer."""
    jobs.append(job)
    if not bpy.app.timers.is_registered(_attend):
        bpy.app.timers.register(_attend, first_interval=_BETWEEN, persistent=True)


def stop_all() -> None:
    for job in jobs:
        job.stops = True
    for job in jobs:
        job.is_over(None)
    jobs.clear()
    if bpy.app.timers.is_registered(_attend):
        bpy.app.timers.unregister(_attend)


def _settle(job: Job) -> None:
    if job.error is None:
        job.done(job.result)
    elif job.wanted():
        job.failed(job.error)
        if not isinstance(job.error, Stopped):
            tell(str(job.error))


def _attend() -> Optional[float]:
    for job in list(jobs):
        job.stops = job.stops or not job.wanted()
        if not job.is_over():
            continue
        jobs.remove(job)
        try:
            _settle(job)
        except Exception as error:  # of the one job: the timer is all jobs'
            tell(str(error))
    redraw()
    return _BETWEEN if jobs else None


def redraw() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def tell(message: str) -> None:
    """What went wrong while no operator ran that could report it, in lines: on the console, and in the window as soon as there is one."""
    print(f"Solidnoise: {message}")
    if not bpy.app.background:
        bpy.app.timers.register(functools.partial(_pop_up, message.split("\n")), persistent=True)


def _pop_up(lines: list) -> None:
    def draw(menu, context) -> None:
        for line in lines:
            menu.layout.label(text=line)

    bpy.context.window_manager.popup_menu(draw, title="Solidnoise", icon="ERROR")
