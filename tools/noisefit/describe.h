#pragma once

#include <string>

#include "solidnoise/analysis/exemplar/fit_exemplar.h"

namespace solidnoise {

// What a fit found, for people: several lines, and one line for a sheet.
std::string describe(const ExemplarFit<2>& fit, double seconds);
std::string describe_shortly(const ExemplarFit<2>& fit, double seconds);

// What is in a spectrum file.
std::string describe(const ExemplarModel& model);

}  // namespace solidnoise
