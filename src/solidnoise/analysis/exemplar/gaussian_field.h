#pragma once

#include <cstdint>
#include <span>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// The periodic component of a field that is not periodic (Moisan 2011): what remains when the smooth field
// that carries the jumps across opposite borders is taken away, so that its Fourier transform has no cross of
// the borders' making. With v the jumps at the borders, the smooth field is
//   s^(k) = v^(k) / sum over axes of (2 cos(2 pi k_axis / n_axis) - 2),   s^(0) = 0.
// The mean stays; the variance can go either way. Every axis has one sample or more.
template <int Dim>
DenseField<Dim> periodic_component(const DenseField<Dim>& field);

// A density on the frequencies of a periodogram: that of the spectrum and, as samples fold it, of its images
// beyond the highest frequency of the samples, which isotropic ones are taken to have none of.
template <int Dim>
PowerSpectrum<Dim> sampled_density(const GaborSpectrum& spectrum, const glm::vec<Dim, int>& count,
                                   const Vec<Dim>& step);

// The Gaussian version of an exemplar (random phase noise; Galerne, Gousseau and Morel 2011): the moduli of
// its periodic components' transforms are kept, random phases are added, the same for all channels. It is
// periodic, has the exemplar's mean, spectra and cross-spectra, and nothing else of it: what noise can show
// at best.
template <int Dim>
Exemplar<Dim> gaussian_version(const Exemplar<Dim>& exemplar, std::uint64_t seed);

// A periodic Gaussian field with a given spectrum.
template <int Dim>
DenseField<Dim> gaussian_field(const PowerSpectrum<Dim>& spectrum, std::uint64_t seed);

// The Gaussian texture of a model, per color channel: its sparse spectra without anything of the impulses
// that a noise is made of.
Exemplar<2> gaussian_texture(const ExemplarModel& model, const glm::ivec2& count, const Vec<2>& step,
                             std::uint64_t seed);

// Colours from the values of a model's channels.
Exemplar<2> compose(const ExemplarModel& model, std::span<const DenseField<2>> channels);

}  // namespace solidnoise
