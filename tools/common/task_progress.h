#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "common/progress_bar.h"
#include "solidnoise/core/progress.h"

namespace solidnoise {

// Shows the progress of a tool's tasks, one after the other, and cancels them when the process is
// interrupted.
class TaskProgress final : public Progress {
 public:
  explicit TaskProgress(ProgressBar::Visibility visibility) : bar_(visibility) {}

  // The name of what begins now, and what is called, by any thread, when all of its units of work are done.
  // Not while a task runs.
  void begin(const std::string& task, std::function<void()> done = {});

  void advance(std::uint64_t done, std::uint64_t total) override;
  bool cancelled() override;

 private:
  ProgressBar bar_;
  std::mutex mutex_;
  std::string task_;
  std::function<void()> done_;
};

}  // namespace solidnoise
