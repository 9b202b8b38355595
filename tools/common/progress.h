#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "solidnoise/core/progress.h"

namespace solidnoise {

// How long a task will take yet that has come this far, a share of it, in so many seconds: ", 12 s left".
// Empty while that cannot be told: within the first second, or before 2 % are done.
std::string time_left(double seconds, double done);

// Shows the progress of a tool's tasks, one after the other, and cancels them when the process is
// interrupted: one line on a terminal's standard error, redrawn at most ten times a second, which says after
// a while how long the task will take yet; nothing where standard error is not a terminal. The line is wiped
// at the end. In a log instead a line for each tenth of a task, one in ten seconds at most.
class TaskProgress final : public Progress {
 public:
  enum class Visibility { if_terminal, in_log, hidden };

  explicit TaskProgress(Visibility visibility);
  ~TaskProgress() override;
  TaskProgress(const TaskProgress&) = delete;
  TaskProgress& operator=(const TaskProgress&) = delete;

  // The name of what begins now, and what is called, by any thread, when all of its units of work are done.
  // Not while a task runs.
  void begin(const std::string& task, std::function<void()> done = {});

  void advance(std::uint64_t done, std::uint64_t total) override;
  bool cancelled() override;

 private:
  using Clock = std::chrono::steady_clock;

  void draw(double fraction);
  void log(double fraction);

  bool visible_ = false;
  bool logs_ = false;
  bool drawn_ = false;
  std::mutex mutex_;
  std::string task_;
  std::function<void()> done_;
  Clock::time_point began_;  // the task
  Clock::time_point last_shown_;
  int logged_ = 0;  // percent of the task
};

// Where the time of a run goes: wall time and processor time of its stages. Processor time is that of all
// threads, so that their ratio tells how many threads were at work.
class StageTimes {
 public:
  // Begins with the stage "start". What the process has used of the processor before, loading the program,
  // counts for it as both.
  StageTimes();

  // From now on time counts for this stage; of one that was there before, it goes on. From any thread.
  void begin(const std::string& stage);

  // A line per stage in the order of their first beginnings, and their sum: seconds, seconds of processor,
  // share of all seconds in percent.
  std::string report();

 private:
  using Clock = std::chrono::steady_clock;

  struct Stage {
    std::string name;
    double wall = 0.0;
    double processor = 0.0;  // seconds
  };

  void count_until_now();

  std::mutex mutex_;
  std::vector<Stage> stages_;
  std::size_t current_ = 0;
  Clock::time_point since_;
  double processor_since_ = 0.0;
};

}  // namespace solidnoise
