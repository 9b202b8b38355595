#include "solidnoise/volume/vdb/single_precision.h"

#include <memory>

namespace solidnoise {

openvdb::Vec3SGrid::ConstPtr in_single_precision(const openvdb::GridBase& grid) {
  using openvdb::Vec3s;
  using openvdb::Vec3SGrid;
  if (grid.isType<Vec3SGrid>()) return static_cast<const Vec3SGrid&>(grid).copy();
  if (!grid.isType<openvdb::Vec3DGrid>()) return nullptr;
  const auto& doubles = static_cast<const openvdb::Vec3DGrid&>(grid);
  const auto floats = Vec3SGrid::create();
  floats->setName(doubles.getName());
  floats->setTransform(doubles.transform().copy());
  floats->setTree(std::make_shared<openvdb::Vec3STree>(doubles.tree(), Vec3s(doubles.background()),
                                                       openvdb::TopologyCopy()));
  const auto values = doubles.getConstAccessor();
  for (auto value = floats->beginValueOn(); value; ++value) {
    value.setValue(Vec3s(values.getValue(value.getCoord())));
  }
  return floats;
}

}  // namespace solidnoise
