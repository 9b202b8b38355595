#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include <tbb/global_control.h>

#include "common/flag_form.h"
#include "common/progress.h"
#include "solidnoise/core/cost.h"
#include "solidnoise/core/fields.h"
#include "solidnoise/core/output_file.h"

namespace solidnoise {

// A number of bytes, such as 8G.
struct ByteCount {
  std::uint64_t bytes = 0;
};

// What commands have in common that is not about what they make.
struct RunOptions {
  bool force = false;
  bool quiet = false;
  bool timings = false;
  bool logs = false;  // progress in lines, for a log
  std::optional<int> threads{};
  std::optional<ByteCount> max_memory{};
  std::optional<double> max_time{};  // seconds
  std::shared_ptr<StageTimes> times = std::make_shared<StageTimes>();

  Existing existing() const { return force ? Existing::replace : Existing::refuse; }
  TaskProgress::Visibility visibility() const {
    if (quiet) return TaskProgress::Visibility::hidden;
    return logs ? TaskProgress::Visibility::in_log : TaskProgress::Visibility::if_terminal;
  }
  // While it lives no more threads are at work than are allowed; null: any number.
  std::unique_ptr<tbb::global_control> limit_threads() const;
  // Bytes that may be taken: as the flag says, else what is available; 0: any number.
  std::uint64_t memory_limit() const;
  // "--max-memory allows 3.0 GiB, what is available".
  std::string say_memory_limit() const;
  // Throws std::runtime_error if something may take more bytes or seconds than are allowed.
  void require_cost(const std::string& what, const Cost& cost, const std::string& advice = {}) const;
};

template <>
struct FlagForm<ByteCount> {
  static constexpr auto kNumbers = Flag::Numbers::none;
  static std::string names(std::string_view) { return "SIZE"; }
  static ByteCount read(const std::string& flag, const FlagTexts& texts) {
    return {parse_bytes(flag, texts[0])};
  }
  static std::string write(ByteCount) { return {}; }
};

constexpr auto fields_of(std::type_identity<RunOptions>) {
  using Options = RunOptions;
  return list_fields(
      field("force", &Options::force, "Replace files that exist"),
      field("threads", &Options::threads, between(1, 4096), "", "Threads to use; without it all"),
      field("max_memory", &Options::max_memory,
            "Refuse to need more than this, such as 8G; without it, than is available"),
      field("max_time", &Options::max_time, kPositive, "seconds", "Refuse what may take longer"),
      field("quiet", &Options::quiet, "Print errors only"),
      field("timings", &Options::timings, "Print what each stage of the run took"));
}

}  // namespace solidnoise
