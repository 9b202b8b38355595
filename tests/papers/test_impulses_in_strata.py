"""The numbers of docs/papers/impulses-in-strata.md, by smaller runs of the code that makes the page. Seeds are fixed."""

import numpy as np
import pytest
from papers.data import mean_of
from papers.gabor import a_of
from papers.impulses_in_strata import closed_at_place, fourth_moments, measure_windows
from papers.strata import Cumulants, Overlap, beyond, kernel_of, library
from papers.strata_ensembles import measure_elsewhere, measure_ensemble, measure_spectra


def test_estimates_have_the_error_of_their_mean():
    value, error = mean_of([1.0, 2.0, 3.0, 6.0])
    assert value == 3 and abs(error - np.sqrt(14 / 12)) < 1e-12


@pytest.mark.parametrize("n", [1, 2, 3, 4])
@pytest.mark.parametrize("kind", [0, 1])
def test_the_library_has_the_closed_forms_again(n, kind):
    """The excess kurtosis in cubes: ours is a Gauss sum of 20 nodes an axis, within 1e-3 of Poisson's, below 0.7; and the Poisson process' own, exactly, but for the
    library's compact kernel, whose fourth moment is that of an error of 0.02."""
    overlap = Overlap(n, kind)
    for poisson in (False, True):
        noise = library(n, kind, poisson=poisson)
        density = noise.description["impulse_density"]
        side, _, mirrored = overlap.cubes(density)
        share = 1.0 if poisson else overlap.share(side, mirrored)
        closed = share * overlap.kernel.fourth / (density * overlap.kernel.energy**2)
        assert abs(noise.excess_kurtosis - closed) < 0.02


def test_ensembles_have_the_moments_of_the_closed_form():
    """Of 40 seeds: five standard errors, which are some 0.002 of the variance and 0.02 of the kurtosis."""
    strata, poisson = (measure_ensemble(2, 1, process, 40) for process in (False, True))
    for found, closed, more in ((strata, 0.0, 0.01), (poisson, library(2, 1, poisson=True).excess_kurtosis, 0.0)):
        values, errors = found
        assert abs(values[1] - 1) < 5 * errors[1]
        assert abs(values[2] - closed) < 5 * errors[2] + more
    assert poisson[0][4] > 3 * strata[0][4]


def test_the_sixth_cumulant_is_that_of_the_closed_form():
    """Of one impulse in each cube in 1D, far from Gaussian: 200 seeds, five standard errors. The lattice's sums have the fourth cumulant of the other rule within 0.001."""
    density = library(1, 0).description["impulse_density"]
    side = 1 / (0.25 * density)
    fourth, sixth = Cumulants(1, 0)(side, 1)
    overlap = Overlap(1, 0)
    assert abs(fourth - overlap.share(side) * overlap.kernel.fourth / (0.25 * density * overlap.kernel.energy**2)) < 1e-3
    options = {"impulses": 0.25 * library(1, 0).description["impulses_per_kernel"]}
    values = np.stack([library(1, 0, seed, **options).lattice(0, 0.73, [4096]) for seed in range(200)]).astype(float)
    values /= np.sqrt(np.mean(values**2))
    found, error = mean_of(np.mean(values**6 - 15 * values**4 + 30 * values**2, 1).reshape(20, 10).mean(1))
    assert abs(found - sixth) < 5 * error and error < 0.1 and abs(sixth) > 1


@pytest.mark.parametrize("n, kind, mirrored, ratio, sixth, tail", [(2, 1, False, 1, 0.18, None), (3, 1, False, 1, 0.64, 1.25), (4, 1, False, 1, 1.02, None),
                                                                   (3, 1, True, 0.71, 0.15, None), (4, 1, True, 0.54, 0.62, 1.11), (3, 0, True, 0.83, None, 0.93),
                                                                   (4, 0, True, 0.69, None, 1.31)])
def test_cumulants_of_balanced_cubes(n, kind, mirrored, ratio, sixth, tail):
    """With one impulse or one pair in each, the figures of src/solidnoise/noise/kernel/impulse_strata.h: the density over that of independent impulses, of the cube of the
    variance times (a^n / density)^2, and past four standard deviations."""
    overlap, a = Overlap(n, kind), a_of(1.0)
    side, count = overlap.balanced(mirrored), 2 if mirrored else 1
    assert abs(count * (overlap.balanced(False) / side) ** n - ratio) < 0.01
    found = Cumulants(n, kind)(side, count, mirrored)
    assert abs(found[0]) < 2e-3
    assert sixth is None or abs(found[1] * (count / (a * side) ** n) ** 2 - sixth) < 0.01
    assert tail is None or abs(beyond(4, *found) - tail) < 0.01


