#!/usr/bin/env bash
# test.sh [CMAKE_OPTION...]: builds everything in release and runs all the tests; one of them builds examples/consumer against
# an installed copy. The page is built and tested last.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh libgtest-dev libopenvdb-tools python3-openvdb python3-jsonschema python3-pil python3-pytest python3-scipy mypy blender xvfb xauth help2man lintian dpkg-dev zsh \
  slurmctld slurmd slurm-client munge
scripts/build.sh release -DSOLIDNOISE_BUILD_TESTS=ON "$@"
ctest --preset release --parallel "$(nproc)"
# Files of scenes, by other people's parsers.
command -v npm >/dev/null || scripts/setup.sh nodejs npm
npm --prefix tests/scenes ci --no-audit --no-fund --ignore-scripts --loglevel=error
node --test tests/scenes/scenes.test.mjs
scripts/studio.sh test
