#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "digests/digest.h"

namespace solidnoise {

// Something that has values, which are to stay.
struct DigestCase {
  std::string name;
  std::function<void(Digest&)> evaluate;
};
using DigestCases = std::vector<DigestCase>;

// What is pinned, each group in a file of its own:
DigestCases noise_cases();   // noises on lattices and at points, in each dimension: noises.json
DigestCases point_cases();   // noises with parameters and normals of each point
DigestCases volume_cases();  // volumes.json, presets, examples
DigestCases mesh_cases();    // meshes.json, presets, examples

struct DigestGroup {
  std::string_view name;  // what its cases' names begin with, before a slash
  DigestCases (*cases)();

  friend std::ostream& operator<<(std::ostream& out, const DigestGroup& group) { return out << group.name; }
};
inline constexpr DigestGroup kDigestGroups[]{
    {"noise", noise_cases}, {"points", point_cases}, {"volume", volume_cases}, {"mesh", mesh_cases}};

}  // namespace solidnoise
