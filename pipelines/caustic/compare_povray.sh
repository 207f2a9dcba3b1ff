#!/bin/bash
# The ball over its floor by POV-Ray with photons: what each spacing of them takes, and how far the
# picture is off.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   WORK=... CAUSTIC=... compare_povray.sh SCENE.pov WIDTHxHEIGHT 'SPACING:SAMPLES ...'
set -eu
scene=$(realpath "$1") size=$2 settings=$3
for setting in $settings; do
    IFS=: read -r spacing samples <<<"$setting"
    smooth=-A
    # Two by two in every pixel, not where neighbours differ alone.
    if ((samples == 4)); then smooth='+A0.0 +AM1 +R2 -J'; fi
    a=$(date +%s.%N)
    # The options are a list of words.
    # shellcheck disable=SC2086
    (cd "$WORK" && povray +I"$scene" +Opovray.exr +FE +W"${size%x*}" +H"${size#*x}" -D $smooth \
        Declare=Spacing="$spacing" 2>povray.log) || { tail "$WORK/povray.log" >&2; exit 70; }
    b=$(date +%s.%N)
    printf '%-10s %-61s %8s   %s\n' POV-Ray "$spacing:$samples" \
        "$(awk -v a="$a" -v b="$b" 'BEGIN { printf "%.1f", b - a }')" \
        "$("$CAUSTIC" compare "$WORK/povray.exr" "$WORK/ball_exact.exr" | paste -sd ';')"
done
