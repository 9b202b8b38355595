#include "ratio_reporter.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>

namespace solidnoise::bench {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2.0;
}

// How many of the least samples, and of the largest, lie outside of the interval that holds the median of
// their distribution with a probability of 95 %: each sample is below it with a probability of 1/2.
std::size_t interval_rank(std::size_t samples) {
  double below = std::pow(0.5, static_cast<double>(samples));  // P(0 samples below), then of up to `rank`
  double term = below;
  std::size_t rank = 0;
  while (true) {
    term *= static_cast<double>(samples - rank) / static_cast<double>(rank + 1);
    if (below + term > 0.025) return rank;
    below += term;
    ++rank;
  }
}

}  // namespace

// A ratio that was measured.
struct RatioReporter::Result {
  Ratio ratio;
  double slow = 0.0;  // ns per sample
  double fast = 0.0;
  std::vector<double> samples;  // of the ratio, in ascending order
};

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

std::vector<RatioReporter::Result> RatioReporter::results() const {
  std::vector<Result> results;
  for (const Ratio& ratio : ratios_) {
    const auto slow = nanoseconds_.find(ratio.slow), fast = nanoseconds_.find(ratio.fast);
    if (slow == nanoseconds_.end() || fast == nanoseconds_.end()) continue;
    Result result{ratio, median(slow->second), median(fast->second), {}};
    for (std::size_t i = 0; i < std::min(slow->second.size(), fast->second.size()); ++i) {
      result.samples.push_back(slow->second[i] / fast->second[i]);
    }
    std::sort(result.samples.begin(), result.samples.end());
    results.push_back(std::move(result));
  }
  return results;
}

void RatioReporter::Finalize() {
  std::ostream& out = GetOutputStream();
  out << "\nns per sample, and how many times faster\n"
      << std::setw(64) << "slow" << std::setw(10) << "fast" << std::setw(9) << "times" << std::setw(17)
      << "95 % interval" << std::setw(10) << "at least" << std::setw(6) << "aim" << '\n';
  for (const Result& result : results()) {
    const std::size_t rank = interval_rank(result.samples.size());
    out << std::fixed << std::left << std::setw(54) << result.ratio.title << std::right
        << std::setprecision(2) << std::setw(10) << result.slow << std::setw(10) << result.fast
        << std::setw(9) << median(result.samples) << std::setw(9) << result.samples[rank] << std::setw(8)
        << result.samples[result.samples.size() - 1 - rank] << std::setprecision(1) << std::setw(10)
        << result.ratio.at_least << std::setw(6) << result.ratio.aim << '\n';
  }
  if (file_.empty()) return;
  std::ofstream file(file_);
  file << "title,slow,fast,times,lower,upper,at_least,aim\n";
  for (const Result& result : results()) {
    const std::size_t rank = interval_rank(result.samples.size());
    file << '"' << result.ratio.title << "\"," << result.slow << ',' << result.fast << ','
         << median(result.samples) << ',' << result.samples[rank] << ','
         << result.samples[result.samples.size() - 1 - rank] << ',' << result.ratio.at_least << ','
         << result.ratio.aim << '\n';
  }
}

}  // namespace solidnoise::bench
