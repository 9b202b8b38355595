#!/usr/bin/env bash
# bench.sh [BENCHMARK_OPTION...]: builds and runs the benchmarks, counts instructions, times the programs, and writes docs/performance.md.
# Takes half an hour on a quiet machine; --benchmark_repetitions=3 is quicker and less sure.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh libbenchmark-dev python3-matplotlib python3-pil valgrind
scripts/build.sh bench
data=$PWD/build/bench/performance
mkdir -p "$data"

build/bench/bench/noise_bench --benchmark_repetitions=9 --benchmark_out="$data/times.json" --benchmark_out_format=json \
  --ratios="$data/ratios.csv" "$@"

# One block of each noise, on the instruction set that valgrind knows: the same count on every run, whatever else the machine does.
echo "case,voxels,instructions" >"$data/instructions.csv"
build/bench/bench/count_case --list | while read -r name voxels; do
  valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=evaluate_case \
    build/bench/bench/count_case "$name" 2>"$data/callgrind.log"
  echo "$name,$voxels,$(awk '/Collected/ { print $NF }' "$data/callgrind.log")" >>"$data/instructions.csv"
done

/usr/bin/python3 bench/programs.py build/bench/tools "$data"
PYTHONPATH=build/bench/python /usr/bin/python3 bench/overhead.py build/bench/bench/lattice_case
PYTHONPATH=research/pages /usr/bin/python3 bench/performance.py "$data" docs "Solidnoise $(build/bench/tools/vdbnoise --version | cut -d" " -f2)"
echo "The page: $PWD/docs/performance.md"
