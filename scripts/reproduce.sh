#!/usr/bin/env bash
# reproduce.sh [ITEM...]: makes docs/papers, the figures and tables of the papers, again: builds, computes the items that are named
# or not there yet (all, in a fresh clone) into build/papers/data, draws and writes the pages. Items: build/papers/research/papers --list.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh python3-matplotlib python3-pil
scripts/build.sh papers
papers=$PWD/build/papers/research/papers
data=$PWD/build/papers/data
mkdir -p "$data" docs/papers

items=$("$papers" --list)
for item in "$@"; do
  grep --quiet --line-regexp --fixed-strings -- "$item" <<<"$items" || { echo "reproduce: no item $item" >&2; exit 2; }
done
for item in $items; do
  if [[ " $* " == *" $item "* || ! -e $data/$item.done ]]; then
    echo "reproduce: $item"
    "$papers" "$item" "$data"
    touch "$data/$item.done"
  fi
done

version="$("$papers" --version)"
for page in improving_gabor_noise noise_by_example gradient_noise implementation_report impulses_in_strata; do
  /usr/bin/python3 "research/pages/$page.py" "$data" docs/papers "$version"
done
echo "The pages: $PWD/docs/papers"
