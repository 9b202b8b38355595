#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/run_tool.h"
#include "meshnoise/bake_arguments.h"
#include "meshnoise/bake_file.h"
#include "meshnoise/commands.h"
#include "meshnoise/recipe_source.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {
namespace {

constexpr char kBakeDescription[] =
    "meshnoise bake puts procedural noise onto a surface, as vertex colours, without texture coordinates.\n"
    "  meshnoise bake in.ply --out out.ply                                  rust\n"
    "  meshnoise bake in.ply --out out.ply --frequency 4..32                ... finer where the surface "
    "bends out";

}  // namespace

int run_bake(const std::vector<std::string>& arguments) {
  BakeArguments read("meshnoise bake", kBakeDescription);
  read.flags.parse(arguments);
  read.apply(choose_bake_recipe(read.flags));
  const auto threads = read.options.limit_threads();
  explained(read.flags, [&] {
    if (read.flags.given("--describe")) {
      std::cout << format_json(describe_frame(frame_of(read, 0)));
      return;
    }
    for (std::size_t i = 0; i < frame_count(read); ++i) check_outputs(read.flags, frame_of(read, i));
    for (std::size_t i = 0; i < frame_count(read); ++i) bake_frame(frame_of(read, i));
  });
  if (read.options.timings) std::cerr << read.options.times->report();
  return kDone;
}

}  // namespace solidnoise
