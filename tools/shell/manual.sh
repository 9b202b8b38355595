#!/usr/bin/env bash
# manual.sh PROGRAM FOLDER: a page of the manual for the program and for each of its commands, made of their help by help2man.
set -euo pipefail
program=$1
folder=$2
name=$(basename "$program")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"

# What help2man reads: commands apart from each other, and two spaces before what they do, which begins with a verb.
cat >"$work/$name" <<END
#!/usr/bin/env bash
"$(realpath "$program")" "\$@" | sed -E '/^  $name /{/[^ ]  +[^ ]/!s/ ([a-z]+s [a-z])/  \1/;G}'
END
chmod +x "$work/$name"

# page [COMMAND]: what it does, in one line, is the beginning of what it says.
page() {
  local title=$name${1:+-$1}
  local does
  does=$("$program" "$@" --help | sed -n '/^Usage:\|^  /q; p' | tr '\n' ' ' | sed "s/^$name\( $*\)\? //; s/[.,:;] .*//")
  help2man --no-info --help-option=--help-all --version-string="$("$program" --version | cut -d' ' -f2)" --name="${does,}" "$work/$name $*" |
    sed "s/^\.TH [^ ]*/.TH ${title^^}/; s/^$name $* \\\\-/$title \\\\-/" | gzip -9n >"$work/$title.1.gz"
}

page
for command in $("$program" --complete '' | cut -d' ' -f1 | grep -v '^-'); do
  [[ $command == make ]] || page "$command"  # is what happens without one
done
mv "$work"/*.gz "$folder"
