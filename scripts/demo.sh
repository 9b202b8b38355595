#!/usr/bin/env bash
# demo.sh [ARGUMENT...]: makes cloud.vdb and its picture cloud.png in the current folder, on a machine that may have nothing yet.
# The arguments go to vdbnoise. The two files are replaced where they exist.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/scripts/setup.sh"
"$root/scripts/build.sh" release:vdbnoise -DSOLIDNOISE_BUILD_TESTS=OFF
[[ ! -e cloud.vdb && ! -e cloud.png ]] || echo "demo: replacing the cloud.vdb and cloud.png that are here"
"$root/build/release/tools/vdbnoise" --out cloud.vdb --preview cloud.png --force "$@"

echo "The cloud:   $PWD/cloud.vdb"
echo "Its picture: $PWD/cloud.png"
