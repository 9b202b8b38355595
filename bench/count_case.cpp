// count_case NAME: evaluates one block of a noise, for counting instructions (scripts/bench.sh); --list
// prints the names and the number of voxels of each.
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "blocks.h"
#include "quality_cases.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"

namespace {

using namespace solidnoise;
using namespace solidnoise::bench;

using Make = std::function<std::shared_ptr<const Noise<3>>()>;

const std::map<std::string, Make, std::less<>>& cases() {
  static const std::map<std::string, Make, std::less<>> made{
      {"gabor/3/isotropic/N32/R16", [] { return make_gabor<GaborNoise, 3, GaborNoiseOptions>(16, 32); }},
      {"gabor/3/isotropic/N32/R6", [] { return make_gabor<GaborNoise, 3, GaborNoiseOptions>(6, 32); }},
      {"gabor/3/isotropic/N32/R16/budget", [] { return BudgetCase{}.interpolated(); }},
      {"gabor-oriented/3/random/N32/R16",
       [] { return make_gabor<OrientedGaborNoise, 3, OrientedGaborNoiseOptions>(16, 32); }},
      {"kensler/3/kensler/N-/R24",
       [] {
         const double frequency = GradientNoise<3>({.frequency = 1.0}).lattice_spacing()[0] / 12.0;
         return std::make_shared<GradientNoise<3>>(GradientNoiseOptions{.frequency = frequency});
       }},
  };
  return made;
}

}  // namespace

// Instructions are counted in here; a name that a command line can give.
extern "C" [[gnu::noinline]] void evaluate_case(const Noise<3>& noise, std::vector<float>& values) {
  evaluate_block<3>(noise, Index<3>(0), kBlock, {.values = values}, [] {});
}

int main(int argc, char** argv) {
  const std::string_view name = argc == 2 ? argv[1] : "";
  if (name == "--list") {
    for (const auto& [each, make] : cases()) std::cout << each << ' ' << kBlock * kBlock * kBlock << '\n';
    return 0;
  }
  const auto found = cases().find(name);
  if (found == cases().end()) {
    std::cerr << "count_case: give one name of --list\n";
    return 2;
  }
  const std::shared_ptr<const Noise<3>> noise = found->second();
  std::vector<float> values(kLeaf * kLeaf * kLeaf);
  evaluate_case(*noise, values);
  return 0;
}
