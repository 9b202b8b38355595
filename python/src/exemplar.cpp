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
#include "documentation.h"
#include "json.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"
#include "solidnoise/analysis/exemplar/edit_model.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/fit_fields.h"
#include "solidnoise/analysis/exemplar/prepare_exemplars.h"
#include "solidnoise/analysis/exemplar/solid_spectrum.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/field_json.h"

namespace solidnoise::python {
namespace {

using ModelClass = py::class_<ExemplarModel>;

// What a stored number of an integer type is 1 at.
double full_scale(const py::dtype& type) {
  if (type.kind() != 'u') return 1.0;
  return type.itemsize() == 1 ? 255.0 : 65535.0;
}

Image image_of(const py::array& array, const std::string& name) {
  if (array.ndim() != 2 && array.ndim() != 3) {
    throw std::invalid_argument(name + " must have the shape (rows, columns) or (rows, columns, channels)");
  }
  const std::vector<double> numbers = numbers_of(array, name);
  // As OpenImageIO does it: the same picture from a file has the same values.
  const float scale = static_cast<float>(1.0 / full_scale(array.dtype()));
  Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
              array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1);
  std::transform(numbers.begin(), numbers.end(), image.pixels.begin(),
                 [&](double number) { return static_cast<float>(number) * scale; });
  return image;
}

// A picture as callers have it: an array or a path. It is read without the interpreter's lock.
struct Picture {
  std::string name;
  std::optional<Image> image;  // none: the file of the name

  Exemplar<2> read(const ExemplarReading& reading) const {
    return image ? exemplar_of_image(*image, reading, name) : read_exemplar(name, reading);
  }
};

Picture picture_of_object(py::handle object, const std::string& name) {
  if (is_path(object)) return {path_of(object).string(), std::nullopt};
  const py::array array = py::array::ensure(object);
  if (!array) throw py::error_already_set();
  return {name, image_of(array, name)};
}

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
  options.raw_values = reading.raw_values;
  options.validate();
  require_fields(reading);

  ExemplarModel model;
  run(call, [&](Progress& told) {
    std::vector<Exemplar<2>> exemplars;
    for (const Picture& picture : pictures) {
      exemplars.push_back(picture.read(reading));
      if (kind.grey) make_grey(exemplars.back());
    }
    agree_on_channels(exemplars);
    if (kind.solid) {
      model = fit_solid_exemplar(exemplars, options.axes, options.spectrum.kappa, options.patch).model;
      model.raw_values = reading.raw_values;
    } else {
      model = fit_exemplar<2>(exemplars, options, &told).model;
    }
    throw_if_cancelled(&told);
  });
  return model;
}

ExemplarModel model_of(py::handle recipe) {
  ExemplarModel model;
  use_recipe(recipe, {}, [&](const Json& json) { model = exemplar_file_from_json(json); });
  return model;
}

std::vector<std::string> groups_of(const ExemplarModel& model) {
  std::vector<std::string> groups;
  for (const GaborSpectrum& channel : model.channels) {
    for (const std::string& group : channel.groups) {
      if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
    }
  }
  return groups;
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
                const std::string& caption, std::uint64_t seed, const py::kwargs& keywords) {
  ExemplarReading reading;
  reading.raw_values = model.raw_values;
  const Json json = json_of(keywords);
  JsonReader reader(json);
  read_fields(reader, reading);
  reader.finish();
  const Picture source = picture_of_object(picture, "picture");
  Image image;
  run({std::nullopt, py::none()}, [&](Progress&) {
    Exemplar<2> exemplar = source.read(reading);
    if (model.channels.size() == 1) make_grey(exemplar);
    image = draw_exemplar_sheet(exemplar, model, {.title = title, .caption = caption, .seed = seed});
  });
  return pixels_of(std::move(image));
}

py::array texture(const ExemplarModel& model, std::pair<int, int> resolution, double pixel_size,
                  const py::object& origin, std::uint64_t seed) {
  require_in_range("resolution", std::min(resolution.first, resolution.second), 1, 16384, "pixels");
  require_positive("pixel_size", pixel_size, "world units");
  const Vec<3> from = vector_of<3>(origin, "origin");
  Image image;
  run({std::nullopt, py::none()}, [&](Progress&) {
    image = image_of_exemplar(
        procedural_texture(model, {resolution.first, resolution.second}, Vec<2>(pixel_size), from, seed));
  });
  return pixels_of(std::move(image));
}

