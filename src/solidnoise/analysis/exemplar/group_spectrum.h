#pragma once

#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// Sorts a spectrum's components into the parts of a Wold decomposition (Francos et al. 1993; Galerne et al.
// 2012, section 8), to be edited as groups:
//   stochastic     what is in no other group;
//   anisotropic    (then "anisotropic 2", ...) components in a direction that holds much more than its share;
//   periodic       single narrow peaks, well away from frequency 0 and above all that surrounds them.
// A guide for people, not a decomposition in the strict sense. Isotropic and 3D spectra have no anisotropic
// groups here. Groups that were there before are dropped; empty ones are left out.
GaborSpectrum group_spectrum(GaborSpectrum spectrum);

}  // namespace solidnoise
