#!/usr/bin/env bash
# reproduce.sh [ITEM...]: makes docs/papers, the figures and tables of the papers, again: builds the Python module, computes the items that are
# named or not there yet (all, in a fresh clone) into build/research, draws and writes the pages. A name that is none lists them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh python3-matplotlib python3-pil python3-scipy
scripts/build.sh release:solidnoise_python,solidnoise_image_io
PYTHONPATH=build/release/python /usr/bin/python3 research/reproduce.py build/research docs/papers "$@"
echo "The pages: $PWD/docs/papers"
