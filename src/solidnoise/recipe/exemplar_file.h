#pragma once

#include <optional>

#include "solidnoise/noise/gabor/gabor_spectrum.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// What noisefit writes.
struct ExemplarFile {
  ExemplarModel model{};
  // World units of a pixel of the exemplar, > 0, where its true size is known: the model's frequencies are
  // those of the thing itself then. Otherwise a pixel of the model is 1 unit, and its scale means nothing.
  std::optional<double> pixel_size{};

  // That of a noise of true scale.
  std::optional<double> true_frequency() const;

  friend bool operator==(const ExemplarFile&, const ExemplarFile&) = default;
};

// {"solidnoise": 2, ..., "pixel_size": 0.001, "exemplar": {...}}
Json to_json(const ExemplarFile& file);
// Throws as exemplar_file_from_json(), and for a size that is not positive.
ExemplarFile exemplar_file_of(const Json& json);

}  // namespace solidnoise
