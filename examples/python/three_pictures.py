"""three_pictures.py OUT.png: a landscape lit by the noise's own gradient, a volume's preview, and a texture learned from a photograph."""

import sys
from typing import Any

import numpy as np
import numpy.typing as npt
import solidnoise

SIDE = 480
Picture = npt.NDArray[np.floating[Any]]


def landscape() -> Picture:
    """Hills, each pixel lit by the slope that comes with the value."""
    noise = solidnoise.gabor(dims=2, frequency=2, octaves=6, gain=0.42, seed=11)
    height, slope = noise.lattice(origin=0, step=2.5 / SIDE, shape=(SIDE, SIDE), gradient=True)
    normal = np.concatenate([-0.028 * slope, np.ones((SIDE, SIDE, 1))], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    light = np.clip(normal @ np.array([-0.5, 0.6, 0.62]), 0.05, 1.0)
    level = np.clip((height + 2.0) / 4.0, 0.0, 1.0)[..., None]
    color = (1 - level) * np.array([0.32, 0.42, 0.30]) + level * np.array([0.93, 0.90, 0.85])
    return np.rot90(color * light[..., None])  # from x, y to rows from the top


def smoke() -> Picture:
    return solidnoise.make_volume(solidnoise.preset("smoke"), dim=160, noise={"seed": 7}).preview()


def earth() -> Picture:
    model = solidnoise.fit("examples/exemplars/earth.jpg")
    linear = np.clip(model.texture((SIDE, SIDE), pixel_size=0.4), 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


solidnoise.write_image(sys.argv[1], np.concatenate([landscape(), smoke(), earth()], axis=1))
