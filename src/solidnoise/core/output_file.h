#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <ios>
#include <iosfwd>
#include <memory>
#include <stdexcept>
#include <streambuf>
#include <string>

#include "solidnoise/core/progress.h"

namespace solidnoise {

// A stream buffer over a file descriptor that reports every failure: C++'s own file streams, and OpenVDB over
// them, finish quietly on a full disk. Seeks, where the descriptor does. Errors are thrown as
// std::runtime_error naming the file; set the stream's exceptions(std::ios::badbit) to let them through.
// Throws Cancelled, at most a buffer's length after the wish.
class CheckedFileBuffer final : public std::streambuf {
 public:
  // `progress` may be null. The descriptor stays the caller's.
  CheckedFileBuffer(int descriptor, std::string name, Progress* progress);

 protected:
  int_type overflow(int_type c) override;
  int sync() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode which) override;
  pos_type seekpos(pos_type position, std::ios_base::openmode which) override;

 private:
  static constexpr std::size_t kSize = std::size_t{1} << 20;

  void flush();

  int descriptor_;
  std::string name_;
  Progress* progress_;
  std::unique_ptr<char[]> buffer_;
};

// A new, empty file beside a target, of the name `.NAME.tmp-PID-RANDOM`. It is removed by the destructor
// unless it took the target's place. Errors are std::runtime_error naming the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& path() const { return path_; }

  // Puts all that was written onto the disk and closes the file.
  void close();

  // Renames the closed file to the target.
  void replace_target();
  // The same, unless the target exists: false then.
  bool become_target();

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  int descriptor_ = -1;
};

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
