"""Drives Blender's window: a story is a generator that yields how many seconds the window has to itself, and the user's hands are events."""

import os
import sys
import traceback

import bpy


def view() -> tuple:
    """The window, its 3D view, and the region that operators are called in."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return window, area, next(region for region in area.regions if region.type == "WINDOW")


def region_of(kind: str):
    return next(region for region in view()[1].regions if region.type == kind)


def in_view():
    window, area, region = view()
    return bpy.context.temp_override(window=window, area=area, region=region)


def press(key: str, x: int = 600, y: int = 400):
    window = view()[0]
    window.event_simulate("MOUSEMOVE", "NOTHING", x=x, y=y)
    yield 0.2
    window.event_simulate(key, "PRESS", x=x, y=y)
    yield 0.1
    window.event_simulate(key, "RELEASE", x=x, y=y)
    yield 0.3


def open_panel():
    """The side panel, at the tab that comes after Item, Tool and View."""
    view()[1].spaces.active.show_region_ui = True
    yield 1
    side = region_of("UI")
    yield from press("LEFTMOUSE", side.x + side.width - 12, side.y + side.height - 176)


def open_redo_panel():
    """Of the operator that was called last."""
    hud = region_of("HUD")
    yield from press("LEFTMOUSE", hud.x + 15, hud.y + hud.height - 15)


def tell(story) -> None:
    """Tells it to its end, and ends Blender, with 1 where it failed."""

    def step():
        try:
            return next(story)
        except StopIteration:
            status = 0
        except BaseException:
            traceback.print_exc()
            status = 1
        sys.stdout.flush()
        os._exit(status)

    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(step, first_interval=1)
