#pragma once

#include <string>

namespace solidnoise {

// Where tests find what they need: a path in the project's folder ("tests/golden/x.json") and one in the
// folder that is built in ("tools/vdbnoise"), absolute. Only this is compiled anew when the project has
// moved.
std::string in_source(const std::string& path);
std::string in_build(const std::string& path);

}  // namespace solidnoise
