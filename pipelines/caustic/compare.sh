#!/bin/bash
# One scene from meshes to a picture by several settings: what each takes, and how far it is off.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   BIN=... WORK=... CAUSTIC=... compare.sh NAME 'RESOLUTION:DETAIL:LOG2_PHOTONS:SAMPLES ...'
#     mesh2vol's options -- meshes -- lightsim's options -- render's options
# The exact picture is WORK/NAME_exact.exr.
set -eu
name=$1 settings=$2
shift 2
parts=([0]="" [1]="" [2]="" [3]="")
part=0
for word; do
    if [[ $word == -- ]]; then part=$((part + 1)); else parts[part]+=" $word"; fi
done
now() { date +%s.%N; }
took() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.1f", b - a }'; }

printf '%-10s %-34s %8s %8s %8s %8s   %s\n' method \
    'resolution:detail:photons:samples' mesh2vol lightsim render seconds 'off the exact picture'
for setting in $settings; do
    IFS=: read -r resolution detail photons samples <<<"$setting"
    a=$(now)
    # The parts are lists of words.
    # shellcheck disable=SC2086
    "$BIN"/mesh2vol ${parts[1]} -o "$WORK/$name.vdb" ${parts[0]} --resolution "$resolution" --quiet
    b=$(now)
    # shellcheck disable=SC2086
    "$BIN"/lightsim "$WORK/$name.vdb" -o "$WORK/${name}_lit.vdb" ${parts[2]} \
        --method beams --surface-detail "$detail" --photons $((1 << photons)) --quiet
    c=$(now)
    # shellcheck disable=SC2086
    "$BIN"/render "$WORK/${name}_lit.vdb" -o "$WORK/$name.exr" ${parts[3]} \
        --samples "$samples" --quiet
    d=$(now)
    printf '%-10s %-34s %8s %8s %8s %8s   %s\n' beams "$resolution:$detail:2^$photons:$samples" \
        "$(took "$a" "$b")" "$(took "$b" "$c")" "$(took "$c" "$d")" "$(took "$a" "$d")" \
        "$("$CAUSTIC" compare "$WORK/$name.exr" "$WORK/${name}_exact.exr" | paste -sd ';')"
done
oiiotool "$WORK/$name.exr" --ch R,G,B "$WORK/${name}_exact.exr" --ch R,G,B --mosaic:pad=4 2x1 \
    --colorconvert linear sRGB -o "$WORK/$name.png"
