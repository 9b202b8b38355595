#include "common/exit_status.h"

#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "common/flag_set.h"
#include "common/interrupt.h"
#include "common/usage_error.h"
#include "solidnoise/core/progress.h"

namespace solidnoise {
namespace {

// What other libraries say may have several lines; ours is one.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

}  // namespace

int run_tool(const char* tool, const std::function<int()>& run) {
  try {
    return run();
  } catch (const TextRequested& requested) {
    std::cout << requested.text << std::flush;
    return kDone;
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
  } catch (const std::exception& error) {
    std::cerr << tool << ": " << one_line(error.what()) << '\n';
    return kFailed;
  }
}

int run_command(const std::string& command, const std::function<int()>& run) {
  try {
    return run();
  } catch (const UsageError& error) {
    throw UsageError(error.what(), command);
  }
}

}  // namespace solidnoise
