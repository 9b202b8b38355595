#include "solidnoise/core/output_file.h"

#include <cerrno>
#include <ostream>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "solidnoise/core/checked_file.h"

namespace solidnoise {
namespace {

// The file that a path names, through links.
std::filesystem::path resolve(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  return error ? path : target;
}

void write_to_descriptor(int descriptor, const std::string& name, Progress* progress,
                         const std::function<void(std::ostream&)>& write) {
  CheckedFileBuffer buffer(descriptor, name, progress);
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::badbit | std::ios::failbit);
  write(stream);
  stream.flush();
}

}  // namespace

void require_writable(const std::filesystem::path& path, Existing existing) {
  if (path == "-") return;
  const std::filesystem::path target = resolve(path);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(target, error);
  if (!target.has_filename() || std::filesystem::is_directory(status)) {
    throw std::runtime_error(fmt::format("{}: is a folder; a file name is needed", path.string()));
  }
  if (std::filesystem::exists(status)) {
    if (!std::filesystem::is_regular_file(status)) {
      throw std::runtime_error(fmt::format("{}: is not a regular file", path.string()));
    }
    if (existing == Existing::refuse) throw OutputExists(path);
  }
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, error)) {
    throw std::runtime_error(fmt::format("{}: there is no folder {}", path.string(), folder.string()));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw std::runtime_error(fmt::format("{}: cannot write in {}: {}", path.string(), folder.string(),
                                         std::generic_category().message(errno)));
  }
}

void write_output(const std::filesystem::path& path, const OutputOptions& options,
                  const std::function<void(std::ostream&)>& write) {
  if (path == "-") {
    write_to_descriptor(STDOUT_FILENO, "standard output", options.progress, write);
    return;
  }
  require_writable(path, options.existing);
  TemporaryFile file(resolve(path));
  write_to_descriptor(file.descriptor(), path.string(), options.progress, write);
  file.close();
  if (options.verify) options.verify(file.path());
  throw_if_cancelled(options.progress);
  if (options.existing == Existing::replace) {
    file.replace_target();
  } else if (!file.become_target()) {
    throw OutputExists(path);
  }
}

}  // namespace solidnoise
