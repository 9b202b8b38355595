#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include "support/temporary_folder.h"

namespace solidnoise {

// How a run of a real program ended.
struct ToolResult {
  int status = -1;  // exit status; -1 if a signal ended it
  int signal = 0;   // which one, or 0
  std::string out;
  std::string err;
  double peak_memory = 0.0;  // bytes
  double work = 0.0;         // processor time in seconds, which other programs' work changes little
};

struct RunOptions {
  std::filesystem::path folder = ".";          // in which it runs
  std::filesystem::path standard_output = {};  // where that goes instead of ToolResult::out
  bool on_terminal = false;                    // make its standard error a terminal
  long file_size_limit = 0;  // bytes that a file may have, as if the disk were full then; 0: any
  std::vector<std::string> environment = {};  // NAME=VALUE, besides that of the test
};

// A run that has begun. Wait for it once.
class RunningTool {
 public:
  RunningTool(const std::string& program, const std::vector<std::string>& arguments,
              const RunOptions& options);

  // Waits until the program has set itself up to catch the signal, or has ended; at most a minute.
  void wait_until_it_catches(int signal) const;
  // Waits until it has a file without a name open in the folder, or has ended; at most a minute. Returns
  // whether it has.
  bool wait_until_it_writes(const std::filesystem::path& folder) const;
  void send(int signal) const;
  // What it has used of processors' time until now, in seconds.
  double work() const;
  ToolResult wait();

 private:
  pid_t pid_ = 0;
  int terminal_ = -1;          // our end of it
  bool keeps_output_ = false;  // where it was sent, rather than in ToolResult::out
  std::filesystem::path out_;
  std::filesystem::path err_;
};

}  // namespace solidnoise
