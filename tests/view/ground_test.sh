#!/bin/bash
# A ground from mesh2vol to the picture: what the files say of it at each stage, and what is refused.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=render
. "$(dirname "$0")/../support/manners.sh"
view='--eye 0,1,5 --target 0,0,0 --fov 30 --size 16x12'
sun='--light sun=directional:0,-1,0.1:3'

# tells FILE TEXT: a line of a file's metadata, or two.
tells() { grep -aqF -e "$2" "$1" || fail "$1 does not tell '$2'"; }

# misses FILE TEXT: none of that.
misses() { if grep -aqF -e "$2" "$1"; then fail "$1 tells '$2'"; fi; }

test_metadata_go_on() {
    tells in.vdb '-0.5 0.8,0.6,0.4 0.25'
    misses in.vdb eikonal:lights
    expect 0 volsmooth in.vdb -o smooth.vdb
    tells smooth.vdb '-0.5 0.8,0.6,0.4 0.25'
    expect 0 lightsim in.vdb $sun --light point:0,3,0:2 --light-samples 4 --lights-apart -o all.vdb
    tells all.vdb '-0.5 0.8,0.6,0.4 0.25'
    tells all.vdb $'sun=directional:0,-1,0.1:3\npoint:0,3,0:2'
    tells all.sun.vdb sun=directional:0,-1,0.1:3
    grep -aq '^point:' all.sun.vdb && fail "the sun's file tells of the point"
    # Light replaces what the file held; so do the records.
    expect 0 lightsim all.vdb --light lamp=point:0,3,0:7 -o again.vdb
    tells again.vdb lamp=point:0,3,0:7
    oiiotool --pattern constant:color=0.5,0.25,1 32x16 3 -d float -o sky.exr || exit 2
    expect 0 lightsim in.vdb --light environment:sky.exr --light-samples 4 -o sky.vdb
    tells sky.vdb 1=upward:1.5708 # π times the radiance
    # No light on surfaces, no record.
    expect 0 lightsim in.vdb $sun --outputs fluence --photons 64 -o fluence.vdb
    misses fluence.vdb eikonal:lights
}

test_explain_tells_of_it() {
    expect 0 mesh2vol box.obj --ior 1.5 --ground=-0.5:0.8:"checker 2" --explain
    prints '^ground: y = -0.5, albedo 0.8,0.8,0.8, checker of 2$'
    expect 0 lightsim in.vdb $sun -o out.vdb --explain
    prints '^ground: the lights are recorded for what lies beyond the domain$'
    expect 0 render in.vdb $view -o out.exr --explain
    prints "^ground: on (metadata 'eikonal:ground')$"
    expect 0 render in.vdb $view -o out.exr --boundary blurred --explain
    prints '^ground: off (boundaries are blurred)$'
    expect 0 render plain.vdb $view -o out.exr --explain
    prints "^ground: off (no metadata 'eikonal:ground')$"
}

test_wrong_metadata_are_refused() {
    LC_ALL=C sed 's/-0.5 0.8,0.6,0.4/-0.5 0.8,0.6,9.4/' in.vdb >bad.vdb
    for tool in render lightsim; do
        [ $tool = render ] && refuses 65 bad.vdb $view -o out.exr || refuses 65 bad.vdb $sun -o out.vdb
        says "bad.vdb: metadata 'eikonal:ground' are '-0.5 0.8,0.6,9.4 0.25' (an albedo beyond 0 to 1)"
    done
    tool=render
    expect 0 lightsim in.vdb $sun -o lit.vdb
    LC_ALL=C sed 's/sun=directional/sun=directorial/g' lit.vdb >bad.vdb
    refuses 65 bad.vdb $view -o out.exr
    says "metadata 'eikonal:lights' hold 'sun=directorial:0,-1,0.1:3', expected a light"
    LC_ALL=C sed 's/-0.5 0.8,0.6,0.4/-0.5 0.8,0.6,0.3/' in.vdb >other.vdb
    refuses 65 in.vdb other.vdb $view -o out.exr
    says 'other.vdb: its ground is -0.5 0.8,0.6,0.3 0.25, expected that of the files before'
}

printf 'v %s\n' '-0.5 -0.4 -0.5' '0.5 -0.4 -0.5' '0.5 0.4 -0.5' '-0.5 0.4 -0.5' '-0.5 -0.4 0.5' '0.5 -0.4 0.5' \
    '0.5 0.4 0.5' '-0.5 0.4 0.5' >box.obj
printf 'f %s\n' '1 4 3 2' '5 6 7 8' '1 2 6 5' '4 8 7 3' '1 5 8 4' '2 3 7 6' >>box.obj
mesh2vol box.obj -o plain.vdb --ior 1.5 --resolution 24 || exit 2
mesh2vol box.obj -o in.vdb --ior 1.5 --resolution 24 --ground=-0.5:0.8,0.6,0.4:"checker 0.25" || exit 2
run_tests
