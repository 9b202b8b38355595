#!/usr/bin/env bash
# packages_test.sh BUILD PROJECT WORK: the Debian packages of a build tree: lintian has no error to tell, they hold no path of the build
# tree and no search path, what each links is of the packages that it depends on, and what they install, unpacked into a folder, works.
set -euo pipefail
build=$1 project=$2 work=$3
fail() {
  echo "packages: $1" >&2
  exit 1
}

rm -rf "$work"
mkdir -p "$work"
cpack --config "$build/CPackConfig.cmake" -B "$work" >"$work/cpack.txt" 2>&1 || { cat "$work/cpack.txt"; fail "cpack failed"; }
lintian --allow-root --fail-on error "$work"/*.deb

for package in "$work"/*.deb; do
  name=$(dpkg-deb --field "$package" Package)
  depends=$(dpkg-deb --field "$package" Depends)
  echo "$name: $(stat --format=%s "$package") bytes; depends on $depends"
  dpkg-deb --extract "$package" "$work/$name"
  ! grep --recursive --text --files-with-matches --fixed-strings -e "$build" -e "$project" "$work/$name" || fail "$name names the build's folders"
  while read -r file; do
    readelf --file-header "$file" >/dev/null 2>&1 || continue
    ! readelf --dynamic "$file" | grep -E 'RPATH|RUNPATH' || fail "$file has a search path"
    for library in $(readelf --dynamic "$file" | sed --quiet 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
      path=$(ldd "$file" | awk -v name="$library" '$1 == name || $1 ~ "/" name "$" { print $3 ~ "/" ? $3 : $1 }')
      owner=$({ dpkg-query --search "$path" "/usr$path" 2>/dev/null || true; } | sed --quiet '1s/:.*//p')
      [[ -n $owner ]] || fail "$file links $library, which is of no package"
      [[ ", $depends, " == *", $owner"[\ ,]* ]] || fail "$file links $library of $owner, on which $name does not depend"
    done
  done < <(find "$work/$name" -type f)
  dpkg-deb --extract "$package" "$work/root"
done

"$project/tests/packages/use_installed.sh" "$work/root" "$project" "$work/use" variance
