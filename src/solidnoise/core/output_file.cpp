#include "solidnoise/core/output_file.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <ostream>
#include <random>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace solidnoise {
namespace {

[[noreturn]] void fail(const std::string& name, const char* what) {
  throw std::runtime_error(fmt::format("{}: {}: {}", name, what, std::generic_category().message(errno)));
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

TemporaryFile::TemporaryFile(std::filesystem::path target) : target_(std::move(target)) {
  constexpr std::size_t kLongestPart = 200;  // of a file name, of which systems allow 255 bytes
  std::random_device random;
  const std::string name = target_.filename().string().substr(0, kLongestPart);
  path_ = target_.parent_path() /
          fmt::format(".{}.tmp-{}-{:08x}", name, ::getpid(), static_cast<std::uint32_t>(random()));
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(target_.string(), "cannot be written");
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!path_.empty()) ::unlink(path_.c_str());
}

void TemporaryFile::close() {
  // Some file systems cannot synchronise, and say EINVAL.
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(target_.string(), "writing failed");
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(target_.string(), "writing failed");
}

void TemporaryFile::replace_target() {
  if (::rename(path_.c_str(), target_.c_str()) != 0) fail(target_.string(), "cannot be written");
  path_.clear();
}

bool TemporaryFile::become_target() {
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0) {
    path_.clear();
    return true;
  }
  if (errno == EEXIST) return false;
  // Not every file system knows this kind of renaming.
  if (errno != EINVAL && errno != ENOSYS) fail(target_.string(), "cannot be written");
  if (std::filesystem::exists(target_)) return false;
  replace_target();
  return true;
}

namespace {

// The file that a path names, through links.
std::filesystem::path resolve(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  return error ? path : target;
}

void write_to_descriptor(int descriptor, const std::string& name, Progress* progress,
                         const std::function<void(std::ostream&)>& write) {
  CheckedFileBuffer buffer(descriptor, name, progress);
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::badbit | std::ios::failbit);
  write(stream);
  stream.flush();
}

}  // namespace

void require_writable(const std::filesystem::path& path, Existing existing) {
  if (path == "-") return;
  const std::filesystem::path target = resolve(path);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(target, error);
  if (!target.has_filename() || std::filesystem::is_directory(status)) {
    throw std::runtime_error(fmt::format("{}: is a folder; a file name is needed", path.string()));
  }
  if (std::filesystem::exists(status)) {
    if (!std::filesystem::is_regular_file(status)) {
      throw std::runtime_error(fmt::format("{}: is not a regular file", path.string()));
    }
    if (existing == Existing::refuse) throw OutputExists(path);
  }
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, error)) {
    throw std::runtime_error(fmt::format("{}: there is no folder {}", path.string(), folder.string()));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw std::runtime_error(fmt::format("{}: cannot write in {}: {}", path.string(), folder.string(),
                                         std::generic_category().message(errno)));
  }
}

void write_output(const std::filesystem::path& path, const OutputOptions& options,
                  const std::function<void(std::ostream&)>& write) {
  if (path == "-") {
    write_to_descriptor(STDOUT_FILENO, "standard output", options.progress, write);
    return;
  }
  require_writable(path, options.existing);
  TemporaryFile file(resolve(path));
  write_to_descriptor(file.descriptor(), path.string(), options.progress, write);
  file.close();
  if (options.verify) options.verify(file.path());
  throw_if_cancelled(options.progress);
  if (options.existing == Existing::replace) {
    file.replace_target();
  } else if (!file.become_target()) {
    throw OutputExists(path);
  }
}

}  // namespace solidnoise
