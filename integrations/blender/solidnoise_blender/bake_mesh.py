"""Object > Solidnoise on a mesh: noise as colours, as displacement, and by the example of a photograph."""

import json

import bpy
import solidnoise

from . import examples, meshes, waits, worker
from .add_volume import copy
from .errors import Refused, reported, require_object
from .settings import BakeSettings
from .volumes import RECIPE


class MeshSettings(BakeSettings):
    __annotations__ = {
        "task": bpy.props.EnumProperty(items=[(word, word.capitalize(), "") for word in ("BAKE", "DISPLACE", "EXAMPLE")],
                                       options={"HIDDEN", "SKIP_SAVE"}),
        "height": bpy.props.FloatProperty(name="Height", description=solidnoise.schema("bake")["properties"]["displace"]["description"],
                                          default=0.05, unit="LENGTH", options={"SKIP_SAVE"}),
        "becomes": bpy.props.EnumProperty(name="As", description="What becomes of it", options={"SKIP_SAVE"}, items=[
            ("KEY", "Shape key", "A shape key, Solidnoise"),
            ("ATTRIBUTE", "Attribute", "A vector of each vertex, displacement, as the offset of Set Position in Geometry Nodes")]),
        "file": bpy.props.StringProperty(name="File", description="A photograph of a texture", subtype="FILE_PATH", options={"SKIP_SAVE"}),
        "image": bpy.props.StringProperty(name="Image", description="An image of the scene, in place of a file", options={"SKIP_SAVE"}),
        "width": bpy.props.FloatProperty(name="Width", description="Of what the photograph shows; 0: features are a 24th of the object",
                                         default=0.0, min=0.0, unit="LENGTH", options={"SKIP_SAVE"}),
        "patch": bpy.props.IntProperty(name="Patch", description="Average over patches of this size; 0: as large as can be, which takes "
                                       "longer (pixels)", default=64, min=0, soft_min=16, options={"SKIP_SAVE"}),
        "solid": bpy.props.BoolProperty(name="Solid", description="An isotropic noise in 3D whose slices look like the photograph",
                                        options={"SKIP_SAVE"}),
        **BakeSettings.__annotations__}
    SHARED = tuple(__annotations__)

    def draw_task(self, layout) -> None:
        if self.task != "EXAMPLE":
            self.draw_settings(layout, *(("height", "becomes") if self.task == "DISPLACE" else ()))
            return
        layout.use_property_split = True
        layout.prop_search(self, "image", bpy.data, "images")
        for name in ("file", "width", "patch", "solid", "surface_seed"):
            layout.prop(self, name)


class SolidnoiseMeshSettings(MeshSettings, bpy.types.PropertyGroup):
    """Of an object: what its noise was made with."""


def _written(settings, recipe: dict) -> tuple:
    """The names of what will be written to a mesh."""
    if settings.task == "DISPLACE":
        return (meshes.NOISE,) if settings.becomes == "KEY" else (meshes.NOISE, meshes.DISPLACEMENT)
    return (meshes.COLOR, meshes.NOISE, *(recipe.get("properties", {}) if settings.task == "BAKE" else ()))


def _work(obj, settings):
    """What is to be done, from the scene's data as they are now. Called later, on a thread, it returns what was made and its recipe."""
    recipe = {**settings.recipe(), "up": meshes.up_of(obj)}
    written = _written(settings, recipe)
    meshes.require_room(obj.data, *written)
    vertices, faces = meshes.read(obj)
    attributes = {}
    by = recipe.get("by", {})
    if "attribute" in by:
        by.pop("source", None)
        if by["attribute"] in written:
            raise Refused(f"by is {by['attribute']}, which would be written over; rename it")
        attributes = {by["attribute"]: meshes.number(obj, by["attribute"])}
    if settings.task == "DISPLACE":
        recipe["displace"] = settings.height
    source = options = None
    if settings.task == "EXAMPLE":
        source = examples.picture(settings.file, settings.image, settings.width)
        options = {"patch": settings.patch, "solid": settings.solid, "seed": settings.surface_seed, "up": recipe["up"]}

    def work(tell):
        made = examples.recipe(source, options, tell) if source else recipe
        return solidnoise.bake(vertices, faces, made, attributes=attributes, progress=tell), made

    return work


def _apply(obj, settings, result) -> None:
    baked, recipe = result
    if settings.task == "DISPLACE":
        meshes.displace(obj, baked, settings.becomes == "KEY")
    else:
        meshes.write(obj, baked)
    obj[RECIPE] = json.dumps(recipe)


