"""What the page of "Gabor Noise by Example" shows (Galerne, Lagae, Lefebvre, Drettakis 2012), of our own photographs."""

import pathlib

import numpy as np
import solidnoise
from PIL import Image

from papers.data import centred, columns, image
from papers.impulses import quickest

EXEMPLARS = pathlib.Path(__file__).resolve().parents[2] / "examples" / "exemplars"
NAMES = ("sand", "soil", "earth", "rock", "moss", "leaves", "wood")
SIDE = 128  # as in the paper


def photograph(name):
    """Values as they are stored."""
    return np.asarray(Image.open(EXEMPLARS / f"{name}.jpg"), float) / 255


def grey_middle(name):
    """The brightness of the middle."""
    grey = photograph(name) @ [0.2126, 0.7152, 0.0722]
    top, left = (np.array(grey.shape) - SIDE) // 2
    return grey[top:top + SIDE, left:left + SIDE]


def fit(picture, **options):
    return solidnoise.fit(picture, raw_values=True, **options)


def periodic_component(values):
    """Without the jumps from edge to edge (Moisan 2011): less the field whose Laplacian they are."""
    jumps = np.zeros_like(values)
    for axis in (0, 1):
        first, last = [slice(None)] * 2, [slice(None)] * 2
        first[axis], last[axis] = 0, -1
        difference = values[tuple(first)] - values[tuple(last)]
        jumps[tuple(first)] += difference
        jumps[tuple(last)] -= difference
    waves = sum(2 * np.cos(2 * np.pi * f) for f in np.meshgrid(*[np.fft.fftfreq(n) for n in values.shape], indexing="ij")) - 4
    waves[0, 0] = 1
    smooth = np.fft.fft2(-jumps) / waves
    smooth[0, 0] = 0
    return values - np.fft.ifft2(smooth).real


def transforms(picture):
    """Of the channels, less their means."""
    channels = np.atleast_3d(picture - picture.mean((0, 1)))
    return np.stack([np.fft.fft2(periodic_component(channels[..., c])) for c in range(channels.shape[2])])


def periodogram(picture):
    """Per square pixel, indexed as frequencies (x, y) with y upwards, as the library's."""
    density = np.abs(transforms(picture)[0]) ** 2 / picture.size
    return np.roll(density[::-1], 1, 0).T


def density_of(bands, side=SIDE):
    """The spectrum of a model's bands: Gaussians about plus and minus their frequencies, on the torus of the discrete ones."""
    f, total = np.fft.fftfreq(side), np.zeros((side, side))
    images = np.arange(-2, 3)[:, None, None]
    for band in bands:
        x, y, variance = np.array(band["components"])[:, :3].T
        along = [np.exp(-2 * np.pi * ((f[:, None] - c + images) / band["a"]) ** 2).sum(0) for c in (x, y)]
        total += variance * 2 / band["a"] ** 2 * along[0] @ along[1].T
    return (total + np.roll(total[::-1, ::-1], (1, 1), (0, 1))) / 2


def bands():
    """Figure 2: the bands of one noise, each alone."""
    recipe = fit(grey_middle("soil"), paper=True).recipe
    all_bands = recipe["exemplar"]["channels"][0]["bands"]
    power = [sum(component[2] for component in band["components"]) for band in all_bands]
    result = {"bands": {"a": np.array([band["a"] for band in all_bands]), "components": np.array([len(band["components"]) for band in all_bands]),
                        "share": np.array(power) / sum(power)}}
    for name, chosen in [("all", all_bands)] + [(str(i), [band]) for i, band in enumerate(all_bands)]:
        recipe["exemplar"]["channels"][0]["bands"] = chosen
        model = solidnoise.ExemplarModel(recipe)
        noise = solidnoise.spectrum(dims=2, exemplar=model, frequency=model.principal_frequency, seed=1)
        result |= {f"bands_{name}_spectrum": centred(density_of(chosen)), f"bands_{name}_noise": image(noise.lattice(0, 1, [SIDE, SIDE]))}
    return result


def residual(model, periodogram):
    """The distance to the periodogram, relative to its length. The model has the variance of the samples, to which its frequencies below four steps and
    the others are scaled each; here both are as near to the periodogram as may be."""
    low, others = [], []
    for band in model.recipe["exemplar"]["channels"][0]["bands"]:
        is_low = np.array([np.hypot(*component[:2]) < 4 / len(periodogram) for component in band["components"]])
        for part, chosen in ((low, is_low), (others, ~is_low)):
            if chosen.any():
                part.append({"a": band["a"], "components": np.array(band["components"])[chosen]})
    parts = np.stack([density_of(part, len(periodogram)).ravel() for part in (low, others)], 1)
    rest = parts @ np.linalg.lstsq(parts, periodogram.ravel(), rcond=None)[0] - periodogram.ravel()
    return np.linalg.norm(rest) / np.linalg.norm(periodogram)


def kappas():
    """Figure 3: ever more components."""
    grey, rows = grey_middle("soil"), []
    target = periodogram(grey)
    result = {"kappa_exemplar": grey.astype(np.float32), "kappa_periodogram": centred(target)}
    for inverse in 2 ** np.arange(1, 9):
        model = fit(grey, paper=True, kappa=1 / inverse)
        result[f"kappa_{inverse}"] = centred(density_of(model.recipe["exemplar"]["channels"][0]["bands"]))
        rows.append([inverse, model.components, residual(model, target)])
    return result | {"kappa": columns(("inverse_kappa", "components", "residual"), rows)}


def sheets():
    """Figures 4 and 5."""
    result = {}
    for name in ("sand", "moss", "wood"):
        grey = grey_middle(name)
        result[f"sheet_{name}"] = fit(grey, paper=True).sheet(grey)
    return result


