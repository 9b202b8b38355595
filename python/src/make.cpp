#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <pybind11/stl.h>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "call.h"
#include "documentation.h"
#include "json.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/format_bytes.h"
#include "solidnoise/recipe/recipe_file.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/stored_recipe.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_cost.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "volume.h"

namespace solidnoise::python {

VolumeRecipe volume_recipe_of(py::handle recipe, const py::dict& keywords) {
  const auto text_in = [](const std::filesystem::path& path) {
    return extension_of(path) == ".vdb" ? recipe_text_in(path) : read_text_file(path);
  };
  VolumeRecipe result;
  use_recipe(
      recipe, keywords, [&](const Json& json) { result = volume_recipe_from_json(with_header(json)); },
      text_in);
  return result;
}

namespace {

VolumePart part_of(std::optional<std::pair<int, int>> shard) {
  VolumePart part;
  if (shard) std::tie(part.shard, part.shards) = *shard;
  part.validate();
  return part;
}

// Before any voxel is made, in vdbnoise's words.
void require_memory(const VolumeRecipe& recipe, const VolumePlan& plan, std::uint64_t most) {
  const double bytes = volume_cost(recipe, plan, max_threads()).bytes;
  if (bytes <= static_cast<double>(most)) return;
  const openvdb::Coord voxels = plan.voxels.dim();
  throw TooMuchMemory(
      fmt::format("{} x {} x {} voxels may need {}, max_memory allows {}{}", voxels.x(), voxels.y(),
                  voxels.z(), format_bytes(static_cast<std::uint64_t>(std::min(bytes, 0x1.0p63))),
                  format_bytes(most), plan.modification ? "" : "; make dim smaller or voxel larger"));
}

VolumeObject make_volume_object(py::handle recipe, std::optional<std::pair<int, int>> shard,
                                std::optional<std::uint64_t> max_memory, std::optional<int> threads,
                                py::object progress, const py::kwargs& keywords) {
  const Call call(threads, std::move(progress));
  const VolumeRecipe read = volume_recipe_of(recipe, keywords);
  const VolumePart part = part_of(shard);
  VolumeObject made;
  run(call, [&](Progress& told) {
    const VolumePlan plan = plan_volume(read, part, &told);
    if (max_memory) require_memory(read, plan, *max_memory);
    made.volume = make_volume(read, plan, kCreator, &told);
    made.recipe = with_digests(read, plan);
  });
  return made;
}

VolumeObject read_volume_object(py::handle path, std::optional<int> threads) {
  VolumeObject result;
  const std::filesystem::path file = path_of(path);
  result.file = file.string();
  run({threads, py::none()}, [&](Progress& told) {
    result.volume.file = read_grids(file, &told);
    for (const auto& grid : result.volume.file->grids) {
      if (!result.recipe) result.recipe = stored_recipe(*grid, result.file);
    }
  });
  return result;
}

VolumeObject merge_volume_object(const py::iterable& paths, std::optional<int> threads, py::object progress) {
  if (is_path(paths)) {  // each letter of a text would be one
    throw py::type_error("paths is a " + name_of_type(paths) +
                         "; it must be several paths, as a list has them");
  }
  std::vector<std::filesystem::path> files;
  for (const py::handle path : paths) files.push_back(path_of(path));
  VolumeObject result;
  run({threads, std::move(progress)}, [&](Progress& told) {
    MergedVolume merged = merge_parts(files, kCreator, &told);
    result.volume = std::move(merged.volume);
    result.recipe = std::move(merged.recipe);
    result.frame = merged.frame;
    result.fps = merged.fps;
  });
  return result;
}

}  // namespace

void add_makers(py::module_& module) {
  using namespace py::literals;
  const std::string keys = describe_options(volume_recipe_schema());
  module.def(
      "make_volume", &make_volume_object, "recipe"_a = py::none(), py::kw_only(), "shard"_a = py::none(),
      "max_memory"_a = py::none(), "threads"_a = py::none(), "progress"_a = py::none(),
      document(
          "make_volume(recipe=None, *, shard=None, max_memory=None, threads=None, progress=None, **keys)",
          R"(Makes a volume of a recipe: the same values, to the last bit, as vdbnoise --recipe.

    solidnoise.make_volume(solidnoise.preset("smoke"), dim=128, noise={"seed": 7}).write("smoke.vdb")

recipe : dict, or the path of a .json file, or of a .vdb that carries one
    What vdbnoise reads and writes. Left out, all keys are as they are by default.
shard : two ints
    A part of the volume, (1, 8) for the first of eight, for merge().
max_memory : int, bytes
    What may need more is refused with MemoryError, before any voxel is made. Left out, nothing is.
threads, progress
    As of Noise.
keys
    Of the recipe: take the place of its own, or, where both are dicts, are merged into them.

The keys of a recipe:

)" + keys +
              "\nReturns a Volume. Raises ValueError for a recipe that is not allowed, OSError "
              "for files that it names.")
          .c_str());
  module.def("read_volume", &read_volume_object, "path"_a, py::kw_only(), "threads"_a = py::none(),
             R"(read_volume(path, *, threads=None)
--

Reads all grids of a .vdb or .nvdb, whoever made it, to its end: Ctrl-C waits for it.

threads
    As of Noise.

Returns a Volume. Raises OSError for a file that cannot be read, or that is damaged.)");
  module.def("merge", &merge_volume_object, "paths"_a, py::kw_only(), "threads"_a = py::none(),
             "progress"_a = py::none(),
             R"(merge(paths, *, threads=None, progress=None)
--

Joins the files of a volume's parts (shard=): the same volume, to the last bit, as made whole.

paths : several paths, in any order
    Of the .vdb files, those of all parts.
threads, progress
    As of Noise.

Returns a Volume. Raises OSError for a part that is missing or is not one.)");
}

}  // namespace solidnoise::python
