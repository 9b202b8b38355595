#include <atomic>
#include <dlfcn.h>
#include <png.h>

// libpng prints what is wrong with a file unless the function that it tells does not come back; that of
// OpenImageIO does. OpenImageIO, which is loaded for this module, finds the function here before libpng's.

namespace {

std::atomic<png_error_ptr> told{nullptr};

[[noreturn]] void tell(png_structp png, png_const_charp message) {
  if (const png_error_ptr function = told) function(png, message);
  png_longjmp(png, 1);
}

void keep_quiet(png_structp, png_const_charp) {}

}  // namespace

void png_set_error_fn(png_structrp png, png_voidp context, png_error_ptr error, png_error_ptr) {
  static const auto set = reinterpret_cast<decltype(&png_set_error_fn)>(dlsym(RTLD_NEXT, "png_set_error_fn"));
  told = error;
  set(png, context, tell, keep_quiet);
}
