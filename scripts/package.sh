#!/usr/bin/env bash
# package.sh [--clean-root]: makes the Debian packages, in build/packages: solidnoise-tools, libsolidnoise-dev, python3-solidnoise and
# solidnoise-blender; `apt install ./build/packages/*.deb` installs them. DEBFULLNAME and DEBEMAIL say who maintains them; without them
# nobody does who has an address. Its tests use them unpacked; with --clean-root also installed by apt into a fresh Debian, which is
# downloaded (some 2 GB of disk; root alone can make one).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
umask 022
[[ $# == 0 || $* == --clean-root ]] || { echo "package: $1 is not known; give --clean-root or nothing" >&2; exit 2; }

scripts/setup.sh help2man lintian dpkg-dev zsh
# As a tree that is there is set up; a fresh one without tests.
fresh=()
[[ -e build/release/CMakeCache.txt ]] || fresh=(-DSOLIDNOISE_BUILD_TESTS=OFF)
scripts/build.sh release:vdbnoise,meshnoise,noisefit,solidnoise_python "${fresh[@]}"
tests/packages/packages_test.sh "$PWD/build/release" "$PWD" "$PWD/build/release/tests/packages"
mkdir -p build/packages
rm -f build/packages/*.deb
cp build/release/tests/packages/*.deb build/packages
[[ $* == --clean-root ]] || { ls build/packages; exit 0; }

# A fresh Debian 12: apt installs the packages, and what a user of the library has.
scripts/setup.sh mmdebstrap
debs=(build/packages/*.deb)
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mmdebstrap --variant=minbase --include=g++,cmake,make,zsh \
  --customize-hook='mkdir "$1/project"' \
  --customize-hook="tar --create --exclude=./build --exclude=./.git --exclude=node_modules . | tar --extract --directory \"\$1/project\"" \
  --customize-hook="copy-in ${debs[*]} /tmp" \
  --customize-hook='chroot "$1" sh -c "apt-get install --yes --no-install-recommends /tmp/*.deb"' \
  --customize-hook='chroot "$1" /project/tests/packages/use_installed.sh / /project /tmp/use' \
  --customize-hook='chroot "$1" sh -c "dpkg --purge solidnoise-blender python3-solidnoise libsolidnoise-dev solidnoise-tools && ! find / -xdev -path /project -prune -o -path /tmp -prune -o -path /var/log -prune -o -name \"*solidnoise*\" -print | grep ."' \
  bookworm "$root/debian"
echo "package: installed, used and removed in a fresh Debian"
