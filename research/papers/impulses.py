"""Sums over impulses as the papers define them and as the papers go about them, in NumPy."""

import itertools
import time

import numpy as np
from scipy.spatial import cKDTree

from papers.gabor import ball, nodes


def sparse_sum(points, places, reach, term):
    """Sparse convolution as it is defined: of each point, the sum over the places within reach of term(distances, numbers of the points, and
    of the places)."""
    near = np.flatnonzero(((places > points.min(0) - reach) & (places < points.max(0) + reach)).all(1))
    tree = cKDTree(places[near])
    sums = np.zeros(len(points))
    for first in range(0, len(points), 20000):
        pairs = cKDTree(points[first:first + 20000]).sparse_distance_matrix(tree, reach, output_type="ndarray")
        i = pairs["i"] + first
        sums += np.bincount(i, term(pairs["v"], i, near[pairs["j"]]), len(points))
    return sums


class CellGenerators:
    """A 32-bit linear congruential generator for each of many cells."""

    def __init__(self, cells, seed):
        self.state = np.full(len(cells), seed, np.uint32)
        for coordinate in cells.T:
            self.state = self.state * np.uint32(0x9E3779B1) + coordinate.astype(np.uint32)
        for shift, factor in ((16, 0x7FEB352D), (15, 0x846CA68B), (16, 1)):
            self.state = (self.state ^ (self.state >> np.uint32(shift))) * np.uint32(factor)

    def next(self):
        """Uniform on [0, 1)."""
        self.state = self.state * np.uint32(1664525) + np.uint32(1013904223)
        return (self.state >> np.uint32(8)) * 2.0**-24

    def poisson(self, mean):
        """As many uniform numbers as keep their product above exp(-mean)."""
        count, product = np.zeros(len(self.state), int), self.next()
        while (going := product > np.exp(-mean)).any():
            state = self.state
            product = np.where(going, product * self.next(), product)
            self.state = np.where(going, self.state, state)
            count += going
        return count


def procedure(kernel, points, radius, impulses, seed):
    """The papers' procedure (Lagae et al. 2009, section 4): the 3^n cells around a point each make their impulses, and those nearer than the
    radius, which is the side of a cell, are summed. `impulses` are within the radius on average; the variance is 1 (Campbell)."""
    n, mean = kernel.n, impulses / ball(kernel.n)
    cells = np.floor(points / radius).astype(np.int64)
    fractions = points / radius - cells
    sums = np.zeros(len(points))
    for step in itertools.product((-1, 0, 1), repeat=n):
        generators = CellGenerators(cells + step, seed)
        counts = generators.poisson(mean)
        for i in range(counts.max()):
            offsets = fractions - step - np.stack([generators.next() for _ in range(n)], 1)
            marks = kernel.draw(generators.next)
            inside = np.flatnonzero((i < counts) & ((offsets**2).sum(1) < 1))
            sums[inside] += kernel.term(offsets[inside] * radius, [mark[inside] for mark in marks])
    r, weights = nodes(n, 0, radius)
    return sums / np.sqrt(mean / radius**n * (weights @ kernel.mean_square(r)))


def quickest(run, times=3):
    """Processor seconds of the quickest of some runs: other programs that run at the time matter less than to the time on the wall."""
    best = np.inf
    for _ in range(times):
        begin = time.process_time()
        run()
        best = min(best, time.process_time() - begin)
    return best
