#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"

// Whatever can be read as a .vdb can be measured, and written again.

namespace solidnoise {
namespace {

// A file without a name, in memory.
class FileInMemory {
 public:
  FileInMemory() : descriptor_(memfd_create("fuzzed", 0)) {
    if (descriptor_ < 0) std::abort();
  }
  ~FileInMemory() { close(descriptor_); }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  void write(const std::uint8_t* data, std::size_t size) const {
    if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, data, size, 0) != static_cast<ssize_t>(size))
      std::abort();
  }

 private:
  int descriptor_;
};

void check(const std::string& path) {
  read_vdb_summary(path);
  const VdbFile file = read_grids(path);
  std::ostringstream stream;
  write_vdb(stream, {file.grids.begin(), file.grids.end()}, {.codec = Codec::none});
}

}  // namespace
}  // namespace solidnoise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const solidnoise::FileInMemory file;
  file.write(data, size);
  try {
    solidnoise::check(file.path());
  } catch (const std::runtime_error& error) {
    if (!std::string_view(error.what()).starts_with(file.path())) std::abort();
  }
  return 0;
}
