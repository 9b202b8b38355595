"""Procedural noise with a known spectrum, from Python.

Noise at points and on lattices, as NumPy arrays:

    import solidnoise
    noise = solidnoise.gabor(frequency=4, octaves=3, seed=7)
    noise([[0.0, 0.5, 1.0], [2.0, 0.0, 0.0]])                  # two values
    noise.lattice(origin=0, step=0.02, shape=(64, 64, 64))     # values[x, y, z]
    noise.power_spectrum([4.0, 0.0, 0.0])                      # in closed form

The kinds of noise are gabor(), gabor_oriented(), kensler(), cellular() and, by example, spectrum(), in 1 to 4 dimensions.

Field(recipe) is what a recipe fills voxels with, layers and all, at points and on lattices.

Recipes are plain dicts, the JSON that vdbnoise, meshnoise and noisefit read and write; a path of such a file will do, too, and keywords
change a recipe's keys. presets() lists those that come with the package, and preset(NAME) is one: of a volume, or of a
bake, where there is none of a volume or by preset(NAME, "bake").

Lengths are in world units, frequencies in cycles per world unit. Arrays of a lattice or of voxels are indexed x, y, z, as OpenVDB's
are, with the last axis the fastest; components of vectors, colours and gradients are the last axis. The same recipe gives the same
values, to the last bit, as the programs do, for any number of threads.

Everything that takes long leaves the interpreter free for other threads and stops at Ctrl-C with nothing left behind; most of it takes
threads= and progress=, a function of the fraction that is done. Options that are not allowed raise ValueError, files that cannot
be read or written OSError, in one line that says what is allowed; what is of another type than it must be raises TypeError.
"""

from . import _solidnoise
from ._presets import preset, presets
from ._solidnoise import *

__all__ = ["preset", "presets"]
__all__ += _solidnoise.__all__
