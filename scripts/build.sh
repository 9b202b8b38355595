#!/usr/bin/env bash
# build.sh PRESET[:TARGET,...] [CMAKE_OPTION...]: configures and builds in build/PRESET, all or these targets alone, through ccache
# where there is one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1%%:*}
targets=${1#"$preset"}
shift

if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1  # objects do not depend on the folder
fi

# One compiler per core, as long as each has 2.4 GB, which two dozen files with OpenVDB's headers take.
jobs=$(nproc)
most=$(awk '/^MemAvailable/ { print int($2 / 1048576 / 2.4) }' /proc/meminfo)
((most >= jobs)) || jobs=$((most > 0 ? most : 1))

cmake --preset "$preset" "$@"
targets=${targets#:}
cmake --build --preset "$preset" --parallel "$jobs" ${targets:+--target ${targets//,/ }}