// Which components an edit works on, as its keywords say.
struct Choice {
  std::optional<std::string> group;
  std::optional<int> channel;
};

// The model with an edit of the chosen components.
ExemplarModel edited(ExemplarModel model, const Choice& choice, bool makes_group,
                     const std::function<void(GaborSpectrum&, std::size_t)>& edit) {
  if (!edit_model(model, {choice.group, choice.channel, makes_group}, edit)) {
    throw std::invalid_argument(
        fmt::format("group is {}; it must be one of {}", *choice.group, fmt::join(groups_of(model), ", ")));
  }
  return model;
}

// An edit by a number.
void add_edit(ModelClass& of, const char* name, const char* argument, const char* help,
              void (*edit)(GaborSpectrum&, const GroupChoice&, double)) {
  using namespace py::literals;
  of.def(
      name,
      [edit](const ExemplarModel& model, double number, std::optional<std::string> group,
             std::optional<int> channel) {
        return edited(model, {group, channel}, false,
                      [&](GaborSpectrum& spectrum, std::size_t) { edit(spectrum, group, number); });
      },
      py::arg(argument), py::kw_only(), "group"_a = py::none(), "channel"_a = py::none(),
      document(fmt::format("{}(self, {}, *, group=None, channel=None)", name, argument), help).c_str());
}

