#!/usr/bin/env bash
# use_installed.sh ROOT PROJECT WORK [TARGET]: uses what the packages have put under ROOT as their users do: the demonstration, completion in
# the shells that are there, the manual, the project's consumer of the library (all of it, or one target), the Python module, Blender's add-on.
set -euo pipefail
root=${1%/} project=$2 work=$3 target=${4:-all}
export PATH=$root/usr/bin:$PATH
fail() {
  echo "packages: $1" >&2
  exit 1
}
rm -rf "$work"
mkdir -p "$work"
cd "$work"

# The demonstration, and a mesh.
[[ $(command -v vdbnoise) == "$root/usr/bin/vdbnoise" ]] || fail "vdbnoise is not the one of the packages"
vdbnoise --out cloud.vdb --preview cloud.png --quiet
vdbnoise info cloud.vdb | grep --quiet density || fail "cloud.vdb has no density"
[[ $(head --bytes=4 cloud.png) == *PNG ]] || fail "cloud.png is no picture"
meshnoise bake "$project/meshes/torus.obj" --out rust.ply --preview rust.png --quiet
noisefit "$project/examples/exemplars/soil.jpg" --raw-values --out soil.json --quiet
for page in vdbnoise vdbnoise-slice meshnoise-bake noisefit-edit; do
  zcat "$root/usr/share/man/man1/$page.1.gz" | grep --quiet '^\.SH OPTIONS\|^\.SS "' || fail "the manual has no options of $page"
done
zcat "$root/usr/share/man/man1/noisefit.1.gz" | grep --after-context=1 '^\.TP' | grep --quiet '^noisefit volume IN.vdb .*OUT.json$' ||
  fail "the manual of noisefit does not list its commands"

# Flags and words in bash, and in zsh with their help.
completed=$(bash -ec 'source "$0"; COMP_WORDS=(vdbnoise --pre) COMP_CWORD=1; _solidnoise vdbnoise --pre vdbnoise; echo "${COMPREPLY[*]}"
  COMP_WORDS=(vdbnoise --preset f) COMP_CWORD=2; _solidnoise vdbnoise f --preset; echo "${COMPREPLY[*]}"' \
  "$root/usr/share/bash-completion/completions/vdbnoise" | tr '\n' ' ')
[[ $completed == "--preview --preview-frame --preset fire "* || $completed == "--preset --preview --preview-frame fire " ]] || fail "bash completes to $completed"
if command -v zsh >/dev/null; then
  completed=$(zsh -c '_describe() { print -rl -- $lines }; _files() { print files }; CURRENT=3
    words=(vdbnoise slice --sp) PREFIX=--sp; source $1; words=(vdbnoise info x) PREFIX=x; source $1' zsh "$root/usr/share/zsh/vendor-completions/_solidnoise")
  [[ $completed == *"--spectrum:The slice's"*files ]] || fail "zsh completes to $completed"
fi
# And after --flag=, of which bash makes three words, and zsh one.
completed=$(bash -ec 'source "$0"; COMP_WORDS=(vdbnoise --preset = f) COMP_CWORD=3; _solidnoise vdbnoise f =; echo "${COMPREPLY[*]}"
  COMP_WORDS=(vdbnoise --fold =) COMP_CWORD=2; _solidnoise vdbnoise "" --fold; echo "${COMPREPLY[*]}"' \
  "$root/usr/share/bash-completion/completions/vdbnoise" | tr '\n' ' ')
[[ $completed == "fire none ridged "* ]] || fail "bash completes to $completed after ="
if command -v zsh >/dev/null; then
  completed=$(zsh -c '_describe() { print -rl -- $lines }; _files() { print files }; compset() { PREFIX=${PREFIX#*=} }; CURRENT=2
    words=(vdbnoise --preset=f) PREFIX=--preset=f; source $1; words=(vdbnoise --shape=x) PREFIX=--shape=x; source $1' zsh \
    "$root/usr/share/zsh/vendor-completions/_solidnoise")
  [[ $completed == fire*files ]] || fail "zsh completes to $completed after ="
fi

# The library by CMake, the Python module by the system's Python.
cmake -S "$project/examples/consumer" -B consumer -D CMAKE_PREFIX_PATH="$root/usr" -D CMAKE_BUILD_TYPE=Release >cmake.txt || { cat cmake.txt; fail "the consumer cannot be configured"; }
cmake --build consumer --target "$target" >build.txt || { cat build.txt; fail "the consumer cannot be built"; }
for program in variance write_volume draw_spectrum; do
  [[ ! -x consumer/$program ]] || "consumer/$program" >/dev/null || fail "$program of the consumer fails"
done
PYTHONPATH=$root/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - "$root" "$project" <<'PYTHON'
import sys
import solidnoise
root, project = sys.argv[1:]
assert solidnoise.__file__.startswith(root + "/usr/lib/python3/"), solidnoise.__file__
assert solidnoise.gabor(frequency=4, seed=7).lattice(origin=0, step=0.02, shape=(8, 8, 8)).shape == (8, 8, 8)
assert "smoke" in solidnoise.presets()
solidnoise.fit(project + "/examples/exemplars/soil.jpg")  # by the module that reads pictures
PYTHON

# Blender finds the add-on, and that the module.
if command -v blender >/dev/null; then
  [[ -z $root ]] || export BLENDER_USER_SCRIPTS=$root/usr/share/blender/scripts
  PYTHONPATH=$root/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 BLENDER_USER_CONFIG=$PWD blender --background \
    --factory-startup --python-exit-code 3 --python-expr "
import addon_utils
addon = addon_utils.enable('solidnoise_blender')
assert addon.__file__.startswith('$root/usr/share/blender/'), addon.__file__
assert not addon.missing, addon.missing
assert addon.solidnoise.__file__.startswith('$root/usr/lib/python3/'), addon.solidnoise.__file__" >blender.txt 2>&1 ||
    { cat blender.txt; fail "Blender cannot enable the add-on"; }
fi
echo "packages: what is installed under ${root:-/} works"
