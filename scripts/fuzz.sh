#!/usr/bin/env bash
# fuzz.sh [SECONDS]: builds the fuzzers of the mesh readers and runs each for SECONDS (default 120). What they find is left in
# build/fuzz/findings.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-120}

scripts/setup.sh clang
scripts/build.sh fuzz
cd build/fuzz
mkdir -p findings
tests/fuzz/write_fuzz_seeds corpus
for format in ply obj off stl om; do
  echo "fuzz: .$format for $seconds s"
  tests/fuzz/fuzz_read_$format -max_total_time="$seconds" -max_len=4096 -malloc_limit_mb=512 -rss_limit_mb=2048 \
    -artifact_prefix="findings/$format-" -print_final_stats=1 corpus/$format 2>"findings/$format.log" ||
    { tail -50 "findings/$format.log" >&2; exit 1; }
  grep -E "number_of_executed_units" "findings/$format.log"
done
