#include "meshnoise/texture_output.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include "common/frames.h"
#include "common/outputs.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/named_error.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/texture_coordinates.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/mesh/bake_cost.h"

namespace solidnoise {
namespace {

constexpr std::string_view kUdim = "<UDIM>";
constexpr std::string_view kMap = "<MAP>";

std::string with(std::string text, std::string_view mark, const std::string& value) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
    text.replace(at, mark.size(), value);
  return text;
}

std::string texture_path(const BakeOptions& options, const TextureMap& map, const TextureTile& tile) {
  return with(with(options.uv, kMap, map.name), kUdim, fmt::format("{}", tile.udim));
}

bool is_exr(const std::string& path) {
  return extension_of(path) == ".exr";
}

// Whole numbers hold colours as sRGB, and numbers around 0 from -4 to 4.
constexpr float kSpan = 8.0f;

bool is_signed(const TextureMap& map) {
  return map.kind == TextureMap::Kind::number && map.property.empty();
}

void write_texture(const std::string& path, const TextureMap& map, Image image, const BakeOptions& options,
                   OutputGroup* group) {
  ImageFileOptions write{.sample_type = SampleType::uint16,
                         .color_space = ColorSpace::linear,
                         .existing = options.existing(),
                         .group = group};
  if (is_exr(path)) {
    const bool is_number = map.kind == TextureMap::Kind::number;
    write.sample_type = is_number ? SampleType::float32 : SampleType::float16;
  } else if (map.kind == TextureMap::Kind::color) {
    write.color_space = ColorSpace::srgb;
    for (float& channel : image.pixels) channel = srgb_from_linear(channel);
  } else if (is_signed(map)) {
    for (float& value : image.pixels) value = 0.5f + value / kSpan;
  }
  write_image(path, image, write);
}

std::vector<TextureMap> maps_of(const BakeOptions& options) {
  std::vector<TextureMap> maps;
  for (const std::string& name : options.maps) maps.push_back(texture_map(name, options.recipe));
  return maps;
}

void require_new_files(const TextureJob& job, const std::string& in, const BakeOptions& options) {
  std::vector<OutputPath> paths;
  for (const TextureTile& tile : job.plan.tiles) {
    for (const TextureMap& map : job.maps) paths.emplace_back(texture_path(options, map, tile));
  }
  paths.insert(paths.end(), {{options.out, {in}},
                             options.usd ? usd_path(options.out) : std::string(),
                             options.preview,
                             options.write_recipe});
  require_outputs(paths, options.existing(), {in});
}

void warn(const TextureJob& job, const std::string& in, const BakeOptions& options) {
  if (options.quiet) return;
  if (job.plan.without_area > 0) {
    std::cerr << fmt::format("meshnoise: warning: {}: {} triangles have no area in the textures\n", in,
                             job.plan.without_area);
  }
  const double cycles = cycles_per_texel(job.plan);
  if (cycles > 0.5 && !filters_all(options.recipe)) {
    std::cerr << fmt::format(
        "meshnoise: warning: the noise reaches {:.2f} cycles per texel, above 0.5, and not all of it can be "
        "filtered: gradient and cellular noise, and noise of 4 dimensions, will alias; make --uv-size "
        "larger\n",
        cycles);
  }
}

}  // namespace

void check_textures(const BakeOptions& options) {
  if (options.uv.empty()) return;
  require_extension("--uv", options.uv, {".png", ".tif", ".tiff", ".exr"}, StandardOutput::refused);
  if (options.maps.size() > 1 && options.uv.find(kMap) == std::string::npos) {
    throw UsageError(fmt::format(
        "--uv is {}; where --map names several it must have <MAP> in it, such as rust_<MAP>.<UDIM>.exr",
        printable(options.uv)));
  }
  for (std::size_t i = 0; i < options.maps.size(); ++i) {
    if (std::find(options.maps.begin() + static_cast<std::ptrdiff_t>(i) + 1, options.maps.end(),
                  options.maps[i]) != options.maps.end()) {
      throw UsageError(fmt::format("--map names {} twice", printable(options.maps[i])));
    }
  }
  maps_of(options);
}

