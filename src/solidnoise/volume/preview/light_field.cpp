#include "solidnoise/volume/preview/light_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

namespace solidnoise {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

// Cells along the longest side: shadows are seen, and what glows is far from most of what it lights.
constexpr int kSunCells = 128;
constexpr int kGlowCells = 20;

// How much of what matter takes from the light of what glows is lost; the rest goes on.
constexpr double kLost = 0.5;

}  // namespace

LightCells::LightCells(const openvdb::CoordBBox& box, int most) : lower_(box.min().asVec3d() - 0.5) {
  const Coord dim = box.dim();
  const int longest = std::max({dim.x(), dim.y(), dim.z()});
  size_ = longest / static_cast<double>(std::min(most, longest));
  for (int axis = 0; axis < 3; ++axis) count_[axis] = static_cast<int>(std::ceil(dim[axis] / size_));
  light_.assign(static_cast<std::size_t>(count_.x()) * static_cast<std::size_t>(count_.y()) *
                    static_cast<std::size_t>(count_.z()),
                Vec3f(0.0f));
}

bool LightCells::contains(const Coord& cell) const {
  return openvdb::CoordBBox({0, 0, 0}, count_.offsetBy(-1)).isInside(cell);
}

// Of the nearest cell, for those outside.
std::size_t LightCells::index(const Coord& cell) const {
  std::size_t index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    index = index * static_cast<std::size_t>(count_[axis]) +
            static_cast<std::size_t>(std::clamp(cell[axis], 0, count_[axis] - 1));
  }
  return index;
}

Vec3d LightCells::centre(const Coord& cell) const {
  return lower_ + size_ * (cell.asVec3d() + 0.5);
}

Vec3d LightCells::at(const Vec3d& index_space) const {
  const Vec3d place = (index_space - lower_) / size_ - 0.5;
  const Coord low = Coord::floor(place);
  const Vec3d part = place - low.asVec3d();
  Vec3d sum(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    Coord cell = low;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = (corner >> axis & 1) != 0;
      cell[axis] += upper ? 1 : 0;
      weight *= upper ? part[axis] : 1.0 - part[axis];
    }
    sum += weight * Vec3d(light_[index(cell)]);
  }
  return sum;
}

std::vector<Matter> LightCells::gather(const MakeMatter& make_matter) const {
  std::vector<Matter> means(light_.size());
  tbb::parallel_for(0, count_.x(), [&](int i) {
    const MatterAt matter_at = make_matter();
    for (int j = 0; j < count_.y(); ++j) {
      for (int k = 0; k < count_.z(); ++k) {
        Matter& mean = means[index({i, j, k})];
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3d off((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5);
          const Matter matter = matter_at(centre({i, j, k}) + 0.5 * size_ * off);
          mean.extinction += matter.extinction / 8.0;
          mean.emission += matter.emission / 8.0;
        }
      }
    }
  });
  return means;
}

namespace {

// Calls visit(cell) for all cells, in parallel.
template <typename Visit>
void for_each_cell(const LightCells& cells, const Visit& visit) {
  const Coord count = cells.count();
  tbb::parallel_for(0, count.x(), [&](int i) {
    for (int j = 0; j < count.y(); ++j) {
      for (int k = 0; k < count.z(); ++k) visit(Coord(i, j, k));
    }
  });
}

LightCells shine(const openvdb::CoordBBox& box, double voxel, const std::vector<Sun>& suns,
                 const MakeMatter& make_matter) {
  LightCells cells(box, kSunCells);
  const std::vector<Matter> matter = cells.gather(make_matter);
  const double length = cells.size() * voxel;
  for_each_cell(cells, [&](const Coord& cell) {
    Vec3d sum(0.0);
    for (const Sun& sun : suns) {
      double depth = 0.0;
      Vec3d place = cell.asVec3d() + sun.direction;
      for (Coord at = Coord::round(place); cells.contains(at); at = Coord::round(place)) {
        depth += matter[cells.index(at)].extinction * length;
        place += sun.direction;
      }
      sum += sun.colour * std::exp(-sun.lost * depth);
    }
    cells[cell] = Vec3f(sum);
  });
  return cells;
}

// Light falls with the square of the distance, and is dimmed as if all between were as where it arrives.
LightCells glow(const openvdb::CoordBBox& box, double voxel, const MakeMatter& make_matter) {
  struct Lamp {
    Vec3d place;
    Vec3d power;  // linear light times world units^2
  };
  LightCells cells(box, kGlowCells);
  const std::vector<Matter> matter = cells.gather(make_matter);
  const double length = cells.size() * voxel;
  std::vector<Lamp> lamps;
  for (auto cell = openvdb::CoordBBox({0, 0, 0}, cells.count().offsetBy(-1)).begin(); cell; ++cell) {
    const Vec3d& emission = matter[cells.index(*cell)].emission;
    if (emission != Vec3d(0.0)) lamps.push_back({cells.centre(*cell), emission * std::pow(length, 3)});
  }
  for_each_cell(cells, [&](const Coord& cell) {
    Vec3d sum(0.0);
    const double extinction = kLost * matter[cells.index(cell)].extinction;
    for (const Lamp& lamp : lamps) {
      const double distance = (lamp.place - cells.centre(cell)).length() * voxel;
      const double area = 4.0 * std::numbers::pi * (distance * distance + 0.25 * length * length);
      sum += lamp.power * (std::exp(-extinction * distance) / area);
    }
    cells[cell] = Vec3f(sum);
  });
  return cells;
}

}  // namespace

LightField::LightField(const openvdb::CoordBBox& box, double voxel, const std::vector<Sun>& suns,
                       const MakeMatter& make_matter)
    : sun_(shine(box, voxel, suns, make_matter)), glow_(glow(box, voxel, make_matter)) {}

}  // namespace solidnoise
