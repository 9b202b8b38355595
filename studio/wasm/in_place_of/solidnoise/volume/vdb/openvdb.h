#pragma once

// In the place of the one way into OpenVDB, which does not compile to WebAssembly: the names that recipes, plans and frames mention. There are no
// grids in the page: what would make or read one is declared only.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace openvdb {
inline namespace in_place {

struct Coord {
  std::array<std::int32_t, 3> index{};
  Coord() = default;
  std::int32_t& operator[](int axis) { return index[static_cast<std::size_t>(axis)]; }
  std::int32_t operator[](int axis) const { return index[static_cast<std::size_t>(axis)]; }
};

// An empty one has its upper corner below the lower one, as OpenVDB's.
struct CoordBBox {
  Coord lower;
  Coord upper;
  CoordBBox() { upper.index = {-1, -1, -1}; }
  CoordBBox(const Coord& low, const Coord& high) : lower(low), upper(high) {}
  const Coord& min() const { return lower; }
  const Coord& max() const { return upper; }
  bool empty() const { return upper[0] < lower[0]; }
};

struct Vec3d {
  std::array<double, 3> components{};
  explicit Vec3d(double all) : components{all, all, all} {}
  Vec3d() = default;
  Vec3d(double x, double y, double z) : components{x, y, z} {}
  double& operator[](int axis) { return components[static_cast<std::size_t>(axis)]; }
  double operator[](int axis) const { return components[static_cast<std::size_t>(axis)]; }
};
inline Vec3d operator-(const Vec3d& a, const Vec3d& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

struct MetaMap {};

namespace math {
struct MapBase {
  using Ptr = std::shared_ptr<MapBase>;
};
struct UniformScaleTranslateMap : MapBase {
  UniformScaleTranslateMap(double, const Vec3d&) {}
};
struct ScaleTranslateMap : MapBase {
  ScaleTranslateMap(const Vec3d&, const Vec3d&) {}
};
struct Transform {
  using Ptr = std::shared_ptr<Transform>;
  explicit Transform(const MapBase::Ptr&);
  Vec3d indexToWorld(const Vec3d&) const;
  Vec3d voxelSize() const;
  bool isLinear() const;
  static Ptr createLinearTransform(double);
};
}  // namespace math

enum VecType { VEC_INVARIANT, VEC_COVARIANT, VEC_CONTRAVARIANT_RELATIVE };

struct GridBase {
  using Ptr = std::shared_ptr<GridBase>;
  using ConstPtr = std::shared_ptr<const GridBase>;
  GridBase() = delete;
  std::string getName() const;
  std::string valueType() const;
  Ptr deepCopyGrid() const;
  CoordBBox evalActiveVoxelBoundingBox() const;
  Vec3d indexToWorld(const Vec3d&) const;
  void setVectorType(VecType);
  void setIsInWorldSpace(bool);
};
using GridPtrVec = std::vector<GridBase::Ptr>;
using GridCPtrVec = std::vector<GridBase::ConstPtr>;

template <typename Value>
struct Tree {
  using Ptr = std::shared_ptr<Tree>;
  struct LeafNodeType;
};
template <typename Value>
struct Grid : GridBase {
  using Ptr = std::shared_ptr<Grid>;
  using ConstPtr = std::shared_ptr<const Grid>;
  using ConstAccessor = int;
};
using FloatTree = Tree<float>;
using Vec3STree = Tree<std::array<float, 3>>;
using MaskTree = Tree<bool>;
using FloatGrid = Grid<float>;
using Vec3SGrid = Grid<std::array<float, 3>>;

template <typename To>
std::shared_ptr<To> gridPtrCast(const GridBase::Ptr& grid) {
  return std::static_pointer_cast<To>(grid);
}

}  // namespace in_place
}  // namespace openvdb
