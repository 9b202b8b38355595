#!/usr/bin/env bash
# setup.sh [PACKAGE...]: installs the Debian packages that the build needs, and those named, as far as they are missing.
set -euo pipefail

packages=(
  cmake ninja-build g++ pkg-config
  libopenvdb-dev libnanovdb-dev libboost-iostreams-dev zlib1g-dev libtbb-dev libopenimageio-dev libpng-dev libopenmesh-dev libtinygltf-dev
  libglm-dev libeigen3-dev libembree-dev libhwy-dev libkissfft-dev
  libfmt-dev nlohmann-json3-dev fonts-dejavu-core
  pybind11-dev python3-dev python3-numpy
  "$@"
)

fail() {
  echo "setup: $1" >&2
  exit 1
}

command -v dpkg-query >/dev/null || fail "this is not a Debian system; install the likes of: ${packages[*]}"

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || fail "neither root nor sudo; as root, run: apt-get install ${missing[*]}"
  as_root=(sudo)
fi
as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get --quiet --option Dpkg::Use-Pty=0)

echo "setup: installing ${missing[*]}"
"${as_root[@]}" update || echo "setup: the package lists could not be renewed; trying with those at hand" >&2
"${as_root[@]}" install --yes --no-install-recommends "${missing[@]}" || fail "could not install ${missing[*]}"
