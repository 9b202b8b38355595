#include "solidnoise/core/output_file.h"

#include <cerrno>
#include <ostream>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/core/checked_file.h"

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

void write_to_descriptor(int descriptor, const std::string& name, Progress* progress,
                         const std::function<void(std::ostream&)>& write) {
  CheckedFileBuffer buffer(descriptor, name, progress);
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::badbit | std::ios::failbit);
  write(stream);
  stream.flush();
}

}  // namespace

fs::path output_target(const fs::path& path) {
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(path, error))) {
    fs::path target = fs::canonical(path, error);
    if (error) throw std::runtime_error(fmt::format("{}: is a link that leads nowhere", path.string()));
    return target;
  }
  const fs::path folder = fs::canonical(path.has_parent_path() ? path.parent_path() : ".", error);
  return error ? fs::absolute(path).lexically_normal() : folder / path.filename();
}

void require_writable(const fs::path& path, Existing existing) {
  if (path == "-") return;
  const fs::path target = output_target(path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (!path.has_filename() || fs::is_directory(status)) {
    throw std::runtime_error(fmt::format("{}: is a folder; a file name is needed", path.string()));
  }
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status)) {
      throw std::runtime_error(fmt::format("{}: is not a regular file", path.string()));
    }
    if (existing == Existing::refuse) throw OutputExists(path);
  }
  const fs::path folder = target.parent_path();
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error(fmt::format("{}: there is no folder {}", path.string(), folder.string()));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw std::runtime_error(fmt::format("{}: cannot write in {}: {}", path.string(), folder.string(),
                                         std::generic_category().message(errno)));
  }
}

OutputGroup::OutputGroup() = default;
OutputGroup::~OutputGroup() = default;

void OutputGroup::appear() {
  std::size_t appeared = 0;
  try {
    for (; appeared < files_.size(); ++appeared) files_[appeared]->appear();
  } catch (...) {
    while (appeared > 0) files_[--appeared]->vanish();
    throw;
  }
  files_.clear();
}

void write_output(const fs::path& path, const OutputOptions& options,
                  const std::function<void(std::ostream&)>& write) {
  if (path == "-") {
    write_to_descriptor(STDOUT_FILENO, "standard output", options.progress, write);
    return;
  }
  require_writable(path, options.existing);
  auto file = std::make_unique<NewFile>(output_target(path), path, options.existing);
  write_to_descriptor(file->descriptor(), path.string(), options.progress, write);
  file->synchronize();
  if (options.verify) options.verify(file->path());
  throw_if_cancelled(options.progress);
  if (options.group != nullptr) {
    options.group->files_.push_back(std::move(file));
  } else {
    file->appear();
  }
}

}  // namespace solidnoise
