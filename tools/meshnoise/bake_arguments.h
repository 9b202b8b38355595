#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "common/flag_set.h"
#include "common/frames.h"
#include "common/run_tool.h"
#include "meshnoise/bake_options.h"

namespace solidnoise {

// A command line that says what to bake. First flags.parse(), then apply() to the recipe that the flags
// override, such as that of choose_bake_recipe(). Lives as long as its options are used.
class BakeArguments {
 public:
  BakeArguments(const std::string& command, const std::string& description);

  // Puts what the flags say into `options`, and refuses what has no effect or does not fit together. Throws
  // UsageError.
  void apply(const BakeRecipe& start);

  FlagSet flags;
  BakeOptions options;
  std::string in;  // the mesh
};

// Runs what may throw std::invalid_argument about one of the flags' fields; it becomes a UsageError.
template <typename Run>
auto explained(const FlagSet& flags, const Run& run) {
  try {
    return run();
  } catch (const std::invalid_argument& error) {
    throw UsageError(flags.name_flag(name_loop(flags, error.what())));
  }
}

// One frame of a sequence, or all there is, and the mesh that it is made on.
struct BakeFrame {
  std::string in;
  BakeOptions options;
  bool is_first = true;  // what all frames have is told once
};
std::size_t frame_count(const BakeArguments& arguments);
BakeFrame frame_of(const BakeArguments& arguments, std::size_t index);

// Refuses outputs that could not be written in the end, before any work. Throws UsageError, and as
// require_outputs().
void check_outputs(const FlagSet& flags, const BakeFrame& frame);

}  // namespace solidnoise
