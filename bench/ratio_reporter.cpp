#include "ratio_reporter.h"

#include <algorithm>
#include <iomanip>

namespace solidnoise::bench {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2.0;
}

}  // namespace

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> shown;
  for (const Run& run : runs) {
    if (run.run_type == Run::RT_Iteration && !run.error_occurred) {
      nanoseconds_[run.run_name.function_name].push_back(1e9 / run.counters.at("items_per_second"));
    }
    if (run.error_occurred || run.aggregate_name == "median" || run.repetitions == 1) shown.push_back(run);
  }
  ConsoleReporter::ReportRuns(shown);
}

void RatioReporter::Finalize() {
  std::ostream& out = GetOutputStream();
  out << "\nns per sample, and how many times faster\n"
      << std::setw(64) << "slow" << std::setw(10) << "fast" << std::setw(9) << "median" << std::setw(9)
      << "lowest" << std::setw(10) << "at least" << std::setw(6) << "aim" << '\n';
  for (const Ratio& ratio : ratios_) {
    const auto slow = nanoseconds_.find(ratio.slow), fast = nanoseconds_.find(ratio.fast);
    if (slow == nanoseconds_.end() || fast == nanoseconds_.end()) continue;
    std::vector<double> samples;
    for (std::size_t i = 0; i < std::min(slow->second.size(), fast->second.size()); ++i) {
      samples.push_back(slow->second[i] / fast->second[i]);
    }
    out << std::fixed << std::left << std::setw(54) << ratio.title << std::right << std::setprecision(2)  //
        << std::setw(10) << median(slow->second) << std::setw(10) << median(fast->second)                 //
        << std::setw(9) << median(samples) << std::setw(9)
        << *std::min_element(samples.begin(), samples.end()) << std::setprecision(1) << std::setw(7)
        << ratio.at_least << std::setw(6) << ratio.aim << '\n';
  }
}

}  // namespace solidnoise::bench
