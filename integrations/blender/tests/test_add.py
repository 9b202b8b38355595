"""Add > Volume > Solidnoise: every preset, its values, undo, redo, other values, what is refused."""

import json
import os

import bpy
import numpy as np
import pytest
import solidnoise
from solidnoise_blender import recipes

VOLUMES = [name for name, _ in recipes.presets(recipes.VOLUME)]


def made_file(obj) -> str:
    return bpy.path.abspath(obj.data.filepath)


def folder() -> list[str]:
    path = os.path.join(bpy.app.tempdir, "solidnoise")
    return sorted(os.listdir(path)) if os.path.isdir(path) else []


@pytest.mark.parametrize("name", VOLUMES)
def test_every_preset_is_the_volume_of_its_recipe_and_has_a_material(name: str, add) -> None:
    obj = add(preset=name)
    expected = solidnoise.make_volume(solidnoise.preset(name), domain={"dim": 24})
    shown = solidnoise.read_volume(made_file(obj))
    assert sorted(grid.name for grid in obj.data.grids) == sorted(expected.grids)
    for grid in expected.grids:
        np.testing.assert_array_equal(shown.to_numpy(grid), expected.to_numpy(grid))
    tree = obj.data.materials[0].node_tree
    shader = next(node for node in tree.nodes if node.type == "PRINCIPLED_VOLUME")
    assert [link.to_node.type for link in shader.outputs[0].links] == ["OUTPUT_MATERIAL"]
    read = {shader.inputs[key].default_value for key in ("Density Attribute", "Temperature Attribute", "Color Attribute")} | {
        node.attribute_name for node in tree.nodes if node.type == "ATTRIBUTE"}
    assert read & {{"vel": "velocity"}.get(grid, grid) for grid in expected.grids}  # as Cycles calls it
    assert ("temperature" in expected.grids) == (shader.inputs["Blackbody Intensity"].default_value > 0)


@pytest.mark.parametrize("kind", [recipes.VOLUME, recipes.BAKE])
def test_all_presets_that_ship_are_in_a_menu(kind: str) -> None:
    menu = [name for name, _ in recipes.presets(kind)]
    assert sorted(menu) == sorted(solidnoise.presets(kind)) and "raw" in menu


def test_it_stands_upright_at_the_cursor(add) -> None:
    bpy.context.scene.cursor.location = (1, 2, 3)
    obj = add(preset="smoke", size=4, domain_dim=96)  # 3.2 x 3.2 x 4, on the ground
    bpy.context.view_layer.update()
    corners = np.array([obj.matrix_world @ type(obj.location)(corner) for corner in obj.bound_box])
    leaf = 8 * 4 / 96  # Blender's box is of whole leaves
    assert obj.scale[:] == (2, 2, 2)
    assert 3 - leaf <= corners[:, 2].min() < 3.5 and 5 < corners[:, 2].max() <= 7 + leaf
    assert np.abs(corners[:, :2] - (1, 2)).max() <= 1.6 + leaf


@pytest.mark.parametrize("name", ["explosion", "nebula", "velocity"])
def test_it_glows_as_much_at_any_size(name: str, add) -> None:
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    camera.data.type, camera.rotation_euler = "ORTHO", (np.pi / 2, 0, 0)
    scene.camera, scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = camera, "CYCLES", 8, False
    scene.render.resolution_x = scene.render.resolution_y = 24
    scene.render.image_settings.file_format = "OPEN_EXR"
    light = []
    for size in (0.5, 8):
        obj = add(preset=name, size=size)
        camera.location, camera.data.ortho_scale = (0, -2 * size, 0), 2 * size
        scene.render.filepath = os.path.join(bpy.app.tempdir, f"{size}.exr")
        bpy.ops.render.render(write_still=True)
        light.append(np.mean(bpy.data.images.load(scene.render.filepath).pixels))
        bpy.data.objects.remove(obj)
    assert light[0] > 1e-3 and light[1] == pytest.approx(light[0], rel=0.01)


def test_another_preset_has_another_look_and_the_own_material_stays(add) -> None:
    obj = add(preset="smoke")
    for name, glows in (("fire", True), ("smoke", False)):
        obj.solidnoise_volume.preset = name
        obj.solidnoise_volume.domain_dim = 16
        bpy.ops.object.solidnoise_volume_remake()
        shader = next(node for node in obj.data.materials[0].node_tree.nodes if node.type == "PRINCIPLED_VOLUME")
        assert (shader.inputs["Blackbody Intensity"].default_value > 0) == glows
    own = obj.data.materials[0] = bpy.data.materials.new("Own")
    obj.solidnoise_volume.preset = "raw"
    bpy.ops.object.solidnoise_volume_remake()
    assert obj.data.materials[0] == own


def test_a_linked_duplicate_is_remade_alone(add) -> None:
    obj = add(preset="smoke")
    other = obj.copy()
    bpy.context.scene.collection.objects.link(other)
    before = other.data.filepath
    obj.solidnoise_volume.noise_seed = 7
    bpy.ops.object.solidnoise_volume_remake()
    assert other.data.filepath == before and obj.data.filepath != before and os.path.exists(before)