void add_edits(ModelClass& of) {
  using namespace py::literals;
  add_edit(
      of, "rotate", "degrees",
      "A model whose frequencies are turned counterclockwise, in 3D about the z axis.",
      [](GaborSpectrum& s, const GroupChoice& group, double degrees) { rotate_group(s, group, degrees); });
  add_edit(of, "scale", "factor", "A model whose frequencies are multiplied; bandwidths stay.", scale_group);
  add_edit(of, "magnitude", "factor", "A model whose amplitudes are multiplied.", scale_magnitude);
  add_edit(of, "bandwidth", "factor", "A model whose bandwidths are multiplied; variances stay.",
           scale_bandwidth);
  of.def(
      "translate",
      [](const ExemplarModel& model, py::object by, std::optional<std::string> group,
         std::optional<int> channel) {
        std::vector<double> numbers = numbers_of(by, "by");
        if (numbers.size() != 2 && numbers.size() != 3)
          throw std::invalid_argument("by must be 2 or 3 numbers");
        numbers.resize(3);
        return edited(model, {group, channel}, false, [&](GaborSpectrum& spectrum, std::size_t) {
          translate_group(spectrum, group, {numbers[0], numbers[1], numbers[2]});
        });
      },
      "by"_a, py::kw_only(), "group"_a = py::none(), "channel"_a = py::none(),
      "translate(self, by, *, group=None, channel=None)\n--\n\nA model to whose frequencies a vector is "
      "added, cycles per world unit.");
  of.def(
      "remove",
      [](const ExemplarModel& model, const std::string& group, std::optional<int> channel) {
        return edited(model, {group, channel}, false,
                      [&](GaborSpectrum& spectrum, std::size_t) { remove_group(spectrum, group); });
      },
      "group"_a, py::kw_only(), "channel"_a = py::none(),
      "remove(self, group, *, channel=None)\n--\n\nA model without the components of a group.");
  of.def(
      "rename",
      [](const ExemplarModel& model, const std::string& group, const std::string& name,
         std::optional<int> channel) {
        return edited(model, {group, channel}, false,
                      [&](GaborSpectrum& spectrum, std::size_t) { rename_group(spectrum, group, name); });
      },
      "group"_a, "name"_a, py::kw_only(), "channel"_a = py::none(),
      "rename(self, group, name, *, channel=None)\n--\n\nA model in which a group has another name, or has "
      "joined the group of that name.");
  of.def(
      "add",
      [](const ExemplarModel& model, double a, double variance, py::object frequency,
         const std::string& group, std::optional<int> channel) {
        SpectrumComponent component;
        component.variance = variance;
        const std::vector<double> numbers = numbers_of(frequency, "frequency");
        if (numbers.size() != 2 && numbers.size() != 3)
          throw std::invalid_argument("frequency must be 2 or 3 numbers");
        for (std::size_t i = 0; i < numbers.size(); ++i)
          component.frequency[static_cast<int>(i)] = numbers[i];
        return edited(model, {group, channel}, true, [&](GaborSpectrum& spectrum, std::size_t) {
          add_component(spectrum, a, component, group);
        });
      },
      "a"_a, "variance"_a, "frequency"_a, py::kw_only(), "group"_a = "added", "channel"_a = py::none(),
      "add(self, a, variance, frequency, *, group='added', channel=None)\n--\n\nA model with one more "
      "component: bandwidth a, variance, and "
      "frequency, 2 or 3 numbers, cycles per world unit.");
  of.def(
      "copy_from",
      [](const ExemplarModel& model, const ExemplarModel& other, std::optional<std::string> group,
         std::optional<int> channel) {
        return edited(model, {group, channel}, true, [&](GaborSpectrum& spectrum, std::size_t k) {
          if (k >= other.channels.size() || (group && !has_group(other.channels[k], *group))) return;
          copy_group(spectrum, other.channels[k], group);
        });
      },
      "other"_a, py::kw_only(), "group"_a = py::none(), "channel"_a = py::none(),
      "copy_from(self, other, *, group=None, channel=None)\n--\n\nA model with the components of another "
      "one, too, of a group or all, "
      "channel by channel.");
  of.def(
      "regroup",
      [](const ExemplarModel& model, std::optional<int> channel) {
        return edited(model, {std::nullopt, channel}, true,
                      [](GaborSpectrum& spectrum, std::size_t) { spectrum = group_spectrum(spectrum); });
      },
      py::kw_only(), "channel"_a = py::none(),
      "regroup(self, *, channel=None)\n--\n\nA model whose components are sorted into groups anew, after "
      "Wold.");
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
        const std::string text = format_json(exemplar_file_to_json(model));
        run_at_once([&] {
          write_output(target, {.existing = force ? Existing::replace : Existing::refuse},
                       [&](std::ostream& stream) { stream << text; });
        });
      },
      "path"_a, py::kw_only(), "force"_a = false,
      "write(self, path, *, force=False)\n--\n\nWrites the model to a .json file, all or nothing. Raises "
      "OSError, FileExistsError.");
  of.def("texture", &texture, "resolution"_a = std::pair(512, 512), py::kw_only(), "pixel_size"_a = 1.0,
         "origin"_a = py::make_tuple(0.0, 0.0, 0.0), "seed"_a = 1,
         R"(texture(self, resolution=(512, 512), *, pixel_size=1.0, origin=(0.0, 0.0, 0.0), seed=1)
--

The colours of the model's noise on pixels, columns and rows, as an array (rows, columns, 3) of float32, row 0 at the top, in linear light
unless the model's values are raw.)");
  of.def("sheet", &sheet, "picture"_a, py::kw_only(), "title"_a = "", "caption"_a = "", "seed"_a = 1,
         R"(sheet(self, picture, *, title='', caption='', seed=1, **reading)
--

The picture by which a noise by example is judged: the exemplar, its Gaussian version, the sparse spectrum, the noise. An array (rows,
columns, 3) of float32, sRGB-encoded. picture and reading are those of fit().)");
  of.def("__repr__", [](const ExemplarModel& model) { return represent(model); });
  of.def("__eq__", [](const ExemplarModel& model, py::object other) -> py::object {
    if (!py::isinstance<ExemplarModel>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(model == other.cast<const ExemplarModel&>());
  });
  of.def("__hash__", [](const ExemplarModel& model) {
    return std::hash<std::string>()(exemplar_file_to_json(model).dump());
  });
  of.def(
      py::pickle([](const ExemplarModel& model) { return py::dict(object_of(exemplar_file_to_json(model))); },
                 [](const py::dict& recipe) { return model_of(recipe); }));
  add_edits(of);
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
