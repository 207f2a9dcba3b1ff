#!/bin/bash
# The gallery's pictures, small, against golden ones: gallery_test.sh BUILD_FOLDER [NAME...], or
# --update BUILD_FOLDER [NAME...] to make those anew (look at them before committing).
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
update=no
[ "${1:-}" = --update ] && { update=yes; shift; }
build=$(cd "$1" && pwd)
shift
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
golden=$root/tests/gallery/golden
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$root" || exit 1

# In 8 bits of sRGB: a pixel differs where it is off by more than 0.06, a twentieth of what displays show; 2 % of
# them may, where other devices meet a silhouette or a small facet with another ray.
each=0.06 share=2

names=("$@")
[ ${#names[@]} -gt 0 ] || mapfile -t names < <(grep -l '^# Small: ' pipelines/gallery/*.mk | xargs -n1 basename -s .mk)
failed=0
for name in "${names[@]}"; do
    recipe=pipelines/gallery/$name.mk
    needs=$(sed -n 's/^# Needs: //p' "$recipe")
    if [ -n "$needs" ] && [ ! -e "$needs" ]; then
        echo "$name: left out, since there is no $needs"
        continue
    fi
    eval "small=($(sed -n 's/^# Small: //p' "$recipe"))"
    if ! make -s -f "$recipe" BIN="$build/bin" OUT="$work" "${small[@]}" >"$work/$name.log" 2>&1; then
        echo "FAILED $name: $(tail -3 "$work/$name.log")"
        failed=1
        continue
    fi
    oiiotool "$work/$name.png" --ch R,G,B -d uint8 -o "$work/$name.small.png"
    if [ $update = yes ]; then
        mkdir -p "$golden"
        oiiotool "$work/$name.small.png" --eraseattrib '.*' --nosoftwareattrib -o "$golden/$name.png"
        echo "golden/$name.png: $(stat -c %s "$golden/$name.png") bytes, to be looked at"
        continue
    fi
    idiff -fail $each -failpercent $share "$work/$name.small.png" "$golden/$name.png" >"$work/idiff.txt" 2>&1
    if [ $? -gt 1 ]; then
        cp "$work/$name.small.png" "${TMPDIR:-/tmp}/eikonal-$name.png"
        echo "FAILED $name: differs from golden/$name.png: $(tr '\n' ' ' <"$work/idiff.txt")"
        echo "  see ${TMPDIR:-/tmp}/eikonal-$name.png; rerun: bash tests/gallery/gallery_test.sh $build $name"
        failed=1
    else
        echo "passed $name"
    fi
done
exit $failed
