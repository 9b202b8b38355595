#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace solidnoise {

// Walks over what comes before a grid's tree in a .vdb, and throws std::exception of any kind if a size in it
// reaches past the end of the file, or is not that of the value's type, or a truth value is neither 0 nor 1:
// OpenVDB allocates whatever size it finds, and goes by the type, so that it would come to what stands
// elsewhere in the file.
class VdbHeaderWalk {
 public:
  VdbHeaderWalk(std::istream& stream, std::int64_t file_size) : stream_(stream), file_size_(file_size) {}

  // Each goes past what it checks.
  void skip_metadata();
  void skip_string();
  std::uint32_t take_size();

  void require_in_file(std::int64_t position) const;

 private:
  void skip_value();
  void skip_delayed_load(std::uint32_t size);
  std::int64_t end_after(std::uint32_t size);
  std::string take_string();

  std::istream& stream_;
  const std::int64_t file_size_;
};

}  // namespace solidnoise