def dependence(spectra, directions, covariance=None):
    """J of channels along directions (eq. 10): of the squared correlations at all distances, by Parseval's theorem, the share that is between channels.
    With the covariance of the samples the channels are scaled to unit variance."""
    channels = np.einsum("ki,ixy->kxy", directions, spectra)
    if covariance is not None:
        channels /= np.sqrt(np.einsum("ki,ij,kj->k", directions, covariance, directions))[:, None, None]
    power = np.einsum("kxy,lxy->kl", np.abs(channels) ** 2, np.abs(channels) ** 2)
    return 1 - np.trace(power) / power.sum()


def numbers():
    """Sections 5 to 8: sparseness, processor time, J."""
    result = {}
    for name in NAMES:
        picture, grey = photograph(name), grey_middle(name)
        models = {}
        seconds = [quickest(lambda: models.update({paper: fit(grey, paper=paper, fill=False, threads=1)}), 1) for paper in (True, False)]
        spectra, covariance = transforms(picture), np.cov(picture.reshape(-1, 3).T)
        axes = [channel["axis"] for channel in fit(picture, kappa=0.5, fill=False).recipe["exemplar"]["channels"]]
        directions = {"rgb": np.eye(3), "pca": np.linalg.eigh(covariance)[1].T, "independent": np.linalg.inv(np.transpose(axes))}
        result[name] = {
            "paper_components": models[True].components, "paper_sparseness": models[True].components / SIDE**2, "paper_seconds": seconds[0],
            "sparseness": models[False].components / SIDE**2, "seconds": seconds[1],
            "j": {kind: [dependence(spectra, along), dependence(spectra, along, covariance)] for kind, along in directions.items()}}
    return {"example_numbers": result}


class Atoms:
    """Pairs of Gaussians h(f - w) + h(f + w) of length 1, of widths each half of the one before down to a single frequency, on ever finer lattices."""

    def __init__(self, side):
        f = np.fft.fftfreq(side) * side
        self.side, self.transforms, self.used, self.a = side, [], [], []
        width = side // 4
        while width >= 1:
            a = width * np.sqrt(np.pi / (2 * np.log(2)))
            gaussian = np.exp(-2 * np.pi * ((f + side * np.arange(-2, 3)[:, None]) / a) ** 2).sum(0)
            atom = np.outer(gaussian, gaussian)
            self.transforms.append(np.fft.rfft2(atom / np.sqrt(2 * (atom**2).sum())))
            spacing = np.arange(side) % max(1, width // 2) == 0
            self.used.append(np.outer(spacing, spacing))
            self.a.append(a)
            width //= 2

    def synthesize(self, x):
        """Of coefficients that are the same at w and -w."""
        return np.fft.irfft2(sum(h * np.fft.rfft2(band) for h, band in zip(self.transforms, x)), (self.side, self.side))

    def correlate(self, spectrum):
        transform = np.fft.rfft2(spectrum)
        return np.stack([used * 2 * np.fft.irfft2(h * transform, (self.side, self.side)) for h, used in zip(self.transforms, self.used)])

    def norm_squared(self):
        """The largest eigenvalue, by the power method."""
        x = np.stack(self.used).astype(float)
        for _ in range(60):
            x = self.correlate(self.synthesize(x))
            length = np.linalg.norm(x)
            x /= length
        return 1.01 * length


def fit_bands(target, kappa, penalty, iterations=100):
    """Minimizes |S x - y|^2 + kappa nu_max (penalty of x) over x >= 0, along kappa = 1/2, 1/4, ... (FISTA): the numbers of Gaussians of each band, the
    widest first, above a thousandth of the largest, and the residual. The penalty is the sum of the `squared_magnitudes` of the kernels, as eq. 8 has it,
    where an atom of a band half as wide is 8 times as long; or of the `lengths` of the atoms, as the library takes it."""
    atoms = Atoms(len(target))
    ratio = np.array(atoms.a) / atoms.a[0]
    cost = (ratio**3 if penalty == "squared_magnitudes" else np.ones_like(ratio))[:, None, None]
    target = target / target.max()
    highest = (2 * atoms.correlate(target) / cost).max()
    step = 1 / (2 * atoms.norm_squared())
    x = pushed = np.zeros((len(cost), *target.shape))
    level = 0.5
    while level > 0.999 * kappa:
        momentum, pushed = 1.0, x
        for _ in range(iterations):
            gradient = 2 * atoms.correlate(atoms.synthesize(pushed) - target)
            following = (1 + np.sqrt(1 + 4 * momentum**2)) / 2
            new = np.maximum(0, pushed - step * (gradient + level * highest * cost)) * atoms.used
            pushed, x, momentum = new + (momentum - 1) / following * (new - x), new, following
        level /= 2
    # Of w and -w one counts.
    both = x > 1e-3 * x.max()
    own = both & (np.roll(np.indices(both.shape[1:])[:, ::-1, ::-1], (1, 1), (1, 2)) == np.indices(both.shape[1:])).all(0)
    return (both.sum((1, 2)) + own.sum((1, 2))) // 2, np.linalg.norm(atoms.synthesize(x) - target) / np.linalg.norm(target)


def literal():
    """Eq. 8, read in two ways."""
    target = periodogram(grey_middle("soil"))
    return {"literal": {penalty: dict(zip(("components", "residual"), fit_bands(target, 1 / 256, penalty)))
                        for penalty in ("squared_magnitudes", "lengths")}}


ITEMS = {"example_bands": bands, "example_kappas": kappas, "example_sheets": sheets, "example_numbers": numbers, "example_literal": literal}
