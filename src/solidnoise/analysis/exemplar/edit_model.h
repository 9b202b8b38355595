#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "solidnoise/analysis/exemplar/edit_spectrum.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// What of a model an edit works on.
struct EditTarget {
  GroupChoice group{};
  std::optional<int> channel{};  // none: all
  bool makes_group = false;      // where it is not there
};

// Edits the channels of a model that have the group; it may be missing in some of them. Returns whether any
// has it. The mean of the colours stays, of squares too. Throws std::invalid_argument for a channel that is
// not there; what `edit` throws.
bool edit_model(ExemplarModel& model, const EditTarget& target,
                const std::function<void(GaborSpectrum& spectrum, std::size_t channel)>& edit);

bool has_group(const GaborSpectrum& spectrum, const std::string& name);

}  // namespace solidnoise
