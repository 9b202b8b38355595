#include "solidnoise/volume/vdb/parts_grid.h"

#include <algorithm>
#include <tuple>

namespace solidnoise {
namespace {

constexpr std::size_t kMostOpen = 64;

// What comes first in a tree: nodes are ordered within their parents, of 4096^3 voxels, and these among
// themselves.
auto place_of(const openvdb::Coord& origin) {
  constexpr openvdb::Int32 kParent = 4096;
  return std::tuple(origin & ~(kParent - 1), origin);
}

}  // namespace

VdbReader& PartReaders::open(std::size_t file) {
  const auto found =
      std::find_if(open_.begin(), open_.end(), [&](const Open& one) { return one.file == file; });
  if (found != open_.end()) {
    open_.splice(open_.begin(), open_, found);
  } else {
    open_.push_front({file, std::make_unique<VdbReader>(files_[file])});
    if (open_.size() > kMostOpen) open_.pop_back();
  }
  return *open_.front().reader;
}

void PartsGrid::add_part(std::size_t file, const openvdb::GridBase& grid) {
  active_ += grid.activeVoxelCount();
  if (!grid.empty()) bounds_.expand(grid.evalActiveVoxelBoundingBox());
  for (const VdbNode& node :
       readers_.with(file, [&](VdbReader& reader) { return reader.find_nodes(index_); })) {
    pieces_.push_back({static_cast<std::uint32_t>(file), node});
  }
}

void PartsGrid::finish() {
  std::sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
    return std::tuple(place_of(a.node.origin), a.file) < std::tuple(place_of(b.node.origin), b.file);
  });
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const VdbNode& node = pieces_[i].node;
    if (nodes_.empty() || nodes_.back().origin != node.origin) {
      nodes_.push_back({node.origin, 0});
      first_pieces_.push_back(i);
    }
    nodes_.back().leaves += node.leaves;
  }
  first_pieces_.push_back(pieces_.size());
}

template <typename Tree, typename Read>
void PartsGrid::read_pieces(std::size_t node, Tree& tree, const Read& read) const {
  for (std::size_t i = first_pieces_[node]; i < first_pieces_[node + 1]; ++i) {
    const Piece& piece = pieces_[i];
    readers_.with(piece.file, [&](VdbReader& reader) {
      const openvdb::Index32 before = tree.leafCount();
      read(reader, piece.node);
      if (tree.leafCount() != before + piece.node.leaves)
        throw std::runtime_error("overlaps with another part");
    });
  }
}

openvdb::MaskTree::Ptr PartsGrid::voxels(std::size_t first, std::size_t end) const {
  auto mask = std::make_shared<openvdb::MaskTree>(false);
  for (std::size_t node = first; node < end; ++node) {
    read_pieces(node, *mask,
                [&](VdbReader& reader, const VdbNode& piece) { reader.read_voxels(index_, piece, *mask); });
  }
  return mask;
}

template <typename Grid>
typename Grid::Ptr PartsGrid::values(const openvdb::MaskTree& slab) const {
  const auto grid = Grid::create();
  const auto before = [](const Node& node, const openvdb::Coord& origin) {
    return place_of(node.origin) < place_of(origin);
  };
  for (auto upper = slab.root().cbeginChildOn(); upper; ++upper) {
    for (auto lower = upper->cbeginChildOn(); lower; ++lower) {
      const auto node = std::lower_bound(nodes_.begin(), nodes_.end(), lower->origin(), before);
      read_pieces(
          static_cast<std::size_t>(node - nodes_.begin()), grid->tree(),
          [&](VdbReader& reader, const VdbNode& piece) { reader.read_values(index_, piece, grid->tree()); });
    }
  }
  return grid;
}

template openvdb::FloatGrid::Ptr PartsGrid::values<openvdb::FloatGrid>(const openvdb::MaskTree&) const;
template openvdb::Vec3SGrid::Ptr PartsGrid::values<openvdb::Vec3SGrid>(const openvdb::MaskTree&) const;

}  // namespace solidnoise
