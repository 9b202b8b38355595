#pragma once

#include <string>
#include <vector>

#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/solid_spectrum.h"

namespace solidnoise {

// What a fit found, for people: several lines, and one line for a sheet.
std::string describe(const ExemplarFit<2>& fit, double seconds);
std::string describe(const ExemplarFit<3>& fit, double seconds);
std::string describe_shortly(const ExemplarFit<2>& fit, double seconds);
std::string describe_shortly(const ExemplarFit<3>& fit, double seconds);

std::string describe(const SolidExemplarFit& fit);
std::string describe_shortly(const SolidExemplarFit& fit);

// What is in a spectrum file.
std::string describe(const ExemplarModel& model);

// What is to be said of a fit, of its channels, that looks worse than it need: light that falls off from side
// to side, and a spectrum whose gap is still above the tolerance.
std::vector<std::string> warnings_of(const std::vector<SpectrumFit>& channels, double gap_tolerance);

}  // namespace solidnoise
