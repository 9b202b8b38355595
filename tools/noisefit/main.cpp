#include "common/exit_status.h"
#include "noisefit/commands.h"

int main(int argc, char** argv) {
  return solidnoise::run_tool("noisefit", [&] { return solidnoise::run_noisefit({argv + 1, argv + argc}); });
}
