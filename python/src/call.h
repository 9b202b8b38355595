#pragma once

#include <functional>
#include <optional>
#include <pybind11/pybind11.h>
#include <stdexcept>

#include "solidnoise/core/progress.h"

namespace solidnoise::python {

namespace py = pybind11;

// What made a file, in its metadata.
inline constexpr char kCreator[] = "solidnoise " SOLIDNOISE_VERSION;

// What every call that may take long can be given: how many threads it has, and whom it tells how far it is.
struct Call {
  std::optional<int> threads;
  py::object progress;  // None, or called with the fraction that is done

  // Throws std::invalid_argument for a number of threads that there cannot be, py::type_error for a
  // `progress` that cannot be called.
  Call(std::optional<int> threads_, py::object progress_);
};

// A call would take more memory than the caller allows: MemoryError in Python.
class TooMuchMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Runs work without the interpreter's lock, on another thread and those of an arena of its own. The calling
// thread meanwhile answers signals and calls `progress`; where one of these raises, the work is asked to
// stop, and what was raised is thrown. Throws what the work throws.
void run(const Call& call, const std::function<void(Progress&)>& work);

// Work that takes no time worth a thread: only the lock is released.
void run_at_once(const std::function<void()>& work);

// Stops all work, and waits for it: called when the interpreter is about to end.
void stop_all_work();

}  // namespace solidnoise::python
