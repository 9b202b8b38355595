#include "common/run_tool.h"
#include "vdbnoise/commands.h"

int main(int argc, char** argv) {
  using namespace solidnoise;
  constexpr Command kCommands[] = {{"make", run_make},       {"merge", run_merge}, {"surface", run_surface},
                                   {"analyze", run_analyze}, {"slice", run_slice}, {"sky", run_sky},
                                   {"info", run_info},       {"farm", run_farm}};
  return run_tool("vdbnoise", [&] {
    return run_commands("vdbnoise", kCommands, {argv + 1, argv + argc}, run_make);
  });
}
