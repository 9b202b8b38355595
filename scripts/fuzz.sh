#!/usr/bin/env bash
# fuzz.sh [SECONDS [NAME...]]: builds the fuzzers of what reads files and runs each, or these, for SECONDS (default 60). They begin with what is in
# tests/fuzz/corpus; what they find is left in build/fuzz/findings and, once mended, goes there, where the tests replay it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}
names=("${@:2}")
((${#names[@]} > 0)) || names=(ply obj off stl om glb gltf noise image vdb nvdb recipe)

scripts/setup.sh clang libclang-rt-dev
targets=$(printf ',fuzz_%s' "${names[@]}")
scripts/build.sh "fuzz:write_fuzz_seeds$targets"
seeds=$PWD/tests/fuzz/corpus
cd build/fuzz
export SOLIDNOISE_IMAGE_MODULE=$PWD/lib/solidnoise/solidnoise_image_io.so
mkdir -p findings
tests/fuzz/write_fuzz_seeds corpus
for name in "${names[@]}"; do
  echo "fuzz: $name for $seconds s"
  mkdir -p corpus/$name
  further=()
  leaks=1
  longest=20
  [[ $name != vdb && $name != nvdb && $name != recipe ]] || leaks=0  # OpenVDB loses nodes where reading fails
  [[ $name != recipe ]] || { further=(../../tools/vdbnoise/presets ../../examples/recipes); longest=120; }
  tests/fuzz/fuzz_$name -max_total_time="$seconds" -max_len=16384 -timeout="$longest" -malloc_limit_mb=1100 -rss_limit_mb=2500 \
    -detect_leaks="$leaks" -artifact_prefix="findings/$name-" -print_final_stats=1 corpus/$name "$seeds/$name" "${further[@]}" 2>"findings/$name.log" ||
    { tail -50 "findings/$name.log" >&2; exit 1; }
  grep -E "number_of_executed_units" "findings/$name.log"
done
