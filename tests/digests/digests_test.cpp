#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "digests/cases.h"
#include "digests/recipe_files.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/paths.h"
#include "support/simd_targets.h"

namespace solidnoise::digests_test {
namespace {

constexpr char kFile[] = "tests/golden/digests.json";
constexpr char kRenew[] = "SOLIDNOISE_RENEW_DIGESTS";

using Texts = std::map<std::string, std::string>;  // of digests, by the cases' names

Texts evaluate(const DigestCases& cases) {
  Texts texts;
  for (const DigestCase& one : cases) {
    try {
      Digest digest;
      one.evaluate(digest);
      EXPECT_TRUE(texts.emplace(one.name, digest.text()).second) << "two cases are called " << one.name;
    } catch (const std::exception& error) {
      ADD_FAILURE() << one.name << ": " << error.what();
    }
  }
  return texts;
}

// Instruction sets with fused multiply-adds, which all give the same values.
bool is_pinned(std::int64_t target) {
  return (target & (HWY_AVX2 | HWY_AVX3 | HWY_AVX3_DL)) != 0;
}

// With the code of each of them.
std::map<std::int64_t, Texts> evaluate_each_target(const DigestCases& cases) {
  std::map<std::int64_t, Texts> found;
  for_each_simd_target([&](std::int64_t target) {
    if (is_pinned(target)) found[target] = evaluate(cases);
  });
  return found;
}

bool is_of_group(const std::string& name, std::string_view group) {
  return name.substr(0, name.find('/')) == group;
}

// The names of the cases that differ, in lines; none where all agree.
std::string differences(const Texts& pinned, const Texts& found) {
  std::string text;
  for (const auto& [name, digest] : pinned) {
    const auto match = found.find(name);
    if (match == found.end()) {
      text += "\n  there is no case any more of " + name;
    } else if (match->second != digest) {
      text += "\n  other values: " + name;
    }
  }
  for (const auto& [name, digest] : found) {
    if (!pinned.contains(name)) text += "\n  there is no digest yet of " + name;
  }
  return text;
}

Texts pinned_of(const Json& file, std::string_view group) {
  Texts pinned;
  for (const auto& [name, digest] : file.at("digests").items()) {
    if (is_of_group(name, group)) pinned[name] = digest;
  }
  return pinned;
}

// Puts the digests of a group in the place of those that the file has.
void renew(std::string_view group, const Texts& found) {
  Texts all = found;
  const Json old = read_json(kFile);
  for (const auto& [name, digest] : old.at("digests").items()) {
    if (!is_of_group(name, group)) all[name] = digest;
  }
  std::ofstream(in_source(kFile)) << Json{{"algorithm", kAlgorithmVersion}, {"digests", all}}.dump(1) << '\n';
}

class Digests : public testing::TestWithParam<DigestGroup> {};

TEST_P(Digests, AreThoseOfTheAlgorithmVersionWithEachInstructionSet) {
  const std::string_view group = GetParam().name;
  const auto by_target = evaluate_each_target(GetParam().cases());
  if (by_target.empty()) GTEST_SKIP() << "this processor has no AVX2";
  ASSERT_FALSE(HasFailure());
  const Texts& found = by_target.begin()->second;
  for (const auto& [target, texts] : by_target) {
    const std::string text = differences(texts, found);
    EXPECT_TRUE(text.empty()) << hwy::TargetName(target) << " and "
                              << hwy::TargetName(by_target.begin()->first) << " differ:" << text;
  }
  if (HasFailure()) return;
  if (std::getenv(kRenew) != nullptr) return renew(group, found);

  const Json file = read_json(kFile);
  ASSERT_EQ(file.at("algorithm"), kAlgorithmVersion)
      << kFile << " is of another version of the algorithm; renew it: " << kRenew << "=1 digests_tests";
  const std::string text = differences(pinned_of(file, group), found);
  EXPECT_TRUE(text.empty()) << kFile << " differs, and kAlgorithmVersion has not changed; where values are "
                            << "meant to change, raise it and renew the file (" << kRenew << "=1):" << text;
}

INSTANTIATE_TEST_SUITE_P(Of, Digests, testing::ValuesIn(kDigestGroups),
                         [](const auto& group) { return std::string(group.param.name); });

TEST(DigestFile, HasNoDigestsOfGroupsThatAreNot) {
  std::size_t known = 0;
  const Json file = read_json(kFile);
  for (const DigestGroup& group : kDigestGroups) known += pinned_of(file, group.name).size();
  EXPECT_EQ(known, file.at("digests").size());
}

TEST(DigestFile, HasTheSameForMergedVolumesAsForWholeOnes) {
  const std::string merged = "volume/merged/";
  int compared = 0;
  const Json file = read_json(kFile);
  const Json& digests = file.at("digests");
  for (const auto& [name, digest] : digests.items()) {
    if (!name.starts_with(merged)) continue;
    EXPECT_EQ(digest, digests.at("volume/" + name.substr(merged.size()))) << name;
    ++compared;
  }
  EXPECT_GE(compared, 5);
}

}  // namespace
}  // namespace solidnoise::digests_test
