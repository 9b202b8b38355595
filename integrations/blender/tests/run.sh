#!/usr/bin/env bash
# run.sh TESTS.py: runs tests in Blender, without a window and without the user's settings.
set -euo pipefail

if ! command -v blender >/dev/null; then
  echo "skipped: Blender is not installed; apt-get install blender"
  exit 77
fi
home=$(mktemp --directory)
trap 'rm -rf "$home"' EXIT
BLENDER_USER_CONFIG=$home TMPDIR=$home \
  blender --background --factory-startup --python-exit-code 3 --python "$(dirname "$0")/run.py" -- "$1"
