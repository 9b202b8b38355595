#!/usr/bin/env bash
# check_types.sh PYTHON PROJECT_FOLDER CACHE: checks the package, its tests and the examples against the stubs, and the stubs against the module.
set -euo pipefail
mkdir -p "$3"
cd "$3"
MYPYPATH=$PYTHONPATH "$1" -m mypy --strict --cache-dir="$3/cache" "$2/python/solidnoise" "$2"/python/tests/*.py "$2"/examples/python/*.py
# Classes of pybind11 have a metaclass of its own, and a constructor where they have none. mypy
# does not follow the package's __all__ to the module's. The library of pictures is no module.
cat >allowed <<'END'
solidnoise(\._solidnoise)?\.[A-Z]\w+
solidnoise(\._solidnoise)?\.(Grid|Volume)\.__init__
solidnoise\.__all__
solidnoise\.solidnoise_image_io
END
MYPYPATH=$2/python "$1" -m mypy.stubtest --concise --allowlist allowed --ignore-unused-allowlist solidnoise
