#include "solidnoise/volume/vdb/vdb_structure.h"

#include <array>
#include <bit>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <openvdb/io/Compression.h>

namespace solidnoise {
namespace {

struct ValueFormat {
  std::uint64_t in_memory = 0;  // bytes
  std::uint64_t as_half = 0;    // bytes, where stored as half floats; 0 for what is never
  bool bits_in_leaves = false;  // leaves hold bits, in no chunks
};

ValueFormat value_format(const std::string& grid_type) {
  static const std::map<std::string, ValueFormat> kFormats = {
      {"Tree_bool_5_4_3", {1, 0, true}},    {"Tree_mask_5_4_3", {1, 0, true}},
      {"Tree_int32_5_4_3", {4, 0, false}},  {"Tree_int64_5_4_3", {8, 0, false}},
      {"Tree_float_5_4_3", {4, 2, false}},  {"Tree_double_5_4_3", {8, 2, false}},
      {"Tree_vec3i_5_4_3", {12, 0, false}}, {"Tree_vec3s_5_4_3", {12, 6, false}},
      {"Tree_vec3d_5_4_3", {24, 6, false}},
  };
  const auto format = kFormats.find(grid_type);
  if (format == kFormats.end()) throw std::runtime_error("grids of type " + grid_type + " cannot be read");
  return format->second;
}

// Values of a node on each level, from the root's children to the leaves.
constexpr std::uint64_t kValuesOfUpper = 32 * 32 * 32;
constexpr std::uint64_t kValuesOfLower = 16 * 16 * 16;
constexpr std::uint64_t kValuesOfLeaf = 8 * 8 * 8;

class TreeWalk {
 public:
  TreeWalk(std::istream& stream, std::int64_t file_size, const VdbTreeFormat& format)
      : stream_(stream),
        file_size_(file_size),
        compression_(format.compression),
        value_(value_format(format.grid_type)),
        half_(format.half && value_.as_half > 0) {}

  std::vector<VdbNode> run() {
    if (take<std::int32_t>() != 1) throw std::runtime_error("a tree's header is wrong");
    skip(value_.in_memory);  // background
    const auto tiles = take<std::uint32_t>();
    const auto children = take<std::uint32_t>();
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
      take_place();
      skip(value_.in_memory);
      if (take<std::uint8_t>() > 1) throw std::runtime_error("a tile is neither active nor inactive");
    }
    for (std::uint32_t child = 0; child < children; ++child) {
      walk_upper(take_place());
    }
    if (value_.bits_in_leaves) return std::move(nodes_);
    for (VdbNode& node : nodes_) {
      node.values = stream_.tellg();
      for (std::uint64_t leaf = 0; leaf < node.leaves; ++leaf) {
        // Its mask again, by which OpenVDB then reads its values.
        const std::uint64_t active = count(take_mask(kValuesOfLeaf));
        walk_values(kValuesOfLeaf, active);
      }
    }
    return std::move(nodes_);
  }

 private:
  using Mask = std::vector<std::uint64_t>;
  using Place = std::array<std::int32_t, 3>;

  // Of what the root has: where voxels of such a node begin, and nowhere twice.
  Place take_place() {
    constexpr std::int32_t kSide = 4096;
    const auto place = take<Place>();
    for (const std::int32_t index : place) {
      if (index % kSide != 0) throw std::runtime_error("a node begins where none can");
    }
    if (!places_.insert(place).second) throw std::runtime_error("two nodes have the same place");
    return place;
  }

  void walk_upper(const Place& place) {
    const Mask children = take_mask(kValuesOfUpper);
    walk_values(kValuesOfUpper, count(take_mask(kValuesOfUpper)));
    for (std::uint32_t child = 0; child < kValuesOfUpper; ++child) {
      if ((children[child / 64] >> child % 64 & 1) == 0) continue;
      constexpr std::int32_t kSide = 128;
      const openvdb::Coord at(static_cast<std::int32_t>(child >> 10),
                              static_cast<std::int32_t>(child >> 5 & 31),
                              static_cast<std::int32_t>(child & 31));
      walk_lower(openvdb::Coord(place[0], place[1], place[2]) +
                 openvdb::Coord(at.x() * kSide, at.y() * kSide, at.z() * kSide));
    }
  }

  void walk_lower(const openvdb::Coord& origin) {
    VdbNode node{origin, 0, stream_.tellg(), 0};
    node.leaves = count(take_mask(kValuesOfLower));
    walk_values(kValuesOfLower, count(take_mask(kValuesOfLower)));
    skip(node.leaves * (kValuesOfLeaf / 8));  // their masks
    if (node.leaves > 0) nodes_.push_back(node);
  }

  // The values of one node: a byte that says what inactive values there are, these, and a chunk.
  void walk_values(std::uint64_t values, std::uint64_t active) {
    namespace io = openvdb::io;
    const int kind = take<std::int8_t>();
    const bool two = kind == io::MASK_AND_TWO_INACTIVE_VALS;
    const bool one = two || kind == io::MASK_AND_ONE_INACTIVE_VAL || kind == io::NO_MASK_AND_ONE_INACTIVE_VAL;
    const bool mask = two || kind == io::MASK_AND_ONE_INACTIVE_VAL || kind == io::MASK_AND_NO_INACTIVE_VALS;
    skip((one ? value_.in_memory : 0) + (two ? value_.in_memory : 0) + (mask ? values / 8 : 0));

    const bool active_only =
        (compression_ & io::COMPRESS_ACTIVE_MASK) != 0 && kind != io::NO_MASK_AND_ALL_VALS;
    const std::uint64_t stored = active_only ? active : values;
    if (half_ && stored == 0) return;
    walk_chunk(stored * (half_ ? value_.as_half : value_.in_memory));
  }

  void walk_chunk(std::uint64_t bytes) {
    if ((compression_ & (openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ZIP)) == 0) {
      skip(bytes);
      return;
    }
    // Positive: so many bytes, compressed; else the negative of the bytes, which are not compressed.
    const auto size = take<std::int64_t>();
    if (size <= 0 && size != -static_cast<std::int64_t>(bytes)) {
      throw std::runtime_error("a chunk of values has a wrong size");
    }
    skip(size > 0 ? static_cast<std::uint64_t>(size) : bytes);
  }

  template <typename Value>
  Value take() {
    Value value{};
    stream_.read(reinterpret_cast<char*>(&value), sizeof(value));
    if (!stream_) throw std::runtime_error("it ends too early");
    return value;
  }

  Mask take_mask(std::uint64_t bits) {
    Mask mask(bits / 64);
    stream_.read(reinterpret_cast<char*>(mask.data()), static_cast<std::streamsize>(bits / 8));
    if (!stream_) throw std::runtime_error("it ends too early");
    return mask;
  }

  static std::uint64_t count(const Mask& mask) {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : mask) sum += static_cast<std::uint64_t>(std::popcount(word));
    return sum;
  }

  void skip(std::uint64_t bytes) {
    if (bytes == 0) return;
    const auto left = static_cast<std::uint64_t>(file_size_ - static_cast<std::int64_t>(stream_.tellg()));
    if (bytes > left) throw std::runtime_error("it ends too early");
    stream_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
  }

  std::istream& stream_;
  const std::int64_t file_size_;
  const std::uint32_t compression_;
  const ValueFormat value_;
  const bool half_;
  std::vector<VdbNode> nodes_;
  std::set<Place> places_;
};

}  // namespace

std::vector<VdbNode> check_vdb_tree(std::istream& stream, std::int64_t file_size,
                                    const VdbTreeFormat& format) {
  return TreeWalk(stream, file_size, format).run();
}

}  // namespace solidnoise
