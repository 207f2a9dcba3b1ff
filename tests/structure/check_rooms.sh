#!/usr/bin/env bash
# Holds every #include in libcore to libcore/rooms.txt, and vendors' headers to their one room.
# Rerun: bash tests/structure/check_rooms.sh .
# SPDX-License-Identifier: GPL-3.0-or-later
set -uo pipefail
cd "${1:-.}/libcore" || exit 2
bad=0
complain() { echo "$1"; bad=1; }

declare -A allowed
while IFS=: read -r room may; do
    room=${room//[[:space:]]/}
    [ -n "$room" ] && allowed[$room]=" $room $may "
done < <(sed 's/#.*//' rooms.txt)
[ ${#allowed[@]} -ge 2 ] || { echo "rooms.txt names no rooms"; exit 2; }

for folder in */; do
    room=${folder%/}
    [ -n "${allowed[$room]:-}" ] || { complain "libcore/$room is not in rooms.txt"; continue; }
    while IFS=: read -r file line include; do
        other=$(sed -E 's/.*"([^"\/]+)\/.*/\1/' <<<"$include")
        # Structs and functions that shaders and C++ both read.
        [ "$other" = shared ] || [ "$other" = lib ] && continue
        [ -d "$other" ] || { complain "libcore/$file:$line: includes \"$other/...\", which is no room"; continue; }
        case "${allowed[$room]}" in
        *" $other "*) ;;
        *) complain "libcore/$file:$line: room $room may not include room $other" ;;
        esac
    done < <(grep -rnE '^#include "[^"]+/' "$room")
done

# A room is granted no more than it uses.
for room in "${!allowed[@]}"; do
    for other in ${allowed[$room]}; do
        [ "$other" = "$room" ] && continue
        grep -rqE "^#include \"$other/" "$room" || complain "rooms.txt: room $room never includes room $other"
    done
done

# vendor pattern : the rooms behind whose door it stays
while IFS='|' read -r pattern rooms; do
    while IFS=: read -r file line _; do
        case " $rooms " in
        *" ${file%%/*} "*) ;;
        *) complain "libcore/$file:$line: $pattern belongs to: $rooms" ;;
        esac
    done < <(grep -rnE "^#include <$pattern" .  | sed 's|^\./||')
done <<'E2'
openvdb/|volume
CGAL/|mesh
OpenEXR/|image
Imf|image
Imath|image volume
OpenImageIO/|image
EGL/|gpu
embree|raytrace
ft2build|shapes
tiny_gltf|scenefile
epoxy/|gpu
CLI/|none
gtest/|none
E2
[ $bad -eq 0 ] && echo "rooms: every include is granted"
exit $bad
