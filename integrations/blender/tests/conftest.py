import addon_utils
import bpy
import pytest


@pytest.fixture(autouse=True)
def empty_scene():
    """An empty file with the add-on enabled, and an undo step to come back to."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("solidnoise_blender", default_set=True)
    bpy.ops.ed.undo_push(message="begin")


@pytest.fixture
def add():
    """Adds a volume as the menu does, with a step to undo."""

    def call(**values):
        assert bpy.ops.object.solidnoise_volume_add("EXEC_DEFAULT", True, **{"domain_dim": 24, **values}) == {"FINISHED"}
        return bpy.context.object

    return call


@pytest.fixture
def blocks():
    """How many data-blocks of each kind there are that an operator of ours could make."""

    def count() -> dict:
        kinds = ("objects", "volumes", "meshes", "materials", "images", "shape_keys", "node_groups")
        return {kind: len(getattr(bpy.data, kind)) for kind in kinds}

    return count
