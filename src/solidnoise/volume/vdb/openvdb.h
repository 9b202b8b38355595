#pragma once

// The one way into OpenVDB: its big templates are compiled once, in openvdb.cpp, and not again in each file
// that uses a grid. Default visibility, because OpenVDB's registry of grid types must stay a single one also
// where this is included with -fvisibility=hidden (its initialize() crashes otherwise).

#pragma GCC visibility push(default)
#include <openvdb/openvdb.h>

namespace openvdb {
namespace OPENVDB_VERSION_NAME {
extern template class Grid<FloatTree>;
extern template class tree::Tree<FloatTree::RootNodeType>;
extern template class Grid<Vec3STree>;
extern template class tree::Tree<Vec3STree::RootNodeType>;
extern template class Grid<MaskTree>;
extern template class tree::Tree<MaskTree::RootNodeType>;
}  // namespace OPENVDB_VERSION_NAME
}  // namespace openvdb
#pragma GCC visibility pop
