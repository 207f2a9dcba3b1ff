#!/usr/bin/env bash
# Writes the tables of shaders/README.md anew from the headers that shaders and C++ both read:
# shader_docs.sh FOLDER [--check]. With --check it only says whether they are as they should be.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
folder=$1
made=$(mktemp)
trap 'rm -f "$made"' EXIT
bindings() { # "// Heading:" begins a group, "const int kName = N; // meaning" is a row
    awk '
        /^\/\/ .*[.:]$/ { group = substr($0, 4); sub(/[.:]$/, "", group); next }
        /^const int k/ {
            name = $3; number = $5; sub(/;/, "", number)
            meaning = $0; if (!sub(/^.*\/\/ /, "", meaning)) meaning = ""
            printf "| %s | `%s` | %s | %s |\n", group, name, number, meaning
        }' "$folder/shared/bindings.h"
}
awk -v rows="$(bindings)" '
    /<!-- bindings -->/ { print; print ""; print "| what | name | number | holds |"; print "|---|---|---|---|"
                          print rows; print ""; skip = 1; next }
    /<!-- end -->/ { skip = 0 }
    !skip { print }' "$folder/README.md" >"$made"
if [ "${2:-}" = --check ]; then
    cmp -s "$made" "$folder/README.md" || { echo "$folder/README.md: run make docs"; exit 1; }
else
    cat "$made" >"$folder/README.md"
fi