TextureJob plan_texture_job(const std::string& in, const MeshReading& reading, const BakeOptions& options) {
  const std::vector<Vec<2>> corners = corner_coordinates(reading, in);
  BakeRecipe recipe = options.recipe;
  recipe.refine.mode = RefineRecipe::Mode::off;
  TaskProgress progress(TaskProgress::Visibility::hidden);
  BakePlan bake = plan_bake(reading.mesh, recipe, &progress);
  TextureJob job;
  job.maps = maps_of(options);
  const bool has_tiles = options.uv.find(kUdim) != std::string::npos;
  job.plan = in_file(in, [&] {
    return plan_textures(std::move(bake), corners, has_tiles ? TextureTiles::udim : TextureTiles::one,
                         options.textures);
  });
  const double vertices = static_cast<double>(reading.mesh.positions.size());
  const double faces = static_cast<double>(reading.mesh.face_count());
  const int size = options.textures.size;
  options.require_cost(
      fmt::format("{} textures of {} x {} texels", job.plan.tiles.size() * job.maps.size(), size, size),
      {texture_seconds(job.plan, recipe, job.maps) /
           static_cast<double>(tbb::this_task_arena::max_concurrency()),
       kImageMemory + bake_memory(vertices, faces) + texture_memory(job.plan, job.maps)},
      "make --uv-size smaller");
  require_new_files(job, in, options);
  warn(job, in, options);
  return job;
}

void write_textures(const TextureJob& job, const BakeOptions& options, Progress* progress,
                    OutputGroup* group) {
  std::string said;
  std::size_t overlapped = 0;
  const auto count = static_cast<double>(job.plan.tiles.size());
  for (std::size_t i = 0; i < job.plan.tiles.size(); ++i) {
    const TextureTile& tile = job.plan.tiles[i];
    PartialProgress of_tile(progress, static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    BakedTile baked = bake_tile(job.plan, options.recipe, job.maps, tile, &of_tile);
    overlapped += baked.overlapped;
    for (std::size_t m = 0; m < job.maps.size(); ++m) {
      const std::string path = texture_path(options, job.maps[m], tile);
      const double texels = static_cast<double>(options.textures.size) * options.textures.size;
      said += fmt::format("{}: {}, {} x {} texels, {:.0f} % of them on the mesh\n", path, job.maps[m].name,
                          options.textures.size, options.textures.size,
                          100.0 * static_cast<double>(baked.covered) / texels);
      write_texture(path, job.maps[m], std::move(baked.images[m]), options, group);
    }
  }
  if (options.quiet) return;
  if (overlapped > 0) {
    std::cerr << fmt::format(
        "meshnoise: warning: {} texels are of several faces, which overlap in the textures: the first has "
        "them\n",
        overlapped);
  }
  const auto has = [&](const auto& what) { return std::any_of(job.maps.begin(), job.maps.end(), what); };
  if (has([](const TextureMap& map) { return map.kind == TextureMap::Kind::normal; })) {
    said += fmt::format("normals of a height of {:.6g} for a value of 1\n",
                        height_of_normals(job.plan.bake, options.recipe));
  }
  if (!is_exr(options.uv) && has(is_signed)) said += "numbers are stored as 0.5 + value / 8\n";
  std::cerr << said;
}

nlohmann::json describe_textures(const TextureJob& job, const BakeOptions& options) {
  nlohmann::json files = nlohmann::json::array();
  for (const TextureTile& tile : job.plan.tiles) {
    for (const TextureMap& map : job.maps) files.push_back(texture_path(options, map, tile));
  }
  return {{"files", files},
          {"size", options.textures.size},
          {"texels", job.plan.texels},
          {"cycles_per_texel", cycles_per_texel(job.plan)},
          {"filtered", filters_all(options.recipe)},
          {"cost",
           {{"seconds_of_one_core", texture_seconds(job.plan, options.recipe, job.maps)},
            {"memory_bytes", kImageMemory + texture_memory(job.plan, job.maps)}}}};
}

}  // namespace solidnoise
