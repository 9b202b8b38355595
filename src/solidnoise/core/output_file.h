#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <stdexcept>
#include <vector>

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

// The file that a path stands for, as an absolute path without links: that of a symbolic link is where it
// leads. Two paths stand for one file if these are equal. Throws std::runtime_error for a link that leads
// nowhere.
std::filesystem::path output_target(const std::filesystem::path& path);

// Throws std::runtime_error naming the path if write_output could not begin: a folder that is not there or
// not writable, a path that is a folder or device, a link that leads nowhere; OutputExists if there is a file
// or a link that is not to be replaced. "-" always passes. For a tool to call before hours of work.
void require_writable(const std::filesystem::path& path, Existing existing);

class NewFile;

// Outputs that appear together or not at all: those written for a group have their names when appear() gives
// them, which is after everything that can take long or fail for want of room.
class OutputGroup {
 public:
  OutputGroup();
  ~OutputGroup();
  OutputGroup(const OutputGroup&) = delete;
  OutputGroup& operator=(const OutputGroup&) = delete;

  // Throws what write_output does; then none of the files is there, and those that were replaced are.
  void appear();

 private:
  friend void write_output(const std::filesystem::path&, const struct OutputOptions&,
                           const std::function<void(std::ostream&)>&);

  std::vector<std::unique_ptr<NewFile>> files_;
};

struct OutputOptions {
  Existing existing = Existing::refuse;
  Progress* progress = nullptr;  // asked for cancellation while writing
  // Called with a path of the file once all is on the disk; may throw. Not for "-".
  std::function<void(const std::filesystem::path&)> verify = {};
  OutputGroup* group = nullptr;  // with which the file appears; null: by itself. Not for "-"
};

// Writes a file, all or nothing: what `write` puts into the stream goes to a file without a name in the
// target's folder (or a hidden one, where the system has no such files), is synchronised with the disk, as
// the folder is, and gets its name. Every write is checked, so that a full disk is reported. On any failure,
// or if the process dies, nothing is left. A file that is replaced hands on its mode; a symbolic link stays,
// and the file that it leads to is replaced. "-" is the standard output. The stream throws; it can seek where
// the output can. Throws std::runtime_error naming the path, OutputExists, Cancelled.
//
// To replace a file takes several calls of the system: a process that dies between them leaves a hidden file
// `.NAME.tmp-PID-RANDOM`, the new one or the old.
//
// A program that is interrupted should set the flag behind Progress::cancelled() in its signal handler: it is
// looked at for every megabyte written.
void write_output(const std::filesystem::path& path, const OutputOptions& options,
                  const std::function<void(std::ostream&)>& write);

}  // namespace solidnoise
