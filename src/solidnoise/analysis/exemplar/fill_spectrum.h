#pragma once

#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// Adds what a sparse fit leaves out of a spectrum in two dimensions. The squared error that it minimises is
// that of the strong, low frequencies; of a natural texture's fine detail, a thousand times weaker but spread
// over most frequencies, it keeps little. Here Gaussians of a quarter of their frequency's octave in width,
// on a grid in each octave, get the variances v that maximise the likelihood of the periodogram P as counts,
//   v_k <- v_k sum of D_k P / M over the frequencies,   M = the spectrum + sum of v_k D_k,   sum of D_k = 1
// (Richardson 1972, Lucy 1974): then P / M is 1 on average under each of them, in every octave alike.
// Those that the periodogram's own likelihood (Whittle 1953) hardly misses are left out, by the criterion of
// Akaike 1974, little by little, as the others take over. Frequencies are those that the bands of `a` can
// tell apart: down to two steps of the periodogram.
void fill_spectrum(GaborSpectrum& spectrum, const PowerSpectrum<2>& periodogram);

}  // namespace solidnoise
