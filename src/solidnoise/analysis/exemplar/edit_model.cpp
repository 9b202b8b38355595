#include "solidnoise/analysis/exemplar/edit_model.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "solidnoise/core/check.h"

namespace solidnoise {

bool has_group(const GaborSpectrum& spectrum, const std::string& name) {
  return std::ranges::find(spectrum.groups, name) != spectrum.groups.end();
}

bool edit_model(ExemplarModel& model, const EditTarget& target,
                const std::function<void(GaborSpectrum&, std::size_t)>& edit) {
  if (target.channel) {
    require_in_range("channel", *target.channel, 0, static_cast<double>(model.channels.size()) - 1,
                     "of the model");
  }
  const Vec<3> before = model.variances();
  bool edited = false;
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    if (target.channel && *target.channel != static_cast<int>(k)) continue;
    if (target.group && !target.makes_group && !has_group(model.channels[k], *target.group)) continue;
    edited = true;
    edit(model.channels[k], k);
  }
  if (model.squares) {
    const Vec<3> square = model.mean * model.mean + before - model.variances();
    model.mean = glm::sqrt(glm::max(square, Vec<3>(0.0)));
  }
  return edited;
}

}  // namespace solidnoise
