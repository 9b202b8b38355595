#include <algorithm>
#include <optional>
#include <pybind11/stl.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arrays.h"
#include "call.h"
#include "documentation.h"
#include "exemplar.h"
#include "json.h"
#include "solidnoise/analysis/exemplar/fit_fields.h"
#include "solidnoise/analysis/exemplar/prepare_exemplars.h"
#include "solidnoise/analysis/exemplar/solid_spectrum.h"
#include "solidnoise/core/check.h"
#include "solidnoise/recipe/field_json.h"
#include "volume.h"

namespace solidnoise::python {

Picture picture_of_object(py::handle object, const std::string& name) {
  if (is_path(object)) return {path_of(object).string(), std::nullopt};
  return {name, image_of_array(object, name)};
}

namespace {

std::vector<Picture> pictures_of(const py::object& object) {
  if (!py::isinstance<py::list>(object) && !py::isinstance<py::tuple>(object)) {
    return {picture_of_object(object, "pictures")};
  }
  std::vector<Picture> pictures;
  for (const py::handle item : object) {
    pictures.push_back(picture_of_object(item, fmt::format("pictures[{}]", pictures.size())));
  }
  if (pictures.empty()) throw std::invalid_argument("pictures is empty; there must be one at least");
  return pictures;
}

struct FitKind {
  bool grey;
  bool solid;
  bool paper;
  int patch;
};

ExemplarModel fit(const py::object& object, const FitKind& kind, const Call& call,
                  const py::kwargs& keywords) {
  const std::vector<Picture> pictures = pictures_of(object);
  ExemplarReading reading;
  ExemplarFitOptions options;
  options.patch = kind.patch;
  if (kind.paper) {
    options.spectrum = SpectrumFitOptions::of_paper();
    options.weigh_channels = false;
  }
  const Json json = json_of(keywords);
  JsonReader reader(json);
  read_fields(reader, reading);
  read_fields(reader, options.spectrum);
  read_fields(reader, options);
  reader.finish();
  const bool chooses_values = !json.contains("raw_values") && !options.squares;
  if (options.squares && json.contains("raw_values"))
    throw std::invalid_argument("squares and raw_values are given; squares are of stored values");
  const bool may_square = !json.contains("squares");
  reading.raw_values = reading.raw_values || options.squares || chooses_values;
  options.validate();
  require_fields(reading);

  ExemplarModel model;
  run(call, [&](Progress& told) {
    std::vector<Exemplar<2>> exemplars;
    std::vector<bool> linear;
    for (const Picture& picture : pictures) {
      exemplars.push_back(picture.read(reading, &told));
      linear.push_back(picture.has_linear_light());
    }
    options.raw_values = reading.raw_values;
    if (chooses_values) {
      const ValueChoice choice = choose_values(exemplars, linear, may_square);
      options.raw_values = choice.raw_values;
      options.squares = choice.squares;
    }
    if (kind.grey) std::ranges::for_each(exemplars, make_grey);
    agree_on_channels(exemplars);
    if (kind.solid) {
      model = fit_solid_exemplar(exemplars, options, &told).model;
    } else {
      model = fit_exemplar<2>(exemplars, options, &told).model;
    }
    throw_if_cancelled(&told);
  });
  return model;
}

}  // namespace

void add_exemplar(py::module_& module) {
  using namespace py::literals;
  add_model(module);
  const std::string options = describe_options(schema_of<ExemplarReading>()) +
                              describe_options(schema_of<SpectrumFitOptions>()) +
                              describe_options(schema_of<ExemplarFitOptions>());
  module.def(
      "fit",
      [](const py::object& pictures, bool grey, bool solid, bool paper, int patch, std::optional<int> threads,
         py::object progress, const py::kwargs& keywords) {
        return fit(pictures, {grey, solid, paper, patch}, {threads, std::move(progress)}, keywords);
      },
      "pictures"_a, py::kw_only(), "grey"_a = false, "solid"_a = false, "paper"_a = false, "patch"_a = 0,
      "threads"_a = py::none(), "progress"_a = py::none(),
      document("fit(pictures, *, grey=False, solid=False, paper=False, patch=0, threads=None, progress=None, "
               "**options)",
               R"(Learns a noise from pictures of a texture: the same model, to the last bit, as noisefit.

pictures : array (rows, columns) or (rows, columns, channels), path, or a list of these, which are averaged
    Arrays of uint8 and uint16 are scaled to 0 to 1, floats are as they are: sRGB-encoded, unless raw_values.
    Without raw_values and squares the values are taken as they are stored, become linear light, or are
    learnt as square roots whose noise is squared, whichever noise suits better: that of which less is
    clipped, and which is less lopsided. The model's recipe says which.
grey : bool
    Learn the brightness alone.
solid : bool
    An isotropic noise in 3D whose slices look like the exemplar.
paper : bool
    The paper's parameters: the narrowest band, one kappa for all channels.
patch : int, pixels
    Average over patches of this size; 0: as large as can be.
)" + options +
                   "\nReturns an ExemplarModel. Raises ValueError for pictures that there is nothing to "
                   "learn from, OSError for files.")
          .c_str());
}

}  // namespace solidnoise::python
