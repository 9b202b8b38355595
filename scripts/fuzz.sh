#!/usr/bin/env bash
# fuzz.sh [SECONDS]: builds the fuzzers of what reads files and runs each for SECONDS (default 60). They begin with what is in
# tests/fuzz/corpus; what they find is left in build/fuzz/findings and, once mended, goes there, where the tests replay it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}

scripts/setup.sh clang
scripts/build.sh fuzz
seeds=$PWD/tests/fuzz/corpus
cd build/fuzz
export SOLIDNOISE_IMAGE_MODULE=$PWD/lib/solidnoise/solidnoise_image_io.so
mkdir -p findings
tests/fuzz/write_fuzz_seeds corpus
for name in ply obj off stl om noise image vdb recipe; do
  echo "fuzz: $name for $seconds s"
  mkdir -p corpus/$name
  further=()
  leaks=1
  [[ $name != vdb && $name != recipe ]] || leaks=0  # OpenVDB loses nodes where reading fails
  [[ $name != recipe ]] || further=(../../tools/vdbnoise/presets ../../examples/recipes)
  tests/fuzz/fuzz_$name -max_total_time="$seconds" -max_len=16384 -timeout=20 -malloc_limit_mb=1100 -rss_limit_mb=2500 \
    -detect_leaks="$leaks" -artifact_prefix="findings/$name-" -print_final_stats=1 corpus/$name "$seeds/$name" "${further[@]}" 2>"findings/$name.log" ||
    { tail -50 "findings/$name.log" >&2; exit 1; }
  grep -E "number_of_executed_units" "findings/$name.log"
done
