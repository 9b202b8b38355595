#!/usr/bin/env bash
# studio.sh: builds Solidnoise Studio, the page in which noises are shaped by hand, and serves it on this machine; says the address.
# studio.sh build [FOLDER]: builds the static folder for a web host (default build/studio).
# studio.sh pictures: makes the pictures of docs/studio.md, by its tests.
# studio.sh test: checks the page against the tools, which scripts/build.sh release has built, in Node, Chromium and Firefox.
# studio.sh bench: measures in Chromium how quick it is, and writes that into docs/studio.md.
# What is missing is installed: Emscripten, 850 MB of disk, and for the tests browsers, are the large ones.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

what=${1:-serve}
folder=$(realpath -m "${2:-build/studio}")
port=${SOLIDNOISE_STUDIO_PORT:-8765}
[[ $what =~ ^(serve|build|pictures|test|bench)$ ]] || { echo "studio: $what is not known; give build, pictures, test, bench or nothing" >&2; exit 2; }

packages=(emscripten libboost-math-dev)
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm)
[[ $what == serve || $what == build ]] || packages+=(chromium)
[[ $what != test ]] || packages+=(firefox-esr xvfb xauth)
scripts/setup.sh "${packages[@]}"

# The library in WebAssembly, then the page around it.
if command -v ccache >/dev/null; then
  export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
  launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
emcmake cmake -S studio/wasm -B build/wasm -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE= "${launcher[@]}" >/dev/null
jobs=$(nproc)
memory=$(awk '/^MemAvailable/ { print int($2 / 1048576) }' /proc/meminfo)
((memory >= jobs)) || jobs=$((memory > 0 ? memory : 1))
cmake --build build/wasm --parallel "$jobs"
if [[ ! -d studio/node_modules || studio/package-lock.json -nt studio/node_modules ]]; then
  npm --prefix studio ci --no-audit --no-fund --loglevel=error
  touch studio/node_modules
fi
npm --prefix studio run --silent check
node studio/build.mjs "$folder"

case $what in
  build) echo "studio: the folder for a web host is $folder" ;;
  test) xvfb-run --auto-servernum node --test --test-concurrency=1 studio/test/*.test.mjs ;;
  bench) node studio/bench.mjs --write ;;
  pictures) STUDIO_PICTURES=$PWD/docs/studio node --test --test-concurrency=1 studio/test/page.test.mjs studio/test/meshes.test.mjs ;;
  serve) exec node studio/serve.mjs "$folder" "$port" ;;
esac
