#!/bin/bash
# The manners of render with meshes: what it answers, with which status, and what it leaves behind.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=render
. "$(dirname "$0")/../support/manners.sh"
view='--eye 0.3,0.4,5 --target 0,0,0 --fov 30 --size 16x12'
glass='--method dir --ior 1.5'

# cube FILE [OPEN]: a cube of 2; without its last face where OPEN is given.
cube() {
    local faces=6
    [ -n "${2:-}" ] && faces=5
    {
        printf 'OFF\n8 %d 0\n' $faces
        printf '%s\n' '-1 -1 -1' '1 -1 -1' '1 1 -1' '-1 1 -1' '-1 -1 1' '1 -1 1' '1 1 1' '-1 1 1'
        printf '%s\n' '4 0 3 2 1' '4 4 5 6 7' '4 0 1 5 4' '4 2 3 7 6' '4 1 2 6 5' '4 0 4 7 3' | head -n $faces
    } >"$1"
}
cube cube.off
cube open.off open
{ head -n 10 cube.off; sed -n '11,$p' cube.off | awk '{ print $1, $5, $4, $3, $2 }'; } >inward.off

test_makes_pictures() {
    local method
    for method in dir isr sir rays; do
        expect 0 render cube.off -o "a_$method.exr" $view --ior 1.3 --method $method --background 0.5 --aov all
        expect 0 render cube.off -o "b_$method.exr" $view --ior 1.3 --method $method --background 0.5 --aov all --threads 1
        [ "$(pixels "a_$method.exr")" = "$(pixels "b_$method.exr")" ] || fail "$method: another picture by one thread"
    done
}

# A sum of the pixels alone: headers have the commands, which differ.
pixels() { oiiotool --info -v --hash "$1" | grep 'SHA-1'; }

test_reruns_are_the_same_bytes() {
    local method
    for method in dir isr sir rays; do
        expect 0 render cube.off -o one.exr $view --ior 1.3 --method $method --background 0.5 --samples 2
        mv one.exr before.exr
        expect 0 render cube.off -o one.exr $view --ior 1.3 --method $method --background 0.5 --samples 2
        cmp -s one.exr before.exr || fail "$method: another file the second time"
    done
}

test_makes_frames() {
    cp cube.off m_0003.off
    cp cube.off m_0005.off
    expect 0 render 'm_####.off' --frames 3-5/2 -o 'f_####.exr' -o 'f_##.png' $view $glass --background 1 --stats s.json
    ls f_0003.exr f_0005.exr f_03.png f_05.png >/dev/null || fail 'not every frame is there'
    holds s.json '.counters.frames == 2'
    refuses 66 'm_####.off' --frames 3-4 -o 'out_####.exr' $view $glass
    says 'm_0004.off'
    refuses 64 'm_####.off' --frames 3-5/2 -o out.exr $view $glass
    says '####'
    refuses 64 'm_####.off' --frames 3-5/2 -o 'm_####.off' $view $glass
    local value
    for value in a 5-3 1-2-3 1-2/0 1-2/x -1; do
        refuses 64 cube.off "--frames=$value" -o 'out_#.exr' $view $glass
        says 'frames'
    done
}

test_bad_meshes() {
    refuses 65 open.off -o out.exr $view $glass
    says 'open.off: bounds no volume'
    refuses 65 inward.off -o out.exr $view $glass
    says 'inward.off'
    refuses 66 none.off -o out.exr $view $glass
    says 'none.off'
    echo nothing >bad.off
    refuses 65 bad.off -o out.exr $view $glass
}

test_eye_within() {
    refuses 64 cube.off -o out.exr --eye 0.1,0,0 --target 0,0,3 --fov 30 --size 8x8 $glass
    says '--eye'
}

test_nothing_in_view() {
    expect 0 render cube.off -o away.exr --eye 0,0,5 --target 0,0,9 --fov 30 --size 8x8 $glass --background 1
    says 'warning: no triangle is in view'
}

test_bad_values() {
    local value
    for value in ior=0 ior=-1 ior=nan ior=100 ior=x absorption=-1 absorption=1,2 search-steps=0 \
        search-steps=99 search-steps=x samples=0 method=magic method= aov=error \
        background=-1 plate=none.off:2; do
        refuses 64 cube.off $view --method dir --ior 1.5 -o out.exr "--$value"
        says "${value%%=*}"
    done
    refuses 64 cube.off $view --method dir -o out.exr
    says '--ior'
}

# What a method has no use for is refused, not ignored.
test_options_of_other_methods() {
    local value
    for value in step=1 integrator=verlet tolerance=1 boundary=sharp wavelengths=4 grid-ior=n \
        light=l.exr place=a.vdb:0,0,0 max-steps=9 max-depth=9 cutoff=0.1 plate=cube.off; do
        refuses 64 cube.off $view $glass -o out.exr "--$value"
        says "--${value%%=*}"
    done
    for value in ior=1.5 absorption=1 search-steps=4 layers=2 plate=cube.off frames=1-2; do
        refuses 64 in.vdb $view -o out.exr "--$value"
        says "--${value%%=*}"
    done
    refuses 64 cube.off $view --method sir --ior 1.5 --search-steps 3 -o out.exr
    refuses 64 cube.off $view --method rays --ior 1.5 --layers 3 -o out.exr
}

test_explains() {
    expect 0 render cube.off -o out.exr $view $glass --explain
    prints '^method: dir$'
    prints '^triangles: 12$'
    prints '^absorption: off'
    nothing_left
}

run_tests
