"""blender_window.py OUT.png: a picture of Blender's window with the add-on's redo panel and side panel open. Run in a display, or by
xvfb-run -a -s "-screen 0 1400x900x24" blender --factory-startup --window-geometry 0 0 1400 900 --enable-event-simulate -P blender_window.py -- OUT.png"""

import os
import sys

import addon_utils
import bpy

PROJECT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
sys.path[:0] = [os.path.join(PROJECT, "scripts"), os.path.join(PROJECT, "integrations/blender"), os.path.join(PROJECT, "integrations/blender/tests")]

import blender as look  # noqa: E402
from drive import in_view, open_panel, open_redo_panel, region_of, tell, view  # noqa: E402


def story():
    yield 1
    addon_utils.enable("solidnoise_blender", default_set=True)
    from solidnoise_blender import worker
    scene = bpy.context.scene
    for obj in list(scene.objects):
        bpy.data.objects.remove(obj)
    look.light(scene, False)
    with in_view():
        bpy.ops.object.solidnoise_volume_add("INVOKE_DEFAULT", True, preset="cumulus")
    while worker.jobs:
        yield 0.1
    space = view()[1].spaces.active
    space.region_3d.view_distance, space.region_3d.view_location = 4.5, (0, 0, 0.35)
    scene.render.engine, scene.cycles.preview_samples, scene.cycles.volume_bounces, scene.cycles.volume_step_rate = "CYCLES", 24, 4, 1.5
    space.shading.type = "RENDERED"
    yield from open_panel()
    yield from open_redo_panel()
    bpy.context.window_manager.windows[0].event_simulate("MOUSEMOVE", "NOTHING", x=region_of("WINDOW").x + 500, y=300)
    yield 60  # for Cycles
    with bpy.context.temp_override(window=view()[0]):
        bpy.ops.screen.screenshot(filepath=os.path.abspath(sys.argv[sys.argv.index("--") + 1]))


tell(story())
