"""Object > Solidnoise on a mesh: the values are the library's, in Blender's colour space and scale; what is refused leaves the mesh as it was."""

import json
import os
from pathlib import Path

import bpy
import numpy as np
import pytest
import solidnoise

MOSS = str(Path(__file__).resolve().parents[3] / "examples/exemplars/moss.jpg")


@pytest.fixture
def torus():
    bpy.ops.mesh.primitive_torus_add(major_segments=32, minor_segments=16)
    bpy.ops.ed.undo_push(message="torus")
    return bpy.context.object


def arrays(mesh) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and quads, by other means than the add-on's."""
    return np.array([vertex.co for vertex in mesh.vertices]), np.array([polygon.vertices for polygon in mesh.polygons])


def values(mesh, name: str) -> np.ndarray:
    key = {"FLOAT": "value", "FLOAT_COLOR": "color", "FLOAT_VECTOR": "vector"}[mesh.attributes[name].data_type]
    return np.array([getattr(item, key) for item in mesh.attributes[name].data], np.float32)


@pytest.mark.parametrize("name", ["rust", "scales", "bark", "stone", "skin", "moss", "car-paint", "raw"])
def test_a_bake_is_the_librarys_in_linear_light_and_has_a_material(name: str, torus) -> None:
    assert bpy.ops.object.solidnoise_bake(preset=name) == {"FINISHED"}
    expected = solidnoise.bake(*arrays(torus.data), solidnoise.preset(name, "bake"), up="z")
    np.testing.assert_array_equal(values(torus.data, "solidnoise")[:, :3], expected["colors"])
    np.testing.assert_array_equal(values(torus.data, "noise"), expected["noise"])
    assert torus.data.color_attributes.active_color.name == "solidnoise"
    nodes = torus.active_material.node_tree.nodes
    roughness = "roughness" if "roughness" in expected else "noise"
    assert {node.attribute_name for node in nodes if node.type == "ATTRIBUTE"} == {"solidnoise", roughness}
    for number in expected.keys() & {"roughness", "height"}:
        np.testing.assert_array_equal(values(torus.data, number), expected[number])
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    assert shader.inputs["Base Color"].is_linked and shader.inputs["Roughness"].is_linked


