#!/bin/bash
# The manners of sim2vol: what it answers, with which status, and what it makes of which grid.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=sim2vol
. "$(dirname "$0")/../support/manners.sh"

test_help() {
    expect 0 sim2vol --help
    local word
    for word in IN.vdb gladstone-dale air --scattering-from Houdini Blender Ciddor; do
        prints "$word"
    done
    expect 0 sim2vol --version
    grep -q '^sim2vol [0-9]' stdout || fail "--version names no version"
    help_is_cut
}

test_bad_usage() {
    refuses 64
    refuses 64 smoke.vdb
    refuses 64 -o out.vdb
    refuses 64 smoke.vdb -o out.vdb --nonsense
    local value
    refuses 64 smoke.vdb -o out.vdb --ior-from=
    for value in density density: :5 density:x density:nan density:1,2 density:1:2:3 \
        density:gladstone-dale:0 density:gladstone-dale:-1 density:gladstone-dale:x \
        temperature:air:0 temperature:air:-5 temperature:water temperature:air:1:2; do
        refuses 64 smoke.vdb -o out.vdb --ior-from="$value"
        says "--ior-from: found '$value', expected GRID:gladstone\|--ior-from: found '$value', expected a "
    done
    for value in density:air density:1,2 density:1:inf; do
        refuses 64 smoke.vdb -o out.vdb --scattering-from="$value"
        says "expected GRID:SCALE"
    done
    refuses 64 smoke.vdb -o out.vdb --sdf-from density:-1
    refuses 64 smoke.vdb -o out.vdb --sdf-from density:1:2
    for value in 0 -1 x 1:x 1:2:3 nan; do
        refuses 64 smoke.vdb -o out.vdb --ior-from temperature:air --kelvin="$value"
        says '--kelvin'
    done
    for value in 0 -1 x; do
        refuses 64 smoke.vdb -o out.vdb --ior-from temperature:air --ambient="$value"
        says '--ambient'
    done
    refuses 64 smoke.vdb -o out.vdb --ior-from density:1 --ambient 300
    refuses 64 smoke.vdb -o out.vdb --ior-from density:1 --kelvin 2
    refuses 64 both.vdb -o out.vdb --albedo-from emission:1 --emission-from albedo:1
    says 'made of one another'
}

test_bad_input() {
    refuses 66 absent.vdb -o out.vdb
    refuses 65 smoke.vdb -o out.vdb --ior-from smoke:1
    says "no grid 'smoke' (found: "
    refuses 65 other.vdb -o out.vdb
    says "no grid 'density' or 'flame' (found: fuel)"
    refuses 65 smoke.vdb -o out.vdb --ior-from v_color:1
    says "grid 'v_color' holds vec3s, expected float for 'ior'"
    # Nothing surrounds Houdini's and Blender's grids but 0, which is no temperature.
    refuses 65 smoke.vdb -o out.vdb --ior-from temperature:air
    says "the background is 0, expected above 0, which is 0 K (--kelvin"
    refuses 65 smoke.vdb -o out.vdb --ior-from density:1
    says "by which 'ior' is 0, expected > 0"
    refuses 65 smoke.vdb -o out.vdb --anisotropy-from density:3
    says "by which 'anisotropy' is "
    echo text >bad.vdb
    refuses 65 bad.vdb -o out.vdb
    rm bad.vdb
}

test_outputs_that_fail() {
    refuses 73 smoke.vdb -o absent/out.vdb
    echo mine >out.vdb
    expect 73 sim2vol smoke.vdb -o out.vdb --no-clobber
    [ "$(cat out.vdb)" = mine ] || fail "--no-clobber let the file be changed"
    rm out.vdb
    refuses 74 smoke.vdb -o /dev/full
    cp smoke.vdb out.vdb
    expect 64 sim2vol out.vdb -o out.vdb
    cmp -s smoke.vdb out.vdb || fail "the input was changed"
    rm out.vdb
}

