#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "fuzz/file_in_memory.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"

// Whatever can be read as a .vdb can be measured, and written again.

namespace solidnoise {
namespace {

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
  file.write({data, size});
  try {
    solidnoise::check(file.path());
  } catch (const std::runtime_error& error) {
    if (!std::string_view(error.what()).starts_with(file.path())) std::abort();
  }
  return 0;
}
