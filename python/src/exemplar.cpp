#include "exemplar.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <pybind11/stl.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "arrays.h"
#include "call.h"
#include "json.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/fit_fields.h"
#include "solidnoise/analysis/exemplar/prepare_exemplars.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/field_json.h"

namespace solidnoise::python {
namespace {

ExemplarModel model_of(py::handle recipe) {
  ExemplarModel model;
  use_recipe(recipe, {}, [&](const Json& json) { model = exemplar_file_from_json(json); });
  return model;
}

std::size_t count_components(const ExemplarModel& model) {
  std::size_t components = 0;
  for (const GaborSpectrum& channel : model.channels) {
    for (const SpectrumBand& band : channel.bands) components += band.components.size();
  }
  return components;
}

std::string represent(const ExemplarModel& model) {
  return fmt::format("<solidnoise.ExemplarModel of {} dimensions, {} channel{}, {} components, groups: {}>",
                     model.channels.front().dimensions, model.channels.size(),
                     model.channels.size() == 1 ? "" : "s", count_components(model),
                     fmt::join(groups_of(model), ", "));
}

py::array pixels_of(Image&& image) {
  return array_of(std::move(image.pixels), {image.height, image.width, image.channels});
}

py::array sheet(const ExemplarModel& model, const py::object& picture, const std::string& title,
                const std::string& caption, std::uint64_t seed, const Call& call,
                const py::kwargs& keywords) {
  ExemplarReading reading;
  reading.raw_values = model.raw_values;
  const Json json = json_of(keywords);
  JsonReader reader(json);
  read_fields(reader, reading);
  reader.finish();
  const Picture source = picture_of_object(picture, "picture");
  Image image;
  run(call, [&](Progress& told) {
    Exemplar<2> exemplar = source.read(reading, &told);
    if (model.channels.size() == 1) make_grey(exemplar);
    image = draw_exemplar_sheet(exemplar, model, {.title = title, .caption = caption, .seed = seed}, &told);
  });
  return pixels_of(std::move(image));
}

py::array texture(const ExemplarModel& model, std::pair<int, int> resolution, double pixel_size,
                  const py::object& origin, std::uint64_t seed, const Call& call) {
  require_in_range("resolution", std::min(resolution.first, resolution.second), 1, 16384, "pixels");
  require_positive("pixel_size", pixel_size, "world units");
  const Vec<3> from = vector_of<3>(origin, "origin");
  Image image;
  run(call, [&](Progress& told) {
    image = image_of_exemplar(procedural_texture(model, {resolution.first, resolution.second},
                                                 Vec<2>(pixel_size), from, seed, &told));
  });
  return pixels_of(std::move(image));
}

}  // namespace

std::vector<std::string> groups_of(const ExemplarModel& model) {
  std::vector<std::string> groups;
  for (const GaborSpectrum& channel : model.channels) {
    for (const std::string& group : channel.groups) {
      if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
    }
  }
  return groups;
}

void add_model(py::module_& module) {
  using namespace py::literals;
  ModelClass of(module, "ExemplarModel", R"(ExemplarModel(recipe)
--

What a noise by example takes over from its exemplar: a sparse power spectrum for each channel of its colours. fit() makes them; spectrum()
and recipes of volumes and meshes take them for "exemplar".

recipe : dict, or the path of a .json file, as noisefit writes it

Models are immutable: edits return another one. They work on all components, or on those of a group, in all channels or in one.
Groups are those of group_names.

    sand = solidnoise.fit("sand.jpg")
    solidnoise.spectrum(exemplar=sand.rotate(45), frequency=8))");
  of.def(py::init(&model_of), "recipe"_a, py::pos_only());
  of.def_property_readonly(
      "recipe", [](const ExemplarModel& model) { return object_of(exemplar_file_to_json(model)); },
      "What noisefit writes, as a new dict.");
  of.def_property_readonly("group_names", &groups_of, "The names of the groups, of all channels.");
  of.def_property_readonly(
      "channels", [](const ExemplarModel& model) { return model.channels.size(); },
      "How many channels there are: 1 (grey) or 3.");
  of.def_property_readonly(
      "dims", [](const ExemplarModel& model) { return model.channels.front().dimensions; },
      "Dimensions of the spectrum: 2, or 3 of a solid one.");
  of.def_property_readonly("components", &count_components, "How many components all channels have.");
  of.def_property_readonly("principal_frequency", &ExemplarModel::principal_frequency,
                           "Root mean square frequency of all channels, cycles per world unit.");
  of.def_property_readonly(
      "description", [](const ExemplarModel& model) { return solidnoise::describe(model); },
      "What noisefit info prints of it.");
  of.def(
      "write",
      [](const ExemplarModel& model, py::handle path, bool force) {
        const std::filesystem::path target = path_of(path);
        if (extension_of(target) != ".json") {
          throw std::invalid_argument(
              fmt::format("path is {}; it must end in .json", printable(target.string())));
        }
        const std::string text = format_json(exemplar_file_to_json(model));
        run_at_once([&] {
          write_output(target, {.existing = force ? Existing::replace : Existing::refuse},
                       [&](std::ostream& stream) { stream << text; });
        });
      },
      "path"_a, py::kw_only(), "force"_a = false,
      "write(self, path, *, force=False)\n--\n\nWrites the model to a .json file, all or nothing. Raises "
      "OSError, FileExistsError.");
  of.def(
      "texture",
      [](const ExemplarModel& model, std::pair<int, int> resolution, double pixel_size,
         const py::object& origin, std::uint64_t seed, std::optional<int> threads, py::object progress) {
        return texture(model, resolution, pixel_size, origin, seed, {threads, std::move(progress)});
      },
      "resolution"_a = std::pair(512, 512), py::kw_only(), "pixel_size"_a = 1.0,
      "origin"_a = py::make_tuple(0.0, 0.0, 0.0), "seed"_a = 1, "threads"_a = py::none(),
      "progress"_a = py::none(),
      R"(texture(self, resolution=(512, 512), *, pixel_size=1.0, origin=(0.0, 0.0, 0.0), seed=1, threads=None, progress=None)
--

The colours of the model's noise on pixels, columns and rows, as an array (rows, columns, 3) of float32, row 0 at the top, in linear light
unless the model's values are raw.)");
  of.def(
      "sheet",
      [](const ExemplarModel& model, const py::object& picture, const std::string& title,
         const std::string& caption, std::uint64_t seed, std::optional<int> threads, py::object progress,
         const py::kwargs& keywords) {
        return sheet(model, picture, title, caption, seed, {threads, std::move(progress)}, keywords);
      },
      "picture"_a, py::kw_only(), "title"_a = "", "caption"_a = "", "seed"_a = 1, "threads"_a = py::none(),
      "progress"_a = py::none(),
      R"(sheet(self, picture, *, title='', caption='', seed=1, threads=None, progress=None, **reading)
--

The picture by which a noise by example is judged: the exemplar, its Gaussian version, the sparse spectrum, the noise. An array (rows,
columns, 3) of float32, sRGB-encoded. picture and reading are those of fit().)");
  of.def("__repr__", [](const ExemplarModel& model) { return represent(model); });
  of.def("__eq__", [](const ExemplarModel& model, py::object other) -> py::object {
    if (!py::isinstance<ExemplarModel>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(model == other.cast<const ExemplarModel&>());
  });
  of.def("__hash__", [](const ExemplarModel& model) {
    return std::hash<std::string>()(hashed_text(exemplar_file_to_json(model)));
  });
  of.def("__reduce__", [](const py::object& self) {  // by the constructor, in pickles of any protocol
    return py::make_tuple(py::type::of(self), py::make_tuple(self.attr("recipe")));
  });
  add_edits(of);
}

}  // namespace solidnoise::python
