"""The statements of docs/papers/noise-by-example.md, on an exemplar whose spectrum is known, and the spectra that the page computes against the library's."""

import numpy as np
import pytest
from papers.noise_by_example import density_of, dependence, fit, fit_bands, periodic_component, residual, transforms

WIDTHS = np.sqrt(np.pi / (2 * np.log(2))) * 0.5 ** np.array([2, 3, 4])
BANDS = [{"a": a, "components": components} for a, components in zip(WIDTHS, (
    [[0.10, 0.05, 1.0]], [[0.25, -0.20, 0.5], [0.05, 0.30, 0.3]], [[0.18, 0.18, 0.2]]))]


@pytest.fixture(scope="module")
def field():
    """One realisation of a sum of four Gaussians of three widths, 64 x 64 samples, indexed x, y."""
    noise = np.fft.fft2(np.random.default_rng(1).normal(size=(64, 64)))
    return np.fft.ifft2(np.sqrt(density_of(BANDS, 64)) * noise).real


@pytest.fixture(scope="module")
def periodogram(field):
    return np.abs(np.fft.fft2(field)) ** 2 / field.size


def test_the_density_has_the_variance_of_its_components():
    assert abs(density_of(BANDS, 64).sum() / 64**2 - 2.0) < 1e-6  # Gaussians are wider than the lattice's steps


def test_equation_8_taken_literally_uses_the_narrowest_band_alone(periodogram):
    components, _ = fit_bands(periodogram, 1 / 64, "squared_magnitudes", 60)
    assert len(components) == 5 and not components[:4].any() and components[4] > 100


def test_atoms_of_unit_length_use_the_bands_of_the_spectrum(periodogram):
    components, _ = fit_bands(periodogram, 1 / 8, "lengths", 60)
    assert components[0] > 0 and components[1] + components[2] > 0


def test_smaller_kappas_are_nearer_to_the_periodogram_and_less_sparse(field, periodogram):
    last_residual, last_components = 1.0, 0
    for kappa in (1 / 2, 1 / 8, 1 / 32, 1 / 256):
        model = fit(np.ascontiguousarray(field.T[::-1]), paper=True, kappa=kappa)
        periodic = np.abs(np.fft.fft2(periodic_component(field))) ** 2 / field.size
        found = residual(model, periodic)
        assert found < last_residual and model.components >= last_components
        last_residual, last_components = found, model.components
    assert last_residual < 0.25, "the frequencies are the library's, in sign and order"


def test_what_repeats_is_its_own_periodic_component():
    x = np.arange(32)
    wave = np.cos(2 * np.pi * (3 * x[:, None] + 5 * x) / 32)
    # Neighbours across the edge differ as others do: what is taken away is of that size at the edge, and small.
    assert np.abs(periodic_component(wave) - wave).max() < 0.5
    ramp = np.broadcast_to(x / 31, (32, 32))
    assert np.abs(periodic_component(ramp)).std() < 0.5 * ramp.std()


def test_dependence_is_between_none_and_all():
    """Channels of disjoint bands share nothing; copies of one channel share two thirds of nine equal numbers."""
    x = np.arange(64) / 64
    waves = [np.broadcast_to(np.cos(2 * np.pi * k * x), (64, 64)) for k in (3, 7, 12)]
    disjoint, copies = (np.stack(channels).transpose(1, 2, 0) for channels in (waves, [waves[0]] * 3))
    spectra = np.stack([np.fft.fft2(disjoint[..., c]) for c in range(3)])
    assert dependence(spectra, np.eye(3)) < 1e-12
    assert abs(dependence(transforms(copies), np.eye(3)) - 2 / 3) < 1e-9
