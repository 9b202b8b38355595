#pragma once

namespace solidnoise::papers {

// The example of Lagae et al. 2011, sections III-C and IV-B: lengths in pixels, a bandwidth of one octave.
inline constexpr double kAmplitude = 0.709645;
inline constexpr double kFrequency = 0.0625;
inline constexpr double kGaussian = 0.0443528;

}  // namespace solidnoise::papers
