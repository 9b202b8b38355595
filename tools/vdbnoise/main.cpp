#include "common/exit_status.h"
#include "vdbnoise/commands.h"

int main(int argc, char** argv) {
  return solidnoise::run_tool("vdbnoise", [&] { return solidnoise::run_vdbnoise({argv + 1, argv + argc}); });
}
