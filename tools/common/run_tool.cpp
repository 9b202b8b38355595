#include "common/run_tool.h"

#include <algorithm>
#include <csignal>
#include <errno.h>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <string_view>
#include <unistd.h>

#include <fmt/format.h>

#include "common/flag_completion.h"
#include "common/flag_help.h"
#include "solidnoise/core/choices.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/core/progress.h"

namespace solidnoise {
namespace {

volatile std::sig_atomic_t received_signal = 0;
volatile std::sig_atomic_t ends_at_once = 0;

std::string what_is_left = "nothing is written";

// What a handler may not put together.
std::string last_words;

void compose_last_words() {
  const std::string wipe = isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "";  // of a progress bar
  last_words = wipe + interruption_message();
}

// Calls only what a handler of signals may call.
extern "C" void receive_signal(int signal) {
  received_signal = signal;
  if (ends_at_once == 0) return;
  [[maybe_unused]] const auto written = write(STDERR_FILENO, last_words.data(), last_words.size());
  _exit(kInterrupted + signal);
}

}  // namespace

void catch_interrupts() {
  compose_last_words();
  struct sigaction action = {};
  action.sa_handler = receive_signal;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
  sigaction(SIGXCPU, &action, nullptr);
}

int interrupt_signal() {
  return received_signal;
}

void set_what_is_left(const std::string& what) {
  what_is_left = what;
  compose_last_words();
}

std::string interruption_message() {
  return std::string(program_invocation_short_name) + ": interrupted; " + what_is_left + '\n';
}

EndsAtOnce::EndsAtOnce() {
  ends_at_once = 1;
  if (received_signal != 0) throw Cancelled();
}

EndsAtOnce::~EndsAtOnce() {
  ends_at_once = 0;
}

namespace {

// What other libraries say may have several lines, and what files and flags say anything; ours is one line,
// and none of its words is longer than can be read, but for paths.
std::string one_line(std::string text) {
  constexpr std::size_t kLongestWord = 96;  // printable()'s, and what it has around it
  constexpr std::size_t kLongestPath = 255;
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::istringstream words(text);
  std::string shown;
  for (std::string word; std::getline(words, word, ' ');) {
    if (!shown.empty()) shown += ' ';
    shown += printable(word, word.find('/') == std::string::npos ? kLongestWord : kLongestPath);
  }
  return shown;
}

// While one lives, texts for the standard output are kept.
class PrintedText {
 public:
  PrintedText() : standard_(std::cout.rdbuf(text_.rdbuf())) {}
  ~PrintedText() { std::cout.rdbuf(standard_); }
  PrintedText(const PrintedText&) = delete;
  PrintedText& operator=(const PrintedText&) = delete;

  // Writes them with what no terminal can take for its own. Throws what write_output does.
  void write() const {
    std::istringstream lines(text_.str());
    std::string shown;
    for (std::string line; std::getline(lines, line);) shown += printable(line, std::string::npos) + '\n';
    if (shown.empty()) return;
    write_output("-", {}, [&](std::ostream& stream) { stream << shown; });
  }

 private:
  std::ostringstream text_;
  std::streambuf* standard_;
};

// While one lives, no text for the standard error is taken for a terminal's own: names of grids, of files.
// Bars of progress go past it.
class PrintedErrors final : public std::streambuf {
 public:
  PrintedErrors() : standard_(std::cerr.rdbuf(this)) {}
  ~PrintedErrors() override { std::cerr.rdbuf(standard_); }

 private:
  int overflow(int c) override {
    if (c == traits_type::eof()) return 0;
    const char letter = traits_type::to_char_type(c);
    return xsputn(&letter, 1) == 1 ? c : traits_type::eof();
  }

  std::streamsize xsputn(const char* text, std::streamsize count) override {
    std::string_view left(text, static_cast<std::size_t>(count));
    while (!left.empty()) {
      const std::size_t length = std::min(left.find('\n'), left.size());
      std::string shown = printable(left.substr(0, length), std::string::npos);
      if (length < left.size()) shown += '\n';
      const auto size = static_cast<std::streamsize>(shown.size());
      if (standard_->sputn(shown.data(), size) != size) return 0;
      left.remove_prefix(std::min(length + 1, left.size()));
    }
    return count;
  }

  int sync() override { return standard_->pubsync(); }

  std::streambuf* standard_;
};

int run_and_print(const std::function<int()>& run) {
  const PrintedText printed;
  int status = kDone;
  try {
    status = run();
  } catch (const TextRequested& requested) {
    std::cout << requested.text;
  } catch (...) {
    printed.write();
    throw;
  }
  printed.write();
  return status;
}

// Those that may stand in the place of a part of one: what completes a command line goes on with the flags.
void list_commands(const std::vector<std::string_view>& names, const std::string& part) {
  for (const std::string_view name : names) {
    if (name.starts_with(part)) std::cout << name << '\n';
  }
}

}  // namespace

int run_tool(const char* tool, const std::function<int()>& run) {
  // Writing then fails, and says so.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const PrintedErrors errors;
  try {
    return run_and_print(run);
  } catch (const UsageError& error) {
    const std::string command = error.command().empty() ? tool : error.command();
    std::cerr << tool << ": " << one_line(error.what()) << "\nTry " << command << " --help\n";
    return kWrongUsage;
  } catch (const Cancelled&) {
    std::cerr << interruption_message();
    return kInterrupted + interrupt_signal();
  } catch (const std::bad_alloc&) {
    std::cerr << tool << ": out of memory\n";
    return kFailed;
  } catch (const std::length_error&) {
    std::cerr << tool << ": out of memory: this would take more than any machine has\n";
    return kFailed;
  } catch (const std::exception& error) {
    std::cerr << tool << ": " << one_line(error.what()) << '\n';
    return kFailed;
  }
}

int run_commands(const std::string& tool, std::span<const Command> commands,
                 const std::vector<std::string>& arguments,
                 int (*otherwise)(const std::vector<std::string>& arguments)) {
  const std::string first = arguments.empty() ? std::string() : arguments.front();
  std::vector<std::string_view> names;
  for (const Command& command : commands) {
    names.push_back(command.name);
    if (command.name != first) continue;
    try {
      return command.run({arguments.begin() + 1, arguments.end()});
    } catch (const UsageError& error) {
      throw UsageError(error.what(), fmt::format("{} {}", tool, first));
    }
  }
  if (first == kCompletionFlag) list_commands(names, arguments.back());
  const std::string_view nearest = nearest_word(first, names);
  if (!first.starts_with('-') && !nearest.empty() && !std::filesystem::exists(first)) {
    throw UsageError(fmt::format("{} is no command; did you mean {}?", printable(first), nearest));
  }
  return otherwise(arguments);
}

}  // namespace solidnoise
