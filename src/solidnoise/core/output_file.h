#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <stdexcept>

#include "solidnoise/core/progress.h"

namespace solidnoise {

// What becomes of a file that has the output's name already.
enum class Existing { refuse, replace };

// The output exists and was not to be replaced. The message names the path.
class OutputExists : public std::runtime_error {
 public:
  explicit OutputExists(const std::filesystem::path& path)
      : std::runtime_error(path.string() + ": exists already") {}
};

// Throws std::runtime_error naming the path if write_output could not begin: a folder that is not there or
// not writable, a path that is a folder or device; OutputExists if there is a file that is not to be
// replaced. "-" always passes. For a tool to call before hours of work.
void require_writable(const std::filesystem::path& path, Existing existing);

struct OutputOptions {
  Existing existing = Existing::refuse;
  Progress* progress = nullptr;  // asked for cancellation while writing
  // Called with the path of the temporary file once all is on the disk; may throw. Not for "-".
  std::function<void(const std::filesystem::path&)> verify = {};
};

// Writes a file, all or nothing: what `write` puts into the stream goes to a file `.NAME.tmp-PID-RANDOM`
// beside the target, is synchronised with the disk and renamed. Every write is checked, so that a full disk
// is reported. On any failure the temporary file is removed. "-" is the standard output. The stream throws;
// it can seek where the output can. Throws std::runtime_error naming the path, OutputExists, Cancelled.
//
// A program that is interrupted should set the flag behind Progress::cancelled() in its signal handler: it is
// looked at for every megabyte written, and the exception removes the temporary file.
void write_output(const std::filesystem::path& path, const OutputOptions& options,
                  const std::function<void(std::ostream&)>& write);

}  // namespace solidnoise
