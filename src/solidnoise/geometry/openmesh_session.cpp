#include "solidnoise/geometry/openmesh_session.h"

#include <OpenMesh/Core/System/omstream.hh>

namespace solidnoise {
namespace {

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

OpenMeshSession::OpenMeshSession()
    : lock_(one_at_a_time()),
      locale_(std::locale::global(std::locale::classic())),
      prints_errors_(omerr().is_enabled()),
      prints_log_(omlog().is_enabled()) {
  omerr().disable();
  omlog().disable();
}

OpenMeshSession::~OpenMeshSession() {
  if (prints_errors_) omerr().enable();
  if (!prints_log_) omlog().disable();
  if (prints_log_) omlog().enable();
  std::locale::global(locale_);
}

}  // namespace solidnoise
