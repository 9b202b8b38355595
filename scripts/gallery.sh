#!/usr/bin/env bash
# gallery.sh [PICTURE...]: makes the pictures of the README and of docs/, all or those named, by the commands of docs/pictures.json. Those of papers
# and of performance are made by reproduce.sh and bench.sh.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh blender xvfb xauth openimageio-tools
scripts/build.sh release:vdbnoise,meshnoise,noisefit,solidnoise_python,solidnoise_image_io -DSOLIDNOISE_BUILD_TESTS=OFF
/usr/bin/python3 tests/docs/pictures.py build/release/tools . --write "$@"