def test_properties_change_the_recipe_where_they_are_set_and_nowhere_else(add) -> None:
    plain, changed = (json.loads(add(preset="cumulus", **values)["solidnoise_recipe"]) for values in (
        {}, {"noise_seed": 7, "noise_gain": 0.6, "shaping_wisps": 0.3, "scale_optical_depth": 40, "volume_wind": (0.5, 0, 0)}))
    plain["noise"] |= {"seed": 7, "gain": 0.6}
    plain["grids"][0]["shaping"]["wisps"] = 0.3
    plain["grids"][0]["scale"]["optical_depth"] = 40
    assert changed == {**plain, "wind": [0.5, 0, 0]}


def test_detail_makes_all_noises_finer(add) -> None:
    recipe = json.loads(add(preset="fire", detail=2)["solidnoise_recipe"])
    assert recipe["noise"]["frequency"] == 6
    assert recipe["fields"]["smoke"]["layers"][2]["noise"]["frequency"] == 4.4


def test_raw_noise_is_of_any_kind(add) -> None:
    recipe = json.loads(add(preset="raw", noise_type="cellular", noise_feature="border")["solidnoise_recipe"])
    assert (recipe["noise"]["type"], recipe["noise"]["feature"]) == ("cellular", "border")
    assert "bandwidth" not in recipe["noise"]


@pytest.mark.parametrize("name", ["cumulus", "raw"])
def test_any_choice_can_be_made_of_any_preset(name: str, add) -> None:
    for noise in ("gabor", "cellular"):
        assert json.loads(add(preset=name, noise_type=noise, domain_dim=4)["solidnoise_recipe"])["noise"]["type"] == noise
    for shape in ("sphere", "box"):
        recipe = json.loads(add(preset=name, domain_shape=shape, domain_dim=4)["solidnoise_recipe"])
        assert recipe["domain"]["shape"] == {"type": shape}


def test_undo_leaves_nothing_and_redo_brings_it_back(add, blocks) -> None:
    before = blocks()
    path = made_file(add())
    bpy.ops.ed.undo()
    assert blocks() == before
    assert folder() == [] and not os.path.exists(path)
    bpy.ops.ed.redo()
    assert os.path.exists(path)
    assert [grid.name for grid in bpy.data.objects["Cumulus"].data.grids] == ["density"]


def test_the_redo_panel_leaves_one_volume_and_one_file(add, blocks) -> None:
    add(noise_seed=1)
    once = blocks()
    for seed in (2, 3):
        bpy.ops.ed.undo()  # as the panel does before it executes again
        add(noise_seed=seed)
    assert blocks() == once and len(folder()) == 1
    assert json.loads(bpy.context.object["solidnoise_recipe"])["noise"]["seed"] == 3


def test_what_the_library_refuses_is_reported_in_its_words_and_leaves_nothing(blocks) -> None:
    before = blocks()
    with pytest.raises(RuntimeError) as error:
        bpy.ops.object.solidnoise_volume_add(preset="raw", domain_dim=16, noise_type="cellular", noise_octaves=16, noise_lacunarity=64)
    with pytest.raises(ValueError) as by_library:
        solidnoise.make_volume(solidnoise.preset("raw"), dim=16, noise={"type": "cellular", "octaves": 16, "lacunarity": 64})
    assert str(error.value).strip() == f"Error: {by_library.value}"
    assert blocks() == before and folder() == []


def test_more_voxels_than_there_is_memory_for_are_refused_and_leave_nothing(blocks) -> None:
    before = blocks()
    with pytest.raises(RuntimeError, match=r"Error: 16000 x 20000 x 16000 voxels may need .*, max_memory allows .*; make dim smaller"):
        bpy.ops.object.solidnoise_volume_add(preset="smoke", domain_dim=20000)
    assert blocks() == before and folder() == []


def test_it_is_refused_in_edit_mode(blocks) -> None:
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.object.mode_set(mode="EDIT")
    before = blocks()
    with pytest.raises(RuntimeError, match="Cube is in edit mode; leave it first"):
        bpy.ops.object.solidnoise_volume_add()
    assert blocks() == before


def test_a_linked_collection_is_refused(tmp_path, blocks) -> None:
    library = str(tmp_path / "library.blend")
    bpy.data.libraries.write(library, {bpy.data.collections.new("Set")}, fake_user=True)
    with bpy.data.libraries.load(library, link=True) as (there, here):
        here.collections = list(there.collections)
    bpy.context.scene.collection.children.link(here.collections[0])
    bpy.context.view_layer.active_layer_collection = bpy.context.view_layer.layer_collection.children[0]
    before = blocks()
    with pytest.raises(RuntimeError, match="the active collection, Set, is linked; choose one of this file"):
        bpy.ops.object.solidnoise_volume_add(domain_dim=16)
    assert blocks() == before and folder() == []


def test_a_folder_that_cannot_be_written_is_reported(tmp_path, blocks) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    (tmp_path / "solidnoise").write_text("not a folder")
    before = blocks()
    with pytest.raises(RuntimeError, match="Error: .*solidnoise"):
        bpy.ops.object.solidnoise_volume_add(domain_dim=16)
    assert blocks() == before
