#include "solidnoise/image/image_module.h"

#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFileName = "solidnoise_image_io.so";
constexpr const char* kVariable = "SOLIDNOISE_IMAGE_MODULE";

// The folders of the program, and of the shared library that this code is in, if it is in one. (The address
// of an exported function may be one in the program.)
std::vector<fs::path> own_folders() {
  std::vector<fs::path> folders;
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  if (!ignored) folders.push_back(program.parent_path());
  Dl_info info{};
  if (dladdr(&kFileName, &info) != 0 && info.dli_fname != nullptr) {
    const fs::path library = fs::canonical(info.dli_fname, ignored);
    if (!ignored) folders.push_back(library.parent_path());
  }
  return folders;
}

// A full path where the file exists, or the bare name, which the dynamic linker looks for in its own way.
std::string find_module() {
  if (const char* const chosen = std::getenv(kVariable); chosen != nullptr && *chosen != '\0') return chosen;
  for (const fs::path& folder : own_folders()) {
    for (const char* const relative :
         {"../" SOLIDNOISE_LIBDIR "/solidnoise", "../lib/solidnoise", "solidnoise", "."}) {
      const fs::path candidate = folder / relative / kFileName;
      std::error_code ignored;
      if (fs::exists(candidate, ignored)) return candidate.lexically_normal().string();
    }
  }
  const fs::path installed = fs::path(SOLIDNOISE_FULL_LIBDIR) / "solidnoise" / kFileName;
  std::error_code ignored;
  return fs::exists(installed, ignored) ? installed.string() : kFileName;
}

template <typename Function>
void find_function(void* library, const std::string& path, const char* name, Function*& function) {
  function = reinterpret_cast<Function*>(dlsym(library, name));
  if (function == nullptr) {
    throw std::runtime_error(fmt::format("{} is not solidnoise's image module: it lacks {}", path, name));
  }
}

ImageModule load() {
  const std::string path = find_module();
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw std::runtime_error(
        fmt::format("cannot load the image module, which reads and writes pictures ({}); install it or set "
                    "{} to its path",
                    dlerror(), kVariable));
  }
  ImageModule module;
  find_function(library, path, "solidnoise_image_encode", module.encode);
  find_function(library, path, "solidnoise_image_decode", module.decode);
  find_function(library, path, "solidnoise_image_draw", module.draw);
  return module;
}

}  // namespace

const ImageModule& image_module() {
  static const ImageModule module = load();
  return module;
}

}  // namespace solidnoise
