#pragma once

#include <cstdint>
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

  // The name of what begins now. Not while a task runs.
  void begin(const std::string& task) { task_ = task; }

  void advance(std::uint64_t done, std::uint64_t total) override;
  bool cancelled() override;

 private:
  ProgressBar bar_;
  std::mutex mutex_;
  std::string task_;
};

}  // namespace solidnoise