def _go_on(obj, job: worker.Job) -> None:
    """Leaves a bake to the timer. It is dropped when it is undone, or when the mesh is another one by then."""
    token, count = waits.mark(obj, job), len(obj.data.vertices)

    def done(result) -> None:
        found = waits.found(token)
        waits.forget(token)
        if not found:
            return
        for obj in found:
            try:
                require_object(obj, "MESH")
                if len(obj.data.vertices) != count:
                    raise Refused(f"{obj.name} has other vertices by now; its noise is dropped")
                _apply(obj, obj.solidnoise_mesh, result)
            except Refused as error:
                return worker.tell(str(error))
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            bpy.ops.ed.undo_push(message="Noise")

    job.done, job.failed, job.wanted = done, lambda _: waits.forget(token), lambda: bool(waits.found(token))
    worker.go_on(job)


def bake(context, obj, settings) -> None:
    require_object(obj, "MESH")
    job = worker.Job(obj.name, _work(obj, settings))
    is_over = worker.wait_a_little(job)
    if is_over:
        _apply(obj, settings, job.settle())
    if settings != obj.solidnoise_mesh:
        copy(settings, obj.solidnoise_mesh)
    if not is_over:
        _go_on(obj, job)
    if settings.task != "DISPLACE":
        meshes.view_colors(context.screen)


class _MeshOperator(MeshSettings):
    bl_options = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context):
        self.task = self.TASK
        bake(context, context.object, self)
        if context.object.modifiers:
            self.report({"INFO"}, f"the noise is that of {context.object.name} without its modifiers")
        if any(obj.type == "MESH" and obj != context.object for obj in context.selected_objects):
            self.report({"INFO"}, f"only the active object, {context.object.name}, has got noise")
        return {"FINISHED"}

    def draw(self, context):
        self.draw_task(self.layout)


class OBJECT_OT_solidnoise_bake(_MeshOperator, bpy.types.Operator):
    """Bake noise on the mesh: the colour attribute solidnoise, the attribute noise, and a material that shows both"""

    bl_idname, bl_label, TASK = "object.solidnoise_bake", "Bake Noise", "BAKE"


class OBJECT_OT_solidnoise_displace(_MeshOperator, bpy.types.Operator):
    """Move the mesh's vertices along their normals by noise, as a shape key or an attribute"""

    bl_idname, bl_label, TASK = "object.solidnoise_displace", "Displace by Noise", "DISPLACE"


class OBJECT_OT_solidnoise_example(_MeshOperator, bpy.types.Operator):
    """Bake a noise that looks like a photograph, in its colours, without texture coordinates"""

    bl_idname, bl_label, TASK = "object.solidnoise_example", "Noise by Example", "EXAMPLE"

    def invoke(self, context, event):
        self.task = self.TASK
        return context.window_manager.invoke_props_dialog(self)


class OBJECT_OT_solidnoise_show(bpy.types.Operator):
    """Show the colours of a bake, or its noise from black to white, which only materials show"""

    bl_idname, bl_label = "object.solidnoise_show", "Show"
    bl_options = {"REGISTER", "UNDO"}

    what: bpy.props.EnumProperty(name="Show", description="What the mesh's material shows", items=[("COLORS", "Colours", "The colour attribute solidnoise"),
                                                     ("NOISE", "Noise", "The float attribute noise, in greys")])

    @reported
    def execute(self, context):
        require_object(context.object, "MESH")
        meshes.show(context.object, self.what)
        (meshes.view_materials if self.what == "NOISE" else meshes.view_colors)(context.screen)
        return {"FINISHED"}


class OBJECT_OT_solidnoise_mesh_remake(bpy.types.Operator):
    """Make the noise again, with the values of the side panel"""

    bl_idname, bl_label = "object.solidnoise_mesh_remake", "Remake"
    bl_options = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context):
        require_object(context.object, "MESH")
        if RECIPE not in context.object:
            raise Refused(f"{context.object.name} has no recipe; its noise was not made here")
        bake(context, context.object, context.object.solidnoise_mesh)
        return {"FINISHED"}


CLASSES = (SolidnoiseMeshSettings, OBJECT_OT_solidnoise_bake, OBJECT_OT_solidnoise_displace, OBJECT_OT_solidnoise_example,
           OBJECT_OT_solidnoise_show, OBJECT_OT_solidnoise_mesh_remake)


def register() -> None:
    bpy.types.Object.solidnoise_mesh = bpy.props.PointerProperty(type=SolidnoiseMeshSettings)


def unregister() -> None:
    del bpy.types.Object.solidnoise_mesh
