#!/usr/bin/env bash
# run.sh TESTS.py: runs tests in Blender, without the user's settings; those of window.py in a window, in a display of its own.
set -euo pipefail
cd "$(dirname "$0")"

if ! command -v blender >/dev/null; then
  echo "skipped: Blender is not installed; apt-get install blender"
  exit 77
fi
home=$(mktemp --directory)
trap 'rm -rf "$home"' EXIT
export BLENDER_USER_CONFIG=$home TMPDIR=$home

if [[ $1 != *window.py ]]; then
  blender --background --factory-startup --python-exit-code 3 --python run.py -- "$1"
  exit
fi
xvfb-run --auto-servernum --server-args "-screen 0 1400x900x24" \
  blender --factory-startup --window-geometry 0 0 1400 900 --enable-event-simulate --python "$1" 2>&1 | tee "$home/told"
! grep --quiet Traceback "$home/told"  # what panels raise as they are drawn goes nowhere else
