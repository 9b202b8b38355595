#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// The colour spaces in which channels may be made independently of each other.
enum class ColorAxes {
  rgb,          // as they are
  pca,          // principal axes: uncorrelated at the same point
  independent,  // as uncorrelated as possible at all distances
};

// Three vectors.
using AxisMatrix = std::array<Vec<3>, 3>;

// The axes of an exemplar of three channels, of unit length, the one of largest variance first, each with a
// positive sum: color = mean + sum over k of axes[k] n_k. With channels n_k that do not depend on each other
// the covariance of the colours is the exemplar's, exactly, but for `rgb`: its axes are no more than the
// colours'. `independent` first makes the covariance of the samples that of white noise; what is free then, a
// rotation, is the approximate joint diagonalisation of all lagged correlation matrices (Galerne et al. 2012,
// section 7) by real Jacobi rotations (Cardoso and Souloumiac 1996), begun at the principal axes, so that it
// never does worse than these. It works on the cross-periodograms, whose sums of squares are those of the
// lagged matrices by Parseval's theorem, and divides each by the mean power of its ring of frequencies where
// that leaves the channels no more dependent (J, below) than the principal axes do: pictures have nearly all
// of their power at the lowest frequencies, whose colours need not be those of fine detail. The paper rotates
// the colours themselves: its axes are orthogonal, and cannot leave the channels uncorrelated at the same
// point and nearly so at others, too (covariances were off by up to a third).
template <int Dim>
AxisMatrix color_axes(const CrossSpectra<Dim>& spectra, ColorAxes axes);

// The directions by which channels are taken from colours: of the axes' inverse, n_k = directions[k].(color -
// mean).
AxisMatrix channel_directions(const AxisMatrix& axes);

// How much the channels along these directions depend on each other, 0 to 1: the squared off-diagonal
// elements of all lagged correlation matrices, in proportion to all elements (the paper's J, eq. 10), of
// channels that are scaled to unit variance: that of the paper depends on the scale of the colours, and a
// channel that is much stronger hides the others.
template <int Dim>
double channel_dependence(const CrossSpectra<Dim>& spectra, const AxisMatrix& directions);

// How much channels depend on each other in the three colour spaces (channel_dependence).
struct ColorDependence {
  double rgb = 0.0;
  double pca = 0.0;
  double independent = 0.0;
};

// The channels that an exemplar's noise is to be made of: those along the axes of a colour space, or the one
// of a grey exemplar, with the axis (1, 1, 1).
struct ExemplarChannels {
  std::vector<std::vector<double>> directions;  // for CrossSpectra::spectrum
  std::vector<double> variances;                // of the samples along them: of what they give to the colours
  std::vector<Vec<3>> axes;                     // of the model
  Vec<3> mean{0.0};
  // Of the samples' covariance, what patches' periodic components are without, and what patches' means have.
  std::vector<double> trends;
  std::optional<ColorDependence> dependence;  // of exemplars in colour

  double total_variance() const;
  // Whether there is anything in a channel: the colours of an exemplar may lie in a plane.
  bool is_empty(std::size_t channel) const;
  // A spectrum that stands for a channel without anything: a millionth of a billionth of all variance.
  GaborSpectrum empty_spectrum(int dimensions, double sample_step) const;
};

template <int Dim>
ExemplarChannels exemplar_channels(const CrossSpectra<Dim>& spectra, ColorAxes axes);

}  // namespace solidnoise
