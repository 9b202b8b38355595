#include "common/run_options.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

#include "common/memory.h"
#include "solidnoise/core/format_bytes.h"

namespace solidnoise {

std::unique_ptr<tbb::global_control> RunOptions::limit_threads() const {
  if (!threads) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(*threads));
}

std::uint64_t RunOptions::memory_limit() const {
  return max_memory ? max_memory->bytes : available_memory();
}

std::string RunOptions::say_memory_limit() const {
  return fmt::format("--max-memory allows {}{}", format_bytes(memory_limit()),
                     max_memory ? "" : ", what is available");
}

void RunOptions::require_cost(const std::string& what, const Cost& cost, const std::string& advice) const {
  const std::string more = advice.empty() ? "" : "; " + advice;
  const std::uint64_t limit = memory_limit();
  if (limit != 0 && cost.bytes > static_cast<double>(limit)) {
    const auto bytes = static_cast<std::uint64_t>(std::min(cost.bytes, 0x1.0p63));
    throw std::runtime_error(
        fmt::format("{} may need {}, {}{}", what, format_bytes(bytes), say_memory_limit(), more));
  }
  if (!max_time || cost.seconds <= *max_time) return;
  throw std::runtime_error(fmt::format("{} may take {:.3g} seconds, --max-time allows {:.3g}{}", what,
                                       cost.seconds, *max_time, more));
}

}  // namespace solidnoise
