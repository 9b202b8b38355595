#include "common/exit_status.h"
#include "meshnoise/commands.h"

int main(int argc, char** argv) {
  return solidnoise::run_tool("meshnoise", [&] {
    return solidnoise::run_meshnoise({argv + 1, argv + argc});
  });
}
