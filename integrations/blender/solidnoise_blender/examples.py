"""Noise by example: a photograph, of a file or of the scene, becomes a noise."""

import bpy
import numpy as np
import solidnoise

from .errors import Refused


def picture(path: str, name: str, width: float) -> tuple:
    """A picture as solidnoise.fit() has it, and how it is to be read. `width` is its own in the scene, or 0 where that does not matter."""
    if name:
        image = bpy.data.images.get(name)
        if image is None:
            raise Refused(f"the scene has no image {name}")
        if not all(image.size):
            raise Refused(f"the image {name} has no pixels")
        is_linear = image.is_float or image.colorspace_settings.name in ("Non-Color", "Raw", "Linear")
        pixels = _pixels(image)
        return _encoded(pixels) if is_linear else pixels, {"pixel_size": width / image.size[0]} if width else {}
    if not path:
        raise Refused("no picture is chosen; it must be a file, or an image of the scene")
    return bpy.path.abspath(path), {"pixel_size": width / _columns(bpy.path.abspath(path))} if width else {}


def _pixels(image) -> np.ndarray:
    """(rows, columns, 3), or (rows, columns) of a grey one, the first row at the top."""
    pixels = np.empty(image.size[0] * image.size[1] * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(image.size[1], image.size[0], image.channels)[::-1]
    return np.ascontiguousarray(pixels[..., :3] if image.channels >= 3 else pixels[..., 0])


def _encoded(linear: np.ndarray) -> np.ndarray:
    """Linear light as the sRGB that pictures are."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0) ** (1 / 2.4) - 0.055).astype(np.float32)


def _columns(path: str) -> int:
    try:
        image = bpy.data.images.load(path)
    except RuntimeError as error:
        raise Refused(str(error).strip()) from error
    columns = image.size[0]
    bpy.data.images.remove(image)
    if not columns:
        raise Refused(f"{path} is not a picture that Blender reads")
    return columns


def recipe(source: tuple, options: dict, tell) -> dict:
    """Of a bake in the picture's own colours; of true size where the picture's is known, else of features that suit the mesh."""
    pixels, reading = source
    model = solidnoise.fit(pixels, patch=options["patch"], solid=options["solid"], progress=lambda fraction: tell(fraction / 2), **reading)
    result = {"solidnoise": 2, "description": f"By example, {model.components} components",
              "surface": {"noise": "spectrum", "exemplar": model.recipe["exemplar"], "seed": options["seed"]},
              "ramp": "exemplar", "up": options["up"]}
    if "pixel_size" in reading:
        result["frequency"] = model.principal_frequency
    return result
