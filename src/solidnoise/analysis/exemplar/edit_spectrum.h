#pragma once

#include <optional>
#include <string>

#include "solidnoise/core/vec.h"
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

// The components that an operation works on: those of one group, or all. Operations leave the order of bands
// and components as it is, drop bands that become empty, and throw std::invalid_argument for a group that is
// not there and for a result that GaborSpectrum::validate refuses. Factors are between 1e-9 and 1e9.
using GroupChoice = std::optional<std::string>;

// The number of a group. Throws std::invalid_argument that lists the names there are.
int find_group(const GaborSpectrum& spectrum, const std::string& name);

// Turns frequencies by `degrees`, counterclockwise as seen from the tip of `axis` (in 2D always the third).
// Isotropic spectra are refused.
void rotate_group(GaborSpectrum& spectrum, const GroupChoice& group, double degrees,
                  const Vec<3>& axis = Vec<3>(0.0, 0.0, 1.0));
// Multiplies frequencies; the bandwidths stay.
void scale_group(GaborSpectrum& spectrum, const GroupChoice& group, double factor);
// Adds to frequencies, cycles per world unit (w, and with it -w the other way). Isotropic spectra are
// refused.
void translate_group(GaborSpectrum& spectrum, const GroupChoice& group, const Vec<3>& by);
// Multiplies amplitudes K, that is variances by the square; 0 is allowed.
void scale_magnitude(GaborSpectrum& spectrum, const GroupChoice& group, double factor);
// Multiplies bandwidths a, keeping variances.
void scale_bandwidth(GaborSpectrum& spectrum, const GroupChoice& group, double factor);
// Takes a group's components away.
void remove_group(GaborSpectrum& spectrum, const std::string& group);
// Adds a component, in a group that is made if it is not there.
void add_component(GaborSpectrum& spectrum, double a, SpectrumComponent component, const std::string& group);
// Adds the components of a group (or all, each with its own group's name) of another spectrum of the same
// kind. Groups of the same name are merged.
void copy_group(GaborSpectrum& spectrum, const GaborSpectrum& from, const GroupChoice& group);
// Which components, by their frequencies.
struct ComponentSelection {
  double from = 0.0;  // cycles per world unit, >= 0
  double to = 0.0;    // and below this
  double direction =
      0.0;  // degrees counterclockwise from the first axis; either sign of a frequency is the same
  double spread = 180.0;  // how far from it at most, degrees, 0 to 180: 90 and more are all directions
};
// Puts these components, of a group or of all, into a group that is made if it is not there, and gives their
// number: one channel of several may have none. Throws std::invalid_argument also for directions of isotropic
// or 3D spectra.
int select_group(GaborSpectrum& spectrum, const GroupChoice& within, const ComponentSelection& selection,
                 const std::string& name);
// Gives a group another name; the components join the group of that name if there is one.
void rename_group(GaborSpectrum& spectrum, const std::string& group, const std::string& name);

}  // namespace solidnoise
