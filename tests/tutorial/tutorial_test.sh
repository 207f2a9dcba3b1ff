#!/bin/bash
# Runs every command of docs/tutorial.md as it is printed: tutorial_test.sh BUILD_FOLDER [FOLDER], which is kept.
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
build=$(cd "$1" && pwd)
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if [ $# -gt 1 ]; then
    mkdir -p "$2"
    folder=$2
else
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
fi
PATH=$build/bin:$PATH
awk '/^```sh$/ { on = 1; next } /^```$/ { on = 0 } on' "$root/docs/tutorial.md" >"$folder/commands.sh"
tools=$(grep -c -E '^(meshgen|mesh2vol|sim2vol|lightsim|render) ' "$folder/commands.sh")
[ "$tools" -ge 10 ] || { echo "FAILED: only $tools commands were found in docs/tutorial.md"; exit 1; }
cd "$folder" || exit 1
bash -e -o pipefail commands.sh >log 2>&1 || { echo "FAILED: $(tail -3 log)"; exit 1; }
for picture in drink.png haze.png schlieren.png; do
    [ -s $picture ] || { echo "FAILED: no $picture"; exit 1; }
    # What is printed is what comes out: the pictures of the page are these.
    idiff -fail 0.06 -failpercent 2 "$picture" "$root/docs/tutorial_$picture" >idiff.txt 2>&1
    [ $? -le 1 ] || { echo "FAILED: $picture is not docs/tutorial_$picture: $(tr '\n' ' ' <idiff.txt)"; exit 1; }
done
echo "all passed"
