#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace solidnoise {

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