def rendered(obj) -> np.ndarray:
    """The object from above by Cycles, in the white light of the world alone: rows of red, green, blue."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location, camera.data.type, camera.data.ortho_scale = (0, 0, 5), "ORTHO", 3.0
    scene.collection.objects.link(camera)
    scene.world = bpy.data.worlds.new("World")
    scene.camera, scene.render.engine = camera, "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 4, False
    scene.render.resolution_x = scene.render.resolution_y = 24
    scene.render.filepath = os.path.join(bpy.app.tempdir, "shown.png")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    return np.array(image.pixels).reshape(-1, 4)[:, :3]


def test_the_noise_is_shown_in_place_of_the_colours_and_the_other_way_round(torus) -> None:
    with pytest.raises(RuntimeError, match="Torus has no noise"):
        bpy.ops.object.solidnoise_show(what="NOISE")
    bpy.ops.object.solidnoise_bake(preset="rust", surface_seed=2)  # of which there is some above
    colors = rendered(torus)
    assert bpy.ops.object.solidnoise_show(what="NOISE") == {"FINISHED"}
    grey = rendered(torus)
    assert (colors[:, 0] - colors[:, 2]).max() > 0.1  # rust is red
    assert np.ptp(grey, axis=1).max() < 0.02 and np.ptp(grey[:, 0]) > 0.15  # in the dim light of a new world
    bpy.ops.object.solidnoise_bake(preset="rust", surface_seed=5)  # which stays what is shown, in its own range
    noise = values(torus.data, "noise")
    inputs = torus.active_material.node_tree.nodes["Solidnoise grey"].inputs
    assert (inputs["From Min"].default_value, inputs["From Max"].default_value) == (noise.min(), noise.max())
    bpy.ops.object.solidnoise_show(what="COLORS")
    shader = next(node for node in torus.active_material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    assert shader.inputs["Base Color"].links[0].from_node.attribute_name == "solidnoise"


def test_parameters_follow_the_curvature_or_a_number_of_the_vertices(torus) -> None:
    weights = np.linspace(0, 1, len(torus.data.vertices))
    group = torus.vertex_groups.new(name="worn")
    for index, weight in enumerate(weights):
        group.add([index], weight, "REPLACE")
    bpy.ops.object.solidnoise_bake(preset="stone", bake_bias=(-1, 1), by_source="height")
    by_height = solidnoise.bake(*arrays(torus.data), solidnoise.preset("stone"), up="z", bias=(-1, 1), by={"source": "height"})
    np.testing.assert_array_equal(values(torus.data, "noise"), by_height["noise"])
    bpy.ops.object.solidnoise_bake(preset="stone", bake_bias=(-1, 1), by_attribute="worn")
    by_group = solidnoise.bake(*arrays(torus.data), solidnoise.preset("stone"), up="z", bias=(-1, 1), by={"attribute": "worn"},
                               attributes={"worn": np.float32(weights)})
    np.testing.assert_array_equal(values(torus.data, "noise"), by_group["noise"])
    with pytest.raises(RuntimeError, match="has no number missing of its vertices, and no vertex group"):
        bpy.ops.object.solidnoise_bake(preset="stone", by_attribute="missing")


def test_up_is_what_is_up_in_the_scene(torus) -> None:
    torus.rotation_euler = (np.pi / 2, 0, 0)
    bpy.context.view_layer.update()
    bpy.ops.object.solidnoise_bake(preset="bark")
    expected = solidnoise.bake(*arrays(torus.data), solidnoise.preset("bark"), up="y")
    np.testing.assert_array_equal(values(torus.data, "noise"), expected["noise"])


def test_a_scaled_object_has_the_noise_of_its_size_in_the_world(torus) -> None:
    torus.scale = (-1, 3, 0.5)
    bpy.context.view_layer.update()
    bpy.ops.object.solidnoise_displace(preset="rust", height=0.1)
    vertices, faces = arrays(torus.data)
    expected = solidnoise.bake(vertices * (1, 3, 0.5), faces, solidnoise.preset("rust"), up="z", displace=0.1)
    np.testing.assert_array_equal(values(torus.data, "noise"), expected["noise"])
    moved = np.array([point.co for point in torus.data.shape_keys.key_blocks["Solidnoise"].data]) * (1, 3, 0.5)
    np.testing.assert_allclose(moved, expected["vertices"], atol=1e-6)  # positions in single precision, of size 4 at most
    torus.scale = (1, 0, 1)
    bpy.context.view_layer.update()
    with pytest.raises(RuntimeError, match="Torus is scaled to 0 along an axis"):
        bpy.ops.object.solidnoise_bake()


def test_displacement_is_a_shape_key_or_an_attribute(torus) -> None:
    rest = arrays(torus.data)
    bpy.ops.object.solidnoise_displace("EXEC_DEFAULT", True, preset="stone", height=0.2)
    key = torus.data.shape_keys.key_blocks["Solidnoise"]
    expected = solidnoise.bake(*rest, solidnoise.preset("stone"), up="z", displace=0.2)
    np.testing.assert_array_equal(np.array([point.co for point in key.data], np.float32), np.float32(expected["vertices"]))
    assert key.value == 1
    np.testing.assert_array_equal(np.array([point.co for point in torus.data.shape_keys.key_blocks["Basis"].data]), rest[0])
    bpy.ops.object.solidnoise_displace(preset="stone", height=0.2)  # of the shape at rest, once more
    assert [block.name for block in torus.data.shape_keys.key_blocks] == ["Basis", "Solidnoise"]
    bpy.ops.ed.undo()
    torus = bpy.data.objects["Torus"]
    assert torus.data.shape_keys is None
    bpy.ops.object.solidnoise_displace(preset="stone", height=0.2, becomes="ATTRIBUTE")
    # Differences of numbers of size 2 at most in single precision.
    np.testing.assert_allclose(values(torus.data, "displacement"), expected["vertices"] - rest[0], atol=2e-7)


def test_noise_by_example_of_a_file_and_of_an_image_has_the_pictures_colours(torus) -> None:
    model = solidnoise.fit(MOSS, patch=64)
    bpy.ops.object.solidnoise_example(file=MOSS)
    expected = solidnoise.bake(*arrays(torus.data), {"surface": {"noise": "spectrum", "exemplar": model.recipe["exemplar"]}, "ramp": "exemplar"}, up="z")
    np.testing.assert_array_equal(values(torus.data, "solidnoise")[:, :3], expected["colors"])
    image = bpy.data.images.load(MOSS)
    bpy.ops.object.solidnoise_example(image=image.name, width=1)
    scaled = solidnoise.fit(MOSS, patch=64, pixel_size=1 / image.size[0])
    expected = solidnoise.bake(*arrays(torus.data), {"surface": {"noise": "spectrum", "exemplar": scaled.recipe["exemplar"]}, "ramp": "exemplar",
                                                     "frequency": scaled.principal_frequency}, up="z")
    # The same but for decoders of JPEG, which may differ by a step of 255 somewhere.
    assert np.abs(values(torus.data, "solidnoise")[:, :3].mean(0) - expected["colors"].mean(0)).max() < 1 / 255


def test_an_image_in_linear_light_has_the_colours_of_the_same_in_srgb(torus) -> None:
    image = bpy.data.images.load(MOSS)
    pixels = np.array(image.pixels[:], np.float32)
    linear = bpy.data.images.new("linear", *image.size, float_buffer=True)
    linear.pixels[:] = np.where(pixels <= 0.04045, pixels / 12.92, ((pixels + 0.055) / 1.055) ** 2.4).tolist()
    means = []
    for name in (image.name, linear.name):
        bpy.ops.object.solidnoise_example(image=name)
        means.append(values(torus.data, "solidnoise")[:, :3].mean(0))
    np.testing.assert_allclose(means[1], means[0], atol=1e-3)


def test_a_photograph_of_a_unit_a_pixel_has_its_true_size(torus) -> None:
    image = bpy.data.images.load(MOSS)
    bpy.ops.object.solidnoise_example(image=image.name, width=image.size[0])
    assert json.loads(torus["solidnoise_recipe"])["frequency"] > 0.0


def test_undo_and_redo_with_other_values(torus) -> None:
    bpy.ops.object.solidnoise_bake("EXEC_DEFAULT", True, preset="rust", surface_seed=1)
    first = values(torus.data, "noise")
    bpy.ops.ed.undo()
    torus = bpy.data.objects["Torus"]
    assert not {"solidnoise", "noise"} & set(torus.data.attributes.keys()) and len(bpy.data.materials) == 0
    assert "solidnoise_recipe" not in torus
    bpy.ops.object.solidnoise_bake("EXEC_DEFAULT", True, preset="rust", surface_seed=2)
    assert not np.array_equal(values(torus.data, "noise"), first)
    assert len(bpy.data.materials) == 1 and json.loads(torus["solidnoise_recipe"])["surface"]["seed"] == 2
    torus.solidnoise_mesh.surface_seed = 1
    bpy.ops.object.solidnoise_mesh_remake("EXEC_DEFAULT", True)
    np.testing.assert_array_equal(values(torus.data, "noise"), first)
    assert len(bpy.data.materials) == 1


def test_saved_and_opened_again_it_can_be_made_again(tmp_path, torus) -> None:
    bpy.ops.object.solidnoise_displace(preset="bark", height=0.3, surface_seed=4)
    before = values(torus.data, "noise")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    torus = bpy.data.objects["Torus"]
    settings = torus.solidnoise_mesh
    assert (settings.preset, settings.surface_seed, settings.task, round(settings.height, 6)) == ("bark", 4, "DISPLACE", 0.3)
    torus.data.attributes["noise"].data.foreach_set("value", np.zeros(len(before), np.float32))
    bpy.context.view_layer.objects.active = torus
    assert bpy.ops.object.solidnoise_mesh_remake() == {"FINISHED"}
    np.testing.assert_array_equal(values(torus.data, "noise"), before)


def test_faces_of_all_kinds_and_modifiers_will_do(capfd) -> None:
    bpy.ops.mesh.primitive_cone_add(vertices=24)  # triangles, and a face of 24 corners
    cone = bpy.context.object
    cone.modifiers.new("Subdivision", "SUBSURF")
    assert bpy.ops.object.solidnoise_bake(preset="stone") == {"FINISHED"}
    assert "the noise is that of Cone without its modifiers" in capfd.readouterr().out
    expected = solidnoise.bake([vertex.co for vertex in cone.data.vertices], [list(polygon.vertices) for polygon in cone.data.polygons],
                               solidnoise.preset("stone"), up="z")
    np.testing.assert_array_equal(values(cone.data, "noise"), expected["noise"])  # solid noise depends on positions alone


def test_what_was_not_made_here_is_not_written_over(torus, blocks) -> None:
    torus.data.attributes.new("height", "FLOAT", "POINT")
    refused(lambda: bpy.ops.object.solidnoise_bake(preset="rust"), "Torus has an attribute height that was not made here", blocks)
    bpy.ops.object.solidnoise_bake(preset="raw")  # which writes no height
    refused(lambda: bpy.ops.object.solidnoise_bake(preset="raw", bake_bias=(-1, 1), by_attribute="noise"),
            "by is noise, which would be written over", blocks)
    bpy.ops.object.solidnoise_bake(preset="raw", bake_bias=(-1, 1), by_attribute="height")


def test_another_preset_leaves_nothing_of_the_one_before(torus) -> None:
    own = torus.data.attributes.new("own", "FLOAT", "POINT").name
    for name in ("raw", "rust", "raw"):
        bpy.ops.object.solidnoise_bake(preset=name)
        numbers = {"height", "roughness"} if name == "rust" else set()
        assert set(torus.data.attributes.keys()) & {"height", "roughness", own} == numbers | {own}
        nodes = torus.active_material.node_tree.nodes
        assert {node.attribute_name for node in nodes if node.type == "ATTRIBUTE"} == {"solidnoise", "roughness" if numbers else "noise"}
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    torus.active_material.node_tree.links.remove(shader.inputs["Roughness"].links[0])
    bpy.ops.object.solidnoise_bake(preset="rust")
    assert not shader.inputs["Roughness"].is_linked  # as it was set by hand


def test_a_material_of_the_users_that_is_replaced_stays(torus) -> None:
    own = bpy.data.materials.new("Own")
    torus.data.materials.append(own)
    bpy.ops.object.solidnoise_bake(preset="raw")
    assert torus.active_material != own and own.use_fake_user


def test_it_is_said_that_one_of_many_is_baked(torus, capfd) -> None:
    other = torus.copy()
    other.data = torus.data.copy()
    bpy.context.scene.collection.objects.link(other)
    other.select_set(True)
    bpy.ops.object.solidnoise_bake(preset="raw")
    assert "only the active object, Torus, has got noise" in capfd.readouterr().out and "noise" not in other.data.attributes


def refused(operator, message: str, blocks) -> None:
    """Of every operator on meshes: a line, and nothing changed."""
    before, attributes = blocks(), {mesh.name: sorted(mesh.attributes.keys()) for mesh in bpy.data.meshes}
    with pytest.raises(RuntimeError, match=f"^Error: {message}"):
        operator()
    assert blocks() == before and attributes == {mesh.name: sorted(mesh.attributes.keys()) for mesh in bpy.data.meshes}


OPERATORS = [lambda: bpy.ops.object.solidnoise_bake(), lambda: bpy.ops.object.solidnoise_displace(),
             lambda: bpy.ops.object.solidnoise_example(file=MOSS)]


@pytest.mark.parametrize("operator", OPERATORS)
def test_meshes_without_a_surface_are_refused(operator, blocks) -> None:
    for vertices, message in (([], "Shape: the mesh has no vertices"), ([(0, 0, 0), (1, 0, 0)], "Shape: the mesh has 2 vertices but no faces")):
        mesh = bpy.data.meshes.new("Shape")
        mesh.from_pydata(vertices, [], [])
        obj = bpy.data.objects.new("Shape", mesh)
        bpy.context.scene.collection.objects.link(obj)
        bpy.context.view_layer.objects.active = obj
        refused(operator, message, blocks)
        bpy.data.objects.remove(obj)
        bpy.data.meshes.remove(mesh)
    refused(operator, "the active object is none; it must be a mesh", blocks)


@pytest.mark.parametrize("operator", OPERATORS)
def test_edit_mode_and_linked_meshes_are_refused(operator, blocks, torus, tmp_path) -> None:
    bpy.ops.object.mode_set(mode="EDIT")
    refused(operator, "Torus is in edit mode; leave it first", blocks)
    bpy.ops.object.mode_set(mode="OBJECT")
    library = str(tmp_path / "library.blend")
    bpy.data.libraries.write(library, {torus.data}, fake_user=True)
    with bpy.data.libraries.load(library, link=True) as (there, here):
        here.meshes = list(there.meshes)
    obj = bpy.data.objects.new("User", here.meshes[0])
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    refused(operator, "Torus is linked from .*library.blend; make it local first", blocks)


def test_what_the_library_refuses_is_reported_in_its_words(torus, blocks) -> None:
    refused(lambda: bpy.ops.object.solidnoise_bake(bake_ramp="no such ramp"), "ramp", blocks)
    refused(lambda: bpy.ops.object.solidnoise_example(file="/no/such.jpg"), ".*/no/such.jpg", blocks)
    refused(lambda: bpy.ops.object.solidnoise_example(file="/no/such.jpg", width=1), ".*/no/such.jpg", blocks)
    refused(lambda: bpy.ops.object.solidnoise_example(), "no picture is chosen", blocks)
    refused(lambda: bpy.ops.object.solidnoise_example(image="none"), "the scene has no image none", blocks)
    bpy.data.images.new("small", 8, 8)
    refused(lambda: bpy.ops.object.solidnoise_example(image="small"), "pictures: has 8 samples along an axis; it must have at least 16", blocks)


def test_an_attribute_of_another_kind_is_not_written_over(torus, blocks) -> None:
    torus.data.attributes.new("noise", "INT", "FACE")
    refused(OPERATORS[0], "Torus has an attribute noise of another kind; rename or remove it", blocks)