test_explains() {
    expect 0 sim2vol smoke.vdb --explain
    prints "^scattering: on (1 x of grid 'density')"
    prints "^emission: on (1 x of grid 'flame')"
    prints "^ior: off (not asked for)"
    expect 0 sim2vol smoke.vdb --explain --ior-from temperature:air:90000 --kelvin 300:293.15
    prints "^ior: on (that of dry air at x K and 90000 Pa of grid 'temperature')"
    prints "^scattering: off"
    # Blender calls it so.
    expect 0 sim2vol blender.vdb --explain --ior-from temperature:air --ambient 293.15
    prints "of grid 'heat')"
    expect 0 sim2vol old.vdb --explain
    prints "^emission: on (1 x of grid 'heat')"
    nothing_left
}

test_makes_and_pipes() {
    expect 0 sim2vol smoke.vdb -o out.vdb --scattering-from density:5 --albedo-from v_color:1 \
        --absorption-from density:1,2,3 --ior-from density:gladstone-dale --stats stats.json
    [ ! -s stdout ] || fail "it wrote to standard output"
    [ ! -s stderr ] || fail "it talked"
    holds stats.json '.counters.grids == 4'
    if command -v vdb_print >/dev/null; then
        vdb_print -l out.vdb >stdout
        local grid
        for grid in density temperature flame v_color fuel; do prints "^Name: *$grid\|$grid"; done
        prints 'sim2vol smoke.vdb -o out.vdb --scattering-from density:5'
        prints 'make_volume smoke.vdb' # the stage before
    fi
    expect 0 render out.vdb --explain -o x.exr --eye 0,0,9 --target 0,0,0 --fov 20 --size 4x4
    prints "^refraction: on"
    expect 0 bash -c 'sim2vol - -o - <smoke.vdb | sim2vol - -o - --opacity-from density:0.1 |
        sim2vol - --explain -o -'
    expect 0 bash -c 'for t in 1 2; do sim2vol - -o - --threads $t <smoke.vdb >out$t; done'
    cmp -s <(tail -c +4096 out1) <(tail -c +4096 out2) || fail "the threads change the values"
    rm -f out*
}

test_a_faint_index_stays_whole() {
    # A float of an index near 1 is 6e-8 off, of which render warns; blurred, too.
    expect 0 make_volume faint.vdb size=16 density sphere:5:1:0
    expect 0 sim2vol faint.vdb -o out.vdb --ior-from density:2e-6:1.0002
    expect 0 volsmooth out.vdb -o out.smooth.vdb --sigma 2
    local file
    for file in out.vdb out.smooth.vdb; do
        expect 0 render $file --explain -o x.exr --eye 0,0,99 --target 0,0,0 --fov 10 --size 4x4
        prints "^refraction: on"
        grep -q 'round by' stdout && fail "$file lost digits"
    done
    expect 0 make_volume out.float.vdb size=16 ior=1.0002 sphere:5:1.000202:1.0002
    expect 0 render out.float.vdb --explain -o x.exr --eye 0,0,99 --target 0,0,0 --fov 10 --size 4x4
    prints 'round by'
    rm out*
}

test_cuts_with_a_warning() {
    expect 0 sim2vol smoke.vdb -o out.vdb --opacity-from density:2 --stats stats.json
    says "'opacity' would be above 1 in [0-9]* voxels"
    holds stats.json '.counters.voxels_cut > 0 and (.warnings | length) == 1'
    expect 0 sim2vol smoke.vdb -o out.vdb --scattering-from density:-1
    says "'scattering' would be below 0 in [0-9]* voxels: it is 0 there"
    rm out.vdb
}

make_volume smoke.vdb size=16 voxel=0.1 density sphere:0.5:1:0 temperature sphere:0.5:1:0 \
    flame sphere:0.2:1:0 fuel sphere:0.2:1:0 v_color sphere:0.5:0.2,0.5,0.9:0 || exit 2
make_volume blender.vdb size=8 heat sphere:2:400:0 density sphere:2:1:0 || exit 2
make_volume old.vdb size=8 heat sphere:2:1:0 density sphere:2:1:0 temperature sphere:2:1:0 || exit 2
make_volume other.vdb size=8 fuel sphere:2:1:0 || exit 2
make_volume both.vdb size=8 albedo constant:0.5 emission constant:1 || exit 2
run_tests
