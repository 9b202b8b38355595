#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tools/run_vdbnoise.h"

namespace solidnoise::openvdb_tools_test {
namespace {

// Files that OpenVDB's own program and Python module make, and what they read of ours. Skipped where they are
// not installed.
class OpenVdbTools : public testing::Test {
 protected:
  void SetUp() override {
    const std::string tools = "/usr/bin/python3 -c 'import pyopenvdb' && vdb_print --version";
    if (std::system(("(" + tools + ") >/dev/null 2>&1").c_str()) != 0) {
      GTEST_SKIP() << "vdb_print or pyopenvdb is not installed";
    }
  }

  // Runs a script of Python's, which may assert, in the test's folder.
  void run_python(const std::string& script) const {
    folder_.write("script.py", "import pyopenvdb as vdb\n" + script);
    EXPECT_EQ(std::system(("cd '" + folder_.path().string() + "' && /usr/bin/python3 script.py").c_str()), 0)
        << script;
  }

  void run_well(const std::vector<std::string>& arguments) const {
    const ToolResult result = run_vdbnoise(arguments, {.folder = folder_.path()});
    EXPECT_EQ(result.status, 0) << result.err;
  }

  bool prints(const std::string& file, const std::string& line) const {
    const std::string command = "vdb_print -l '" + folder_.file(file) + "' | grep -q '" + line + "'";
    return std::system(command.c_str()) == 0;
  }

  TemporaryFolder folder_;
};

// A density of voxels and a tile, with an offset and another grid beside it. With --combine add and an amount
// of 0 every value must come back.
TEST_F(OpenVdbTools, ADensityFromPythonKeepsItsValuesAndNeighbours) {
  run_python(R"(
density = vdb.FloatGrid()
density.name = 'density'
density.gridClass = vdb.GridClass.FOG_VOLUME
density.transform = vdb.createLinearTransform(voxelSize=0.1)
density.transform.translate((3, 0, -2))
density.fill((0, 0, 0), (31, 31, 31), 0.25)
for i in range(40): density.getAccessor().setValueOn((i, 50, -i), i / 64)
density['artist'] = 'python'
heat = vdb.BoolGrid()
heat.name = 'burning'
heat.fill((0, 0, 0), (3, 3, 3), True)
vdb.write('in.vdb', grids=[heat, density], metadata={'shot': 'c30'})
)");
  run_well({"--on", "in.vdb:density", "--combine", "add", "--amount", "0", "--out", "same.vdb", "--quiet"});
  run_well({"--on", "in.vdb:density", "--combine", "multiply", "--frequency", "1", "--out", "noisy.vdb",
            "--quiet"});
  run_python(R"(
before = vdb.read('in.vdb', 'density')
for name in ('same.vdb', 'noisy.vdb'):
  grids, metadata = vdb.readAll(name)
  assert [g.name for g in grids] == ['burning', 'density'], grids
  assert metadata['shot'] == 'c30'
  after = grids[1]
  assert after.gridClass == 'fog volume' and after['artist'] == 'python'
  assert after.transform == before.transform and after.background == before.background
  assert after.activeVoxelCount() == before.activeVoxelCount()
  assert grids[0].activeVoxelCount() == 64
  a, b = before.getConstAccessor(), after.getConstAccessor()
  different = sum(a.getValue(c) != b.getValue(c) for c in
                  [(x, y, z) for x in range(32) for y in range(0, 32, 7) for z in range(0, 32, 5)])
  assert different == 0 if name == 'same.vdb' else different > 900, different
  low, high = after.evalMinMax()
  assert abs(low - after['solidnoise:min']) < 1e-6 and abs(high - after['solidnoise:max']) < 1e-6
)");
  EXPECT_TRUE(prints("noisy.vdb", "class: fog volume"));
}

// What is made from nothing: of half floats and of vectors, in each codec.
TEST_F(OpenVdbTools, ReadWhatIsMade) {
  for (const std::string codec : {"blosc", "zip", "none"}) {
    run_well({"--raw", "--dim", "24", "--codec", codec, "--half", "--out", codec + ".vdb", "--quiet"});
    EXPECT_TRUE(prints(codec + ".vdb", "solidnoise:recipe")) << codec;
  }
  run_well({"--output", "value,gradient", "--dim", "24", "--out", "slope.vdb", "--quiet"});
  run_python(R"(
first = vdb.read('blosc.vdb', 'density')
for codec in ('blosc', 'zip', 'none'):
  grid = vdb.read(codec + '.vdb', 'density')
  assert grid.activeVoxelCount() == 24**3 and grid.saveFloatAsHalf
  assert grid.evalMinMax() == first.evalMinMax()
  assert '"gabor"' in grid['solidnoise:recipe']
grids, _ = vdb.readAll('slope.vdb')
assert [(g.name, g.valueTypeName) for g in grids] == [('density', 'float'), ('gradient', 'vec3s')], grids
assert grids[1].vectorType == 'covariant'
)");
  EXPECT_TRUE(prints("slope.vdb", "vector_type: covariant"));
}

}  // namespace
}  // namespace solidnoise::openvdb_tools_test
