#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "solidnoise/core/progress.h"

namespace solidnoise {

// A file to read from which asks, each megabyte at least, whether to stop: then what is reading throws
// Cancelled, streams whose exceptions() have badbit among it.
class CancellableFile final : public std::filebuf {
 public:
  CancellableFile(const std::filesystem::path& path, Progress* progress) : progress_(progress) {
    open(path, std::ios::in | std::ios::binary);
  }

 protected:
  std::streamsize xsgetn(char* target, std::streamsize count) override {
    std::streamsize read = 0;
    while (read < count) {
      throw_if_cancelled(progress_);
      const std::streamsize part = std::min<std::streamsize>(count - read, 1 << 20);
      const std::streamsize got = std::filebuf::xsgetn(target + read, part);
      read += got;
      if (got < part) break;
    }
    return read;
  }

 private:
  Progress* progress_;
};

}  // namespace solidnoise
