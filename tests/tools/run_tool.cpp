#include "tools/run_tool.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

fs::path make_temporary(const std::string& name) {
  std::string path = (fs::temp_directory_path() / (name + "-XXXXXX")).string();
  const int descriptor = mkstemp(path.data());
  if (descriptor < 0) throw std::runtime_error("no temporary file");
  close(descriptor);
  return path;
}

// A pseudo-terminal; returns our end of it and puts the name of the other one into `path`.
int open_terminal(fs::path& path) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0)
    throw std::runtime_error("no terminal");
  path = ptsname(terminal);
  return terminal;
}

// Everything until the other end is closed.
std::string drain(int terminal) {
  std::string text;
  std::array<char, 4096> buffer;
  for (ssize_t count; (count = read(terminal, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return text;
}

void redirect(const fs::path& path, int descriptor) {
  const int file = open(path.c_str(), O_WRONLY | O_TRUNC | O_NOCTTY);
  if (file < 0 || dup2(file, descriptor) < 0) _exit(125);
}

}  // namespace

RunningTool::RunningTool(const std::string& program, const std::vector<std::string>& arguments,
                         const RunOptions& options)
    : keeps_output_(!options.standard_output.empty()),
      out_(keeps_output_ ? options.standard_output : make_temporary("solidnoise-out")),
      err_(options.on_terminal ? fs::path() : make_temporary("solidnoise-err")) {
  if (options.on_terminal) terminal_ = open_terminal(err_);
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ > 0) return;
  redirect(out_, STDOUT_FILENO);
  redirect(err_, STDERR_FILENO);
  if (chdir(options.folder.c_str()) != 0) _exit(125);
  if (options.file_size_limit > 0) {
    const rlim_t bytes = static_cast<rlim_t>(options.file_size_limit);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  for (const std::string& variable : options.environment) putenv(const_cast<char*>(variable.c_str()));
  execv(argv[0], argv.data());
  _exit(125);
}

void RunningTool::wait_until_it_catches(int signal) const {
  const std::string label = "SigCgt:";
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < give_up) {
    const std::string status = read_file("/proc/" + std::to_string(pid_) + "/status");
    const std::size_t line = status.find(label);
    if (line == std::string::npos) return;  // it has ended
    const unsigned long long caught = std::stoull(status.substr(line + label.size()), nullptr, 16);
    if (caught >> (signal - 1) & 1) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

bool RunningTool::wait_until_it_writes(const fs::path& folder) const {
  const std::string begin = (fs::canonical(folder) / "#").string();
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < give_up) {
    siginfo_t ended = {};
    waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid != 0) return false;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/fd", error)) {
      if (fs::read_symlink(entry.path(), error).string().starts_with(begin)) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

void RunningTool::send(int signal) const {
  kill(pid_, signal);
}

double RunningTool::work() const {
  const std::string stat = read_file("/proc/" + std::to_string(pid_) + "/stat");
  std::istringstream fields(stat.substr(std::min(stat.size(), stat.rfind(')') + 2)));  // after the name
  const std::vector<std::string> field{std::istream_iterator<std::string>(fields), {}};
  constexpr std::size_t kUser = 11;
  constexpr std::size_t kSystem = 12;
  if (field.size() <= kSystem) return 0.0;  // it has ended
  return (std::stod(field[kUser]) + std::stod(field[kSystem])) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

ToolResult RunningTool::wait() {
  ToolResult result;
  if (terminal_ >= 0) result.err = drain(terminal_);
  int status = 0;
  rusage usage = {};
  wait4(pid_, &status, 0, &usage);
  result.peak_memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
  for (const timeval& time : {usage.ru_utime, usage.ru_stime}) {
    result.work += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  if (terminal_ >= 0) {
    close(terminal_);
  } else {
    result.err = read_file(err_);
    fs::remove(err_);
  }
  if (!keeps_output_) {
    result.out = read_file(out_);
    fs::remove(out_);
  }
  return result;
}

}  // namespace solidnoise
