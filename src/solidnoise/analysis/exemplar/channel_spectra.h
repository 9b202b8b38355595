#pragma once

#include <vector>

#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/exemplar_channels.h"
#include "solidnoise/analysis/periodogram.h"

namespace solidnoise {

// By which each channel's spectrum is taken from the colours' cross-spectra, for CrossSpectra::weighted.
// Independent channels of spectra S_k make sum of S_k(f) a_k a_k^T out of the colours' cross-spectra C(f):
// these are at each frequency the nearest to it (in the sum of squares) that have the same power of all
// colours together. They are linear in C and so exact at the samples' covariance; the spectra along the
// channels' directions would leave out what channels share at f, and with axes that are not orthogonal the
// colours' power would be off by up to three times at frequencies of little power. A single periodogram's
// scatter may make values negative.
std::vector<std::vector<double>> channel_weights(const ExemplarChannels& channels);

template <int Dim>
std::vector<PowerSpectrum<Dim>> channel_spectra(const CrossSpectra<Dim>& spectra,
                                                const ExemplarChannels& channels);

}  // namespace solidnoise
