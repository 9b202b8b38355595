#!/usr/bin/env bash
# reproduce.sh [ITEM...]: makes docs/papers, the figures and tables of the papers, again: builds, computes the items that are named
# or not there yet (all, in a fresh clone) into build/release/papers-data, draws and writes the pages.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh python3-matplotlib python3-pil
scripts/build.sh release -DSOLIDNOISE_BUILD_PAPERS=ON
tools=$PWD/build/release/tools
data=$PWD/build/release/papers-data
mkdir -p "$data" docs/papers

for item in $("$tools/papers" --list); do
  if [[ " $* " == *" $item "* || ! -e $data/$item.done ]]; then
    echo "reproduce: $item"
    "$tools/papers" "$item" "$data"
    touch "$data/$item.done"
  fi
done

version=$("$tools/papers" --version)
for page in improving_gabor_noise noise_by_example gradient_noise implementation_report; do
  /usr/bin/python3 "scripts/papers/$page.py" "$data" docs/papers "$version"
done
echo "The pages: $PWD/docs/papers"
