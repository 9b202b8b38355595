// What would read grids: recipes that need it are refused before (refuse_files() in recipes.cpp).

#include <stdexcept>

#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/slice/grid_slice.h"

namespace solidnoise {
namespace {

[[noreturn]] void refuse() {
  throw std::logic_error("grids are for vdbnoise");
}

}  // namespace

KernelFields ParameterFields::kernel() const {
  refuse();
}

std::vector<SliceField> make_grid_slices(const SliceRecipe&) {
  refuse();
}

}  // namespace solidnoise
