#include "solidnoise/core/input_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace solidnoise {
namespace {

class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path) : path_(path) {
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0 || ::fstat(descriptor_, &status_) != 0) fail();
    if (S_ISDIR(status_.st_mode)) refuse("is a folder, not a file");
    if (!S_ISREG(status_.st_mode) && !S_ISFIFO(status_.st_mode)) refuse("is a device, not a file");
  }
  ~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  // Of a regular file.
  std::uint64_t size() const { return static_cast<std::uint64_t>(std::max<off_t>(status_.st_size, 0)); }

  // How many bytes were read; 0 at the end.
  std::size_t read(char* bytes, std::size_t count) {
    for (;;) {
      const ssize_t done = ::read(descriptor_, bytes, count);
      if (done >= 0) return static_cast<std::size_t>(done);
      if (errno != EINTR) fail();
    }
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", path_.string(), what));
  }

 private:
  [[noreturn]] void fail() const { refuse("cannot be read: " + std::generic_category().message(errno)); }

  const std::filesystem::path& path_;
  struct stat status_ = {};
  int descriptor_ = -1;
};

}  // namespace

std::string read_file(const std::filesystem::path& path, std::uint64_t most_bytes) {
  InputFile file(path);
  const auto refuse_length = [&] { file.refuse(fmt::format("has more than {} bytes", most_bytes)); };
  if (file.size() > most_bytes) refuse_length();
  constexpr std::size_t kFirst = std::size_t{1} << 16;  // of a pipe, which does not know its length
  std::string bytes(std::max(kFirst, static_cast<std::size_t>(file.size()) + 1), '\0');
  std::size_t count = 0;
  while (const std::size_t more = file.read(bytes.data() + count, bytes.size() - count)) {
    count += more;
    if (count > most_bytes) refuse_length();
    if (count == bytes.size()) bytes.resize(2 * bytes.size());
  }
  bytes.resize(count);
  return bytes;
}

}  // namespace solidnoise
