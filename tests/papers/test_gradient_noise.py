"""The numbers of docs/papers/gradient-noise.md, by smaller runs of the code that makes the page: a full repetition of the tables, at half of its samples.
Seeds are fixed."""

import numpy as np
import pytest
from papers.gradient_noise import library_noise, low_share, plane_variance, sample, spectrum, striation
from papers.gradients import PUBLISHED, kensler, power_spectrum, variance, zero_dc


def spectrum_of(kind):
    return spectrum(kind, sample(kind, side=512, step=0.5), step=0.5)


def test_the_classic_hash_leaves_stripes_and_the_exclusive_or_none():
    """A line of 512 frequencies, half of which hold the power and are each other's opposites in part, scatters by some 1 / sqrt(2 * 128) = 0.06."""
    classic, exclusive_or = spectrum_of("a"), spectrum_of("b")
    assert striation(classic, 0) > 0.3
    assert max(striation(classic, 1), striation(exclusive_or, 0), striation(exclusive_or, 1)) < 0.1


@pytest.mark.parametrize("n", [1, 2, 3, 4])
@pytest.mark.parametrize("kernel", ["kensler", "zero-dc"])
def test_the_library_has_the_closed_form(n, kernel):
    coefficients = zero_dc(n) if kernel == "zero-dc" else PUBLISHED
    f = np.linspace(0, 1.5, 200)
    places = np.zeros((200, n))
    places[:, 0] = f
    model = power_spectrum(n, f, coefficients) / variance(n, coefficients)
    np.testing.assert_allclose(library_noise(n, kernel, 1).power_spectrum(places), model, rtol=1e-6, atol=1e-6)


def test_the_wide_kernel_has_the_closed_forms_variance_and_peak():
    """The variance of 65536 gradients' noise has a standard error of about 0.5 %."""
    wide = spectrum_of("c")
    assert abs(wide.variance() - 1) < 0.03
    f = np.linspace(0.1, 1, 1000)
    assert abs(low_share(wide)[0] - f[np.argmax(power_spectrum(2, f))]) < 0.06, "bins are 0.05 wide"


def test_projection_empties_the_middle_of_a_slices_spectrum():
    """Power below a quarter of the peak, by quadrature of the closed forms 0.0014 and 4.2e-5 in two dimensions. A plane through three dimensions has two orders of
    magnitude more, and projection takes it away again."""
    share = {kind: low_share(spectrum_of(kind))[1] for kind in ("c", "d", "e", "c_zero_dc")}
    assert abs(share["c"] - 0.0014) < 0.0005 and abs(share["e"] - 0.0014) < 0.0005
    assert share["d"] > 0.02 and share["c_zero_dc"] < 1e-4


def test_half_resolution_as_printed_vanishes_between_the_layers():
    """Means of the closed form over positions are 0.0125 in a layer and half-way between the layers 0, or, with the wider window, a half of it. Of one seed they
    scatter by 5 %, as a table has 256 gradients, and so does the ratio by 0.05: over 16 seeds by a quarter of that."""
    assert plane_variance(2, 1.0, 1.0) == 0 and plane_variance(2, 0.0, 1.0) > 0.01
    in_layer, between = plane_variance(2, 0.0, 2.0), plane_variance(2, 1.0, 2.0)
    assert abs(in_layer - 0.0127) < 0.0015
    assert abs(between / in_layer - 0.5) < 0.065, "5.2 standard errors"


def test_the_pseudocode_has_the_closed_forms_variance():
    """Over 64^3 lattice points' gradients, of which a table has 256: their mean square is exactly 1, and the noise's within some 2 %; the stencil of 4 leaves out 0.8 % of
    the terms."""
    points = np.random.default_rng(3).uniform(0, 64, (50000, 3))
    assert abs(np.mean(kensler(points, 1) ** 2) / variance(3) - 1) < 0.06
