#include "common/task_progress.h"

#include <utility>

#include "common/interrupt.h"

namespace solidnoise {

void TaskProgress::begin(const std::string& task, std::function<void()> done) {
  task_ = task;
  done_ = std::move(done);
}

void TaskProgress::advance(std::uint64_t done, std::uint64_t total) {
  if (done == total && done_) done_();
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || total == 0) return;
  bar_.show(task_, static_cast<double>(done) / static_cast<double>(total));
}

bool TaskProgress::cancelled() {
  return interrupt_signal() != 0;
}

}  // namespace solidnoise
