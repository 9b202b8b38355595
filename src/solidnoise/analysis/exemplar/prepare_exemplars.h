#pragma once

#include <vector>

#include "solidnoise/analysis/exemplar/exemplar.h"

namespace solidnoise {

// Brightness as an eye weighs the colours of linear light, in place of these.
void make_grey(Exemplar<2>& exemplar);

// Gives all exemplars as many channels: one picture in colour makes all of them so.
void agree_on_channels(std::vector<Exemplar<2>>& exemplars);

}  // namespace solidnoise
