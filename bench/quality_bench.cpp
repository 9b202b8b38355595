#include <memory>
#include <string>

#include "block_bench.h"
#include "noise_bench.h"
#include "quality_cases.h"

namespace solidnoise::bench {
namespace {

constexpr int kSide = 64;  // of the blocks that volumes are filled in

// Noise within an error of 2 %, every voxel summed, or split between the kernel and interpolation.
void add_budget(std::vector<Ratio>& ratios, const BudgetCase& budget,
                Evaluated evaluated = Evaluated::values) {
  const bool gradient = evaluated != Evaluated::values;
  const std::string name = budget.name() + (gradient ? "/gradient" : "");
  using Make = std::shared_ptr<const Noise<3>> (BudgetCase::*)() const;
  const auto add = [&](const std::string& suffix, Make make) {
    benchmark::RegisterBenchmark((name + suffix).c_str(), [=](benchmark::State& state) {
      evaluate_blocks<3>(state, *(budget.*make)(), kSide, evaluated);  // made anew: it keeps samples
    });
  };
  add("/direct", &BudgetCase::direct);
  add("/budget", &BudgetCase::interpolated);
  const bool goal = budget == BudgetCase{} && !gradient;
  ratios.push_back({name.substr(std::string("gabor/3/").size()) + " within 2 %, over direct",
                    name + "/direct", name + "/budget", goal ? 3.0 : 0.0, goal ? 4.0 : 0.0});
}

}  // namespace

void add_budgets(std::vector<Ratio>& ratios) {
  for (const int impulses : {8, 32, 64, 256}) add_budget(ratios, {.impulses = impulses});
  for (const int impulses : {8, 64, 256}) add_budget(ratios, {.impulses = impulses, .radius = 64});
  for (const int radius : {4, 6, 8, 32, 64, 128}) add_budget(ratios, {.radius = radius});
  for (const int octaves : {2, 4, 8}) add_budget(ratios, {.octaves = octaves});
  for (const int radius : {16, 32, 64})
    add_budget(ratios, {.radius = radius}, Evaluated::values_and_gradient);
}

// Generators of the same quality, not of the same number of impulses.
void add_equal_quality(std::vector<Ratio>& ratios) {
  const std::string name = "equal-quality/3/";
  using Make = std::shared_ptr<const Noise<3>> (*)(Generator);
  const auto add = [&](const std::string& suffix, Make make, Generator generator) {
    benchmark::RegisterBenchmark((name + suffix).c_str(), [=](benchmark::State& state) {
      evaluate_blocks<3>(state, *make(generator), kSide);
    });
  };
  add("isotropic/direct", equal_quality_direct, Generator::isotropic);
  add("directions/direct", equal_quality_direct, Generator::directions);
  add("isotropic/budget", equal_quality_budget, Generator::isotropic);
  add("directions/budget", equal_quality_budget, Generator::directions);
  add("isotropic-poisson/budget", equal_quality_budget, Generator::isotropic_poisson);
  add("directions-poisson/budget", equal_quality_budget, Generator::directions_poisson);
  add("kensler", equal_quality_direct, Generator::kensler);
  const auto add_gradient = [&](const std::string& suffix, Evaluated evaluated, Generator generator) {
    benchmark::RegisterBenchmark((name + suffix).c_str(), [=](benchmark::State& state) {
      evaluate_blocks<3>(state, *equal_quality_direct(generator), kSide, evaluated);
    });
  };
  add_gradient("isotropic/direct/gradient", Evaluated::gradient, Generator::isotropic);
  add_gradient("isotropic/direct/both", Evaluated::values_and_gradient, Generator::isotropic);
  add_gradient("directions/direct/gradient", Evaluated::gradient, Generator::directions);
  add_gradient("directions/direct/both", Evaluated::values_and_gradient, Generator::directions);
  const auto compare = [&](const std::string& title, const std::string& slow, const std::string& fast) {
    ratios.push_back({"equal quality: " + title, name + slow, name + fast});
  };
  compare("random directions over isotropic kernels", "isotropic/direct", "directions/direct");
  compare("random directions over isotropic kernels, within 2 %", "isotropic/budget", "directions/budget");
  compare("Kensler over random directions", "directions/direct", "kensler");
  compare("random directions over Kensler, within 2 %", "kensler", "directions/budget");
  compare("isotropic, gradient alone over one beside values", "isotropic/direct/both",
          "isotropic/direct/gradient");
  compare("random directions, gradient alone over one beside values", "directions/direct/both",
          "directions/direct/gradient");
  compare("isotropic, strata over Poisson, within 2 %", "isotropic-poisson/budget", "isotropic/budget");
  compare("random directions, strata over Poisson, within 2 %", "directions-poisson/budget",
          "directions/budget");
}

}  // namespace solidnoise::bench
