#include "solidnoise/core/checked_file.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <random>
#include <stdexcept>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace solidnoise {
namespace {

[[noreturn]] void fail(const std::string& name, const char* what) {
  throw std::runtime_error(fmt::format("{}: {}: {}", name, what, std::generic_category().message(errno)));
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

}  // namespace

CheckedFileBuffer::CheckedFileBuffer(int descriptor, std::string name, Progress* progress)
    : descriptor_(descriptor),
      name_(std::move(name)),
      progress_(progress),
      buffer_(std::make_unique<char[]>(kSize)) {
  setp(buffer_.get(), buffer_.get() + kSize);
}

void CheckedFileBuffer::flush() {
  throw_if_cancelled(progress_);
  const char* next = pbase();
  while (next < pptr()) {
    const ssize_t written = ::write(descriptor_, next, static_cast<std::size_t>(pptr() - next));
    if (written > 0) {
      next += written;
    } else if (written < 0 && errno == EINTR) {
      throw_if_cancelled(progress_);
    } else {
      fail(name_, "writing failed");
    }
  }
  setp(buffer_.get(), buffer_.get() + kSize);
}

CheckedFileBuffer::int_type CheckedFileBuffer::overflow(int_type c) {
  flush();
  if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
  return traits_type::not_eof(c);
}

int CheckedFileBuffer::sync() {
  flush();
  return 0;
}

CheckedFileBuffer::pos_type CheckedFileBuffer::seekoff(off_type offset, std::ios_base::seekdir direction,
                                                       std::ios_base::openmode) {
  flush();
  const int whence = direction == std::ios_base::beg   ? SEEK_SET
                     : direction == std::ios_base::cur ? SEEK_CUR
                                                       : SEEK_END;
  return pos_type(::lseek(descriptor_, offset, whence));
}

CheckedFileBuffer::pos_type CheckedFileBuffer::seekpos(pos_type position, std::ios_base::openmode which) {
  return seekoff(off_type(position), std::ios_base::beg, which);
}

NewFile::NewFile(std::filesystem::path target, std::filesystem::path shown, Existing existing)
    : target_(std::move(target)), shown_(std::move(shown)), existing_(existing) {
  struct stat old = {};
  const bool replaces = existing_ == Existing::replace && ::stat(target_.c_str(), &old) == 0;
  if (replaces) mode_ = old.st_mode & 0777;
  const mode_t mode = mode_.value_or(0666);
  if (!open_without_name(mode)) {
    hidden_ = hidden_path();
    descriptor_ = ::open(hidden_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor_ < 0) {
      hidden_.clear();
      fail("cannot be written");
    }
  }
  // Others' files become ours where the system does not let us give files away.
  if (replaces) [[maybe_unused]]
    const int ignored = ::fchown(descriptor_, old.st_uid, old.st_gid);
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!hidden_.empty()) ::unlink(hidden_.c_str());
}

void NewFile::fail(const char* what) const {
  solidnoise::fail(shown_.string(), what);
}

// Opening it by path(), and giving it a name, go through /proc.
bool NewFile::open_without_name(mode_t mode) {
  descriptor_ = ::open(folder_of(target_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
  if (descriptor_ < 0) return false;
  if (::access(path().c_str(), F_OK) == 0) return true;
  ::close(std::exchange(descriptor_, -1));
  return false;
}

std::filesystem::path NewFile::hidden_path() const {
  constexpr std::size_t kLongestPart = 200;  // of a file name, of which systems allow 255 bytes
  std::random_device random;
  const std::string name = target_.filename().string().substr(0, kLongestPart);
  return target_.parent_path() /
         fmt::format(".{}.tmp-{}-{:08x}", name, ::getpid(), static_cast<std::uint32_t>(random()));
}

std::filesystem::path NewFile::path() const {
  if (!hidden_.empty()) return hidden_;
  return fmt::format("/proc/self/fd/{}", descriptor_);
}

void NewFile::synchronize() {
  if (mode_ && ::fchmod(descriptor_, *mode_) != 0) fail("writing failed");
  // Some file systems cannot synchronise, and say EINVAL.
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail("writing failed");
}

// False if there is a file of this name.
bool NewFile::take_name(const std::filesystem::path& name) {
  if (hidden_.empty()) {
    if (::linkat(AT_FDCWD, path().c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) return true;
  } else {
    if (::renameat2(AT_FDCWD, hidden_.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) == 0 ||
        // Not every file system knows this kind of renaming.
        ((errno == EINVAL || errno == ENOSYS) && ::access(name.c_str(), F_OK) != 0 &&
         ::rename(hidden_.c_str(), name.c_str()) == 0)) {
      hidden_.clear();
      return true;
    }
  }
  if (errno != EEXIST) fail("cannot be written");
  return false;
}

void NewFile::appear() {
  named_anew_ = !mode_ && take_name(target_);
  if (!named_anew_) replace_target();
  if (synchronize_folder()) return;
  const int fault = errno;
  vanish();
  errno = fault;
  fail("writing failed");
}

void NewFile::replace_target() {
  if (existing_ == Existing::refuse) throw OutputExists(shown_);
  if (hidden_.empty()) {
    const std::filesystem::path hidden = hidden_path();
    if (!take_name(hidden)) fail("cannot be written");
    hidden_ = hidden;
  }
  keeps_replaced_ = ::renameat2(AT_FDCWD, hidden_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0;
  if (keeps_replaced_) return;
  // Not every file system can exchange two files.
  if (::rename(hidden_.c_str(), target_.c_str()) != 0) fail("cannot be written");
  hidden_.clear();
}

// The name is on the disk when the folder is.
bool NewFile::synchronize_folder() const {
  const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return true;  // one that may be written, but not read
  const bool done = ::fsync(folder) == 0 || errno == EINVAL;
  const int fault = errno;
  ::close(folder);
  errno = fault;
  return done;
}

void NewFile::vanish() {
  if (named_anew_) ::unlink(target_.c_str());
  if (keeps_replaced_) {
    ::renameat2(AT_FDCWD, hidden_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE);
  }
  named_anew_ = keeps_replaced_ = false;
}

}  // namespace solidnoise
