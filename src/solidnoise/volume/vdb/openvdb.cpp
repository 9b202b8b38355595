#include "solidnoise/volume/vdb/openvdb.h"

namespace openvdb {
namespace OPENVDB_VERSION_NAME {
template class Grid<FloatTree>;
template class tree::Tree<FloatTree::RootNodeType>;
template class Grid<Vec3STree>;
template class tree::Tree<Vec3STree::RootNodeType>;
template class Grid<MaskTree>;
template class tree::Tree<MaskTree::RootNodeType>;
}  // namespace OPENVDB_VERSION_NAME
}  // namespace openvdb
