#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

// A library to be loaded before others, by LD_PRELOAD, that lets a call of the system fail, or kills the
// process at it. SOLIDNOISE_FAULT says which: "write 3 fail", "linkat 1 kill"; writing counts on files alone,
// "malloc" from kLargeAllocation on, but not under the address sanitizer, which has its own. "open 1 fail"
// stands for a file system without files that have no name.

namespace {

constexpr std::size_t kLargeAllocation = std::size_t{1} << 14;  // bytes

struct Fault {
  char call[16] = "";
  int number = 0;
  char deed[8] = "";
};

Fault wanted() {
  Fault fault;
  if (const char* const text = std::getenv("SOLIDNOISE_FAULT")) {
    std::sscanf(text, "%15s %d %7s", fault.call, &fault.number, fault.deed);
  }
  return fault;
}

// Whether this call is to fail.
bool fails(const char* call, int fault_number) {
  static const Fault fault = wanted();
  static std::atomic<int> calls{0};
  if (std::strcmp(call, fault.call) != 0 || ++calls != fault.number) return false;
  constexpr std::string_view kStruck = "the call has failed\n";
  if (::write(STDERR_FILENO, kStruck.data(), kStruck.size()) < 0) std::abort();
  if (std::strcmp(fault.deed, "kill") == 0) std::raise(SIGKILL);
  errno = fault_number;
  return true;
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

#ifndef __SANITIZE_ADDRESS__
void* __libc_malloc(size_t size) noexcept;

// dlsym() may call it.
void* malloc(size_t size) noexcept {
  return size >= kLargeAllocation && fails("malloc", ENOMEM) ? nullptr : __libc_malloc(size);
}
#endif

ssize_t write(int descriptor, const void* bytes, size_t count) {
  struct stat status = {};
  const bool to_file = descriptor > 2 && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  if (to_file && fails("write", ENOSPC)) return -1;
  return real<decltype(write)>("write")(descriptor, bytes, count);
}

int fsync(int descriptor) {
  return fails("fsync", EIO) ? -1 : real<decltype(fsync)>("fsync")(descriptor);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  if (fails("linkat", EACCES)) return -1;
  return real<decltype(linkat)>("linkat")(from_folder, from, to_folder, to, flags);
}

int rename(const char* from, const char* to) noexcept {
  return fails("rename", EACCES) ? -1 : real<decltype(rename)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned int flags) noexcept {
  if (fails("renameat2", EACCES)) return -1;
  return real<decltype(renameat2)>("renameat2")(from_folder, from, to_folder, to, flags);
}

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  if ((flags & O_TMPFILE) == O_TMPFILE && fails("open", EOPNOTSUPP)) return -1;
  return real<int(const char*, int, ...)>("open")(path, flags, mode);
}
}
