#include "solidnoise/volume/vdb/vdb_header.h"

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include <openvdb/io/DelayedLoadMetadata.h>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {
namespace {

using openvdb::io::DelayedLoadMetadata;

[[noreturn]] void refuse_size(const std::string& type) {
  throw std::runtime_error("a value of type " + type + " in its metadata has a wrong size");
}

}  // namespace

void VdbHeaderWalk::skip_metadata() {
  const std::uint32_t count = take_size();
  for (std::uint32_t i = 0; i < count; ++i) {
    skip_string();  // name
    skip_value();
  }
}

// A type, a size and as many bytes.
void VdbHeaderWalk::skip_value() {
  const std::string type = take_string();
  const std::uint32_t size = take_size();
  const std::int64_t end = end_after(size);
  if (type == DelayedLoadMetadata::staticTypeName()) {
    skip_delayed_load(size);
    if (stream_.tellg() > end) refuse_size(type);
  } else if (type != openvdb::StringMetadata::staticTypeName() && openvdb::Metadata::isRegisteredType(type)) {
    if (openvdb::Metadata::createMetadata(type)->size() != size) refuse_size(type);
    if (type == openvdb::BoolMetadata::staticTypeName() && stream_.get() > 1) {
      throw std::runtime_error("a value of type bool in its metadata is neither 0 nor 1");
    }
  }
  stream_.seekg(end);
}

// Two lists of one length, a byte and eight for each leaf, by which leaves are read later on. Each is plain,
// or so many bytes that Blosc made, whose header of 16 bytes says how many there were.
void VdbHeaderWalk::skip_delayed_load(std::uint32_t size) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  constexpr std::uint64_t kBloscHeader = 16;
  constexpr std::uint64_t kPadding = 128;             // bytes that OpenVDB makes of fewer, before Blosc
  constexpr std::uint64_t kLeafInFile = 2 * 512 / 8;  // its masks
  const std::string type = DelayedLoadMetadata::staticTypeName();
  if (size == 0) return;
  const std::uint64_t count = take_size();
  if (count > static_cast<std::uint64_t>(file_size_) / kLeafInFile) refuse_size(type);
  for (const std::size_t item :
       {sizeof(DelayedLoadMetadata::MaskType), sizeof(DelayedLoadMetadata::CompressedSizeType)}) {
    const std::uint32_t compressed = take_size();
    if (compressed == kNone && item > 1) return;
    const auto start = stream_.tellg();
    if (compressed > 0) {
      if (compressed < kBloscHeader) refuse_size(type);
      take_size();  // versions and flags
      const std::uint32_t plain = take_size();
      take_size();  // of a block
      if (plain > count * item + kPadding || take_size() > compressed) refuse_size(type);
    }
    const std::uint64_t bytes = compressed > 0 ? compressed : count * item;
    stream_.seekg(start + static_cast<std::streamoff>(bytes));
    require_in_file(stream_.tellg());
  }
}

void VdbHeaderWalk::skip_string() {
  stream_.seekg(end_after(take_size()));
}

std::string VdbHeaderWalk::take_string() {
  const std::uint32_t size = take_size();
  end_after(size);
  std::string text(size, '\0');
  stream_.read(text.data(), size);
  return text;
}

std::uint32_t VdbHeaderWalk::take_size() {
  std::uint32_t size = 0;
  stream_.read(reinterpret_cast<char*>(&size), sizeof(size));
  return size;
}

std::int64_t VdbHeaderWalk::end_after(std::uint32_t size) {
  const std::int64_t end = static_cast<std::int64_t>(size) + stream_.tellg();
  require_in_file(end);
  return end;
}

void VdbHeaderWalk::require_in_file(std::int64_t position) const {
  if (position < 0 || position > file_size_) throw std::runtime_error("it ends too early");
}

}  // namespace solidnoise
