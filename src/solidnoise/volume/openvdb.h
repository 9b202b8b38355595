#pragma once

// The one way into OpenVDB. Its templates are instantiated in its own library: saying so here saves compiling
// them again in each of our files, and keeps a single copy of its grid registry when symbols are hidden.

#include <openvdb/openvdb.h>

namespace openvdb {
namespace OPENVDB_VERSION_NAME {
extern template class Grid<FloatTree>;
extern template class tree::Tree<FloatTree::RootNodeType>;
extern template class Grid<Vec3STree>;
extern template class tree::Tree<Vec3STree::RootNodeType>;
extern template class Grid<BoolTree>;
extern template class tree::Tree<BoolTree::RootNodeType>;
extern template class Grid<MaskTree>;
extern template class tree::Tree<MaskTree::RootNodeType>;
}  // namespace OPENVDB_VERSION_NAME
}  // namespace openvdb
