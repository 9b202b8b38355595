# Writes OUTPUT, a C++ source that holds the files NAMES of the folder PRESETS as text, in this order.
set(_entries "")
foreach(_name IN LISTS NAMES)
  file(READ ${PRESETS}/${_name}.json _text)
  string(APPEND _entries "    {\"${_name}\", R\"json(${_text})json\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from tools/vdbnoise/presets by embed_presets.cmake.
#include \"vdbnoise/presets.h\"

namespace solidnoise {
namespace {

constexpr Preset kPresets[] = {
${_entries}};

}  // namespace

std::span<const Preset> presets() {
  return kPresets;
}

}  // namespace solidnoise
")
