#pragma once

#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace solidnoise::bench {

// One row of the final table: how many times faster one benchmark is than another.
struct Ratio {
  std::string title;
  std::string slow;  // names of the two benchmarks
  std::string fast;
  double at_least = 0.0;  // what is to be reached; 0: nothing in particular
  double aim = 0.0;       // what is hoped for
};

// Prints each benchmark's median, and at the end a table of ratios. Repetitions of different benchmarks are
// interleaved at random, so that the k-th repetitions of two benchmarks saw about the same machine: their
// quotient is one sample of the ratio. A ratio is given as the median of its samples with an interval of
// confidence of 95 % or more: between the order statistics that hold the median so often whatever the
// samples' distribution (from 6 repetitions on; with fewer, from the least to the largest).
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  // Ratios are written to a file of comma-separated values too, unless its name is empty.
  RatioReporter(std::vector<Ratio> ratios, std::string file)
      : ConsoleReporter(OO_None), ratios_(std::move(ratios)), file_(std::move(file)) {}

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  struct Result;

  std::vector<Result> results() const;

  std::vector<Ratio> ratios_;
  std::string file_;
  std::map<std::string, std::vector<double>> nanoseconds_;  // per sample, by name and repetition
};

}  // namespace solidnoise::bench
