#include "call.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "solidnoise/core/check.h"

namespace solidnoise::python {
namespace {

constexpr int kMostThreads = 4096;
constexpr auto kBetweenSignals = std::chrono::milliseconds(50);

// All calls that are at work, and whether there may be more. It outlives them: it is never destroyed.
struct AllWork {
  std::mutex mutex;
  std::condition_variable less;
  int calls = 0;
  std::atomic<bool> ends{false};
};
AllWork& all_work() {
  static AllWork* const work = new AllWork;
  return *work;
}

// Counts a call; to be made and destroyed with the interpreter's lock.
class CountedCall {
 public:
  CountedCall() {
    const std::lock_guard lock(all_work().mutex);
    if (all_work().ends) throw std::logic_error("the interpreter is about to end");
    ++all_work().calls;
  }
  ~CountedCall() {
    {
      const std::lock_guard lock(all_work().mutex);
      --all_work().calls;
    }
    all_work().less.notify_all();
  }
  CountedCall(const CountedCall&) = delete;
  CountedCall& operator=(const CountedCall&) = delete;
};

// What the working threads tell the one that waits.
class CallProgress final : public Progress {
 public:
  void advance(std::uint64_t done, std::uint64_t total) override {
    fraction_ = total == 0 ? 0.0 : static_cast<double>(done) / static_cast<double>(total);
  }
  bool cancelled() override { return stops_ || all_work().ends; }

  void stop() { stops_ = true; }
  double fraction() const { return fraction_; }

 private:
  std::atomic<double> fraction_{0.0};
  std::atomic<bool> stops_{false};
};

// A thread that does some work once.
class Worker {
 public:
  explicit Worker(std::function<void()> work)
      : thread_([this, work = std::move(work)] {
          try {
            work();
          } catch (...) {
            error_ = std::current_exception();
          }
          {
            const std::lock_guard lock(mutex_);
            is_done_ = true;
          }
          done_.notify_one();
        }) {}
  ~Worker() {
    if (thread_.joinable()) thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Whether the work is done by now, or after a while.
  bool wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    return done_.wait_for(lock, most, [&] { return is_done_; });
  }
  void join() { thread_.join(); }
  std::exception_ptr error() const { return error_; }

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // the last, for it begins when it is made
};

void run_in_arena(std::optional<int> threads, const std::function<void()>& work) {
  if (!threads) return work();
  // TBB would say on the console that there are no more than that.
  tbb::task_arena arena(std::min(*threads, tbb::info::default_concurrency()));
  arena.execute(work);
}

}  // namespace

Call::Call(std::optional<int> threads_, py::object progress_)
    : threads(threads_), progress(std::move(progress_)) {
  if (threads) require_in_range("threads", *threads, 1, kMostThreads);
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0) {
    throw py::type_error("progress must be a function of a fraction");
  }
}

void run(const Call& call, const std::function<void(Progress&)>& work) {
  const CountedCall counted;
  CallProgress told;
  std::optional<py::error_already_set> raised;
  std::exception_ptr error;
  if (!call.progress.is_none()) call.progress(0.0);
  {
    std::optional<py::gil_scoped_release> unlocked(std::in_place);
    Worker worker([&] { run_in_arena(call.threads, [&] { work(told); }); });
    double shown = 0.0;
    while (!worker.wait(kBetweenSignals)) {
      if (all_work().ends) continue;  // the lock may never be had again
      unlocked.reset();
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!call.progress.is_none() && told.fraction() > shown) call.progress(shown = told.fraction());
      } catch (py::error_already_set& now) {
        told.stop();
        if (!raised) raised.emplace(std::move(now));
      }
      unlocked.emplace();
    }
    worker.join();
    error = worker.error();
  }
  if (raised) throw std::move(*raised);
  if (error) std::rethrow_exception(error);
  if (!call.progress.is_none()) call.progress(1.0);
}

void run_at_once(const std::function<void()>& work) {
  const CountedCall counted;
  const py::gil_scoped_release unlocked;
  work();
}

void stop_all_work() {
  all_work().ends = true;
  const py::gil_scoped_release unlocked;
  std::unique_lock lock(all_work().mutex);
  all_work().less.wait(lock, [] { return all_work().calls == 0; });
}

}  // namespace solidnoise::python
