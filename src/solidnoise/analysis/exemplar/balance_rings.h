#pragma once

#include <vector>

#include "solidnoise/analysis/exemplar/exemplar_channels.h"

namespace solidnoise {

// The powers that independent channels have in rings of frequencies so that the colours that they make look
// as sharp as an exemplar's. `cross`: the exemplar's cross-powers in each ring, channels x channels. What
// channels of powers v_k make of colours, sum over k of v_k a_k a_k^T with the axes a_k, can have any one of
// these matrices' diagonals, but not all of it; it is held to six powers, of red, green, blue, luminance, and
// of red against green and blue against yellow, which an eye sees less of, and a little to those along the
// channels' directions, by which powers go evenly from ring to ring. The sum over rings and powers, M made
// and T wanted, of
//   w (M/T + T/M - 2)
// is least among all v_k >= 0 that sum up to the channels' variances, by which the covariance of colours
// stays the exemplar's. What rings are short of is wanted in the lowest as far as it is trends, which a
// window hides, else in all of them. Returns a list of rings for each channel.
std::vector<std::vector<double>> balance_rings(const std::vector<std::vector<double>>& cross,
                                               const ExemplarChannels& channels);

}  // namespace solidnoise
