#include <gtest/gtest.h>

#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise::one_unit_test {
namespace {

// Each name has one meaning in all of the library, so that a program may use volumes and meshes.
TEST(Headers, OfVolumesAndOfMeshesGoTogether) {
  EXPECT_NO_THROW(VolumeRecipe().validate());
  EXPECT_NO_THROW(BakeRecipe().validate());
}

}  // namespace
}  // namespace solidnoise::one_unit_test
