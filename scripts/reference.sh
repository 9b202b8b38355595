#!/usr/bin/env bash
# reference.sh: renders the library's headers, and docs/library.md in front of them, into build/reference/html, by Doxygen.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh doxygen
rm -rf build/reference && mkdir -p build/reference
# Comments before a thing become its documentation, and so do those behind a member.
cat >build/reference/filter.sed <<'SED'
s#^( *)//( |$)#\1///\2#
s#(;|,|\{) +// #\1  ///< #
SED
warnings=build/reference/warnings.txt
doxygen - <<SETTINGS
PROJECT_NAME = Solidnoise
PROJECT_BRIEF = "Procedural solid noise with a known spectrum"
INPUT = src/solidnoise docs/library.md
USE_MDFILE_AS_MAINPAGE = docs/library.md
RECURSIVE = YES
FILE_PATTERNS = *.h
EXCLUDE_PATTERNS = *-inl.h */module/*
FILTER_PATTERNS = *.h="sed -E -f build/reference/filter.sed"
OUTPUT_DIRECTORY = build/reference
STRIP_FROM_PATH = src
JAVADOC_AUTOBRIEF = YES
EXTRACT_ALL = YES
HAVE_DOT = NO
SORT_MEMBER_DOCS = NO
GENERATE_LATEX = NO
QUIET = YES
WARN_LOGFILE = $warnings
SETTINGS
echo "build/reference/html/index.html ($(wc -l <"$warnings") warnings in $warnings)"
