#include "common/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

namespace solidnoise {
namespace {

std::optional<std::uint64_t> read_number(const char* path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  if (file >> number) return number;
  return std::nullopt;
}

std::optional<std::uint64_t> available_to_machine() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  std::uint64_t kibibytes = 0;
  std::string unit;
  while (file >> key >> kibibytes) {
    if (key == "MemAvailable:") return kibibytes * 1024;
    std::getline(file, unit);
  }
  return std::nullopt;
}

// Containers limit the group of processes; the file says "max" where there is no limit.
std::optional<std::uint64_t> available_to_control_group() {
  const auto limit = read_number("/sys/fs/cgroup/memory.max");
  const auto used = read_number("/sys/fs/cgroup/memory.current");
  if (!limit || !used) return std::nullopt;
  return *limit > *used ? *limit - *used : 0;
}

}  // namespace

std::uint64_t available_memory() {
  constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t least =
      std::min(available_to_machine().value_or(kUnknown), available_to_control_group().value_or(kUnknown));
  return least == kUnknown ? 0 : least;
}

}  // namespace solidnoise
