#pragma once

#include <filesystem>
#include <ios>
#include <memory>
#include <optional>
#include <streambuf>
#include <string>
#include <sys/types.h>

#include "solidnoise/core/output_file.h"
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

// A new, empty file in a target's folder that has no name, so that nothing is left of it if the process dies.
// Where the system knows no such files it is `.NAME.tmp-PID-RANDOM`, which the destructor removes. It has the
// mode of a file that it is to replace, and its owner where that may be. Errors are std::runtime_error naming
// the target, or OutputExists.
class NewFile {
 public:
  // `shown` stands for the target in messages.
  NewFile(std::filesystem::path target, std::filesystem::path shown, Existing existing);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  int descriptor() const { return descriptor_; }
  // By which what was written can be opened.
  std::filesystem::path path() const;

  // Puts all that was written onto the disk.
  void synchronize();

  // Gives it the target's name, for good. A file that is replaced is kept under a hidden name until the
  // destructor removes it.
  void appear();
  // Takes appear() back.
  void vanish();

 private:
  [[noreturn]] void fail(const char* what) const;
  bool open_without_name(mode_t mode);
  std::filesystem::path hidden_path() const;
  bool take_name(const std::filesystem::path& name);
  void replace_target();
  bool synchronize_folder() const;

  std::filesystem::path target_;
  std::filesystem::path shown_;
  Existing existing_;
  std::optional<mode_t> mode_;    // of the file that is to be replaced
  std::filesystem::path hidden_;  // the name that it has before the target's; empty: none
  bool named_anew_ = false;       // where there was no file
  bool keeps_replaced_ = false;   // under the hidden name
  int descriptor_ = -1;
};

}  // namespace solidnoise