@pytest.mark.parametrize("n, kind, octaves, count, tail", [(2, 0, 0.5, 1, 0.72), (2, 0, 2, 3, 0.975), (3, 0, 0.3, 2, 1.08), (3, 0, 0.5, 2, 0.96), (3, 0, 1.4, 2, 1.115),
                                                           (3, 0, 2, 4, 1.055), (4, 0, 0.5, 2, 1.185), (4, 0, 2, 2, 1.43), (4, 1, 1, 2, 1.27)])
def test_tails_of_what_the_library_takes(n, kind, octaves, count, tail):
    """Past four standard deviations: in balanced cubes, or, where these take more impulses than a Poisson process of excess kurtosis 1/2, in larger ones of 0.02."""
    noise, overlap = library(n, kind, bandwidth=octaves), Overlap(n, kind, octaves)
    mirrored = n > 2 + kind
    side = (count / noise.description["impulse_density"]) ** (1 / n)
    many = (2 if mirrored else 1) / overlap.balanced(mirrored) ** n > 2 * overlap.kernel.fourth / overlap.kernel.energy**2
    assert many == (side > 1.02 * overlap.balanced(mirrored))
    assert 0.015 < noise.excess_kurtosis < 0.02 if many else abs(noise.excess_kurtosis) < 0.005
    assert abs(beyond(4, *Cumulants(n, kind, octaves)(side, count, mirrored)) - tail) < 0.01


def test_the_cumulants_of_mirrored_impulses_are_those_of_the_closed_form():
    """Of noise by its definition on a line, far from Gaussian: 2 400 000 values, five standard errors. Independent impulses have others."""
    kernel, side, random = kernel_of(1, 0), 1.0, np.random.default_rng(7)
    batches = []
    for _ in range(240):
        shift, places = random.uniform(0, 1, (10000, 1)), random.uniform(0, 1, (10000, 14))
        cubes = np.arange(-7, 7)
        values = sum(random.choice((-1, 1), places.shape) * kernel.value(np.abs(side * (cubes + shift + at))) for at in (places, 1 - places)).sum(1)
        values /= np.sqrt(2 / side * kernel.energy)
        batches.append([np.mean(values**4) - 3, np.mean(values**6 - 15 * values**4) + 30])
    found, error = mean_of(np.array(batches))
    closed, others = Cumulants(1, 0)(side, 2, True), Cumulants(1, 0)(side, 2)
    assert (np.abs(found - closed) < 5 * error).all() and (np.abs(found - others) > 10 * error).all()


def test_tails_are_those_of_a_gaussian_without_cumulants_and_grow_with_them():
    assert beyond(4, 0, 0) == 1
    # 9.2 and 2.6, the share's derivatives at 4.
    assert abs(beyond(4, 1e-6, 0) - 1 - 9.2e-6) < 1e-7 and abs(beyond(4, 0, 1e-6) - 1 - 2.6e-6) < 1e-7
    assert abs(beyond(4, 0.1, 0) - 1 - 0.91555 - 0.0433) < 1e-4


@pytest.mark.parametrize("name", ["surface, varying", "oriented, varying", "solid, varying", "by example, 2D", "four octaves, 3D isotropic kernels",
                                  "four octaves, 4D random directions"])
def test_noises_on_surfaces_by_example_and_in_octaves_are_as_near_to_gaussian(name):
    """Of 40 seeds: five standard errors."""
    values, errors = measure_elsewhere(name, 40)
    assert abs(values[1] - 1) < 5 * errors[1] and errors[1] < 0.01
    assert abs(values[2]) < 0.02 + 5 * errors[2] and errors[2] < 0.02
    assert abs(values[3] / 0.0027 - 1) < 0.1 + 5 * errors[3] / 0.0027


@pytest.mark.parametrize("kind", [0, 1])
def test_spectra_are_those_of_the_poisson_process(kind):
    """Of 40 seeds, seven bands: exceeded once in 10000."""
    values, errors = measure_spectra(2, kind, 40)
    assert (np.abs(values - 1) < 5.2 * errors).all() and (errors < 0.04).all()


def test_windows_are_more_alike_than_those_of_a_poisson_process():
    """Errors are some 4 % of windows of four radii."""
    strata, poisson = (measure_windows(1, process, 20) for process in (False, True))
    assert len(strata) == 5 and strata[2][0] == 4
    assert strata[2][1] < 1.15 and poisson[2][1] > 1.6


@pytest.mark.parametrize("kind", [0, 1])
def test_the_excess_kurtosis_given_the_place_is_the_closed_form(kind):
    """In a simulation of 16 parts that shares nothing with the library: in the planes' middle and between two of them."""
    density = library(2, kind).description["impulse_density"]
    side = Overlap(2, kind).cubes(density)[0]
    place = np.array([0.02, 0.5])
    random = np.random.default_rng(5)
    measured, error = mean_of([fourth_moments(kind, density, side, place, random, along=200) - 3 for _ in range(16)])
    closed = closed_at_place(kind, density, side, place)
    assert (np.abs(measured - closed) < 5.2 * error).all(), "exceeded once in 10000"
    assert (error < 0.04).all() and closed[0] - closed[1] > 0.15
