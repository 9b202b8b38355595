"""What the items hand over to the pages."""

import numpy as np


def columns(names, rows):
    """Columns of numbers by their names."""
    return dict(zip(names, np.array(rows, float).T))


def image(values):
    """values[x, y] as rows from the top."""
    return np.asarray(values, np.float32).T[::-1]


def centred(density):
    """A spectrum as an image with frequency 0 in the middle."""
    return image(np.fft.fftshift(density))


def mean_of(batches):
    """Means over batches of equal size, and their standard errors."""
    batches = np.asarray(batches, float)
    return batches.mean(0), batches.std(0, ddof=1) / np.sqrt(len(batches))
