#include "vdbnoise/grid_flags.h"

#include <filesystem>

#include <fmt/format.h>

#include "common/usage_error.h"

namespace solidnoise {

GridFile parse_grid_flag(const std::string& flag, const std::string& text) {
  std::optional<GridFile> source = parse_grid_file(text);
  if (!source) {
    throw UsageError(
        fmt::format("{} is {}; it must be FILE.vdb or FILE.vdb:GRID", flag, text.empty() ? "empty" : text));
  }
  source->file = std::filesystem::absolute(source->file).string();
  return *source;
}

void declare_grid_file(FlagSet& flags, const std::string& flag, const std::string& help,
                       std::optional<GridFile>& target) {
  flags.text(flag, "FILE.vdb[:GRID]", help,
             [flag, &target](const std::string& text) { target = parse_grid_flag(flag, text); });
}

}  // namespace solidnoise
