#!/bin/bash
# The manners of meshgen: what it answers, with which status, and that mesh2vol takes what it makes.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=meshgen
. "$(dirname "$0")/../support/manners.sh"

test_help() {
    expect 0 meshgen --help
    local word
    for word in revolve implicit brilliant prism box sphere logo wave flecks --place; do
        prints "$word"
        [ "$word" = --place ] || expect 0 meshgen $word --help
        [ "$word" = --place ] || prints "Example: meshgen $word"
        expect 0 meshgen --help
    done
    expect 0 meshgen --help-all
    prints --pavilion
    prints gyroid
    expect 0 meshgen --version
    grep -q '^meshgen [0-9]' stdout || fail "--version names no version"
    help_is_cut
}

test_bad_usage() {
    refuses 64
    says 'one of revolve, implicit'
    refuses 64 box
    says 'not given: --output'
    refuses 64 cone -o out.obj
    says "no such kind: 'cone', expected one of revolve"
    refuses 64 revolv profile.csv -o out.obj
    says 'did you mean revolve?'
    refuses 64 box sphere -o out.obj
    refuses 64 revolve -o out.obj
    says 'PROFILE'
    refuses 64 brilliant --pavilon 41 -o out.obj
    says 'did you mean --pavilion'
    refuses 64 box -o out.stl
    says 'expected .obj'
    refuses 64 box -o out.obj -o out2.obj
    refuses 64 box --from 1,1,1 --to 0,0,0 -o out.obj
    refuses 64 box --from 1,1 -o out.obj
    refuses 64 prism --sides 2 -o out.obj
    refuses 64 prism --side x -o out.obj
    refuses 64 prism --side nan -o out.obj
    refuses 64 implicit ball -o out.obj
    refuses 64 implicit torus --cells 3 -o out.obj
    refuses 64 sphere --place 1,2 -o out.obj
    says '--place'
    refuses 64 sphere --place a.obj:1,2,3 -o out.obj
    refuses 64 wave --bottom 0 -o out.obj
    refuses 64 logo -o out.obj
}

test_bad_input() {
    refuses 66 revolve absent.csv -o out.obj
    refuses 66 flecks absent.obj -o out.obj
    refuses 66 logo A --font absent.ttf -o out.obj
    printf '1,0\n-1,2\n' >bad.csv
    refuses 65 revolve bad.csv -o out.obj
    says 'bad.csv: line 2: found a radius of -1'
    expect 0 bash -c 'meshgen wave --squares 4 -o sheet.obj'
    refuses 65 flecks sheet.obj -o out.obj
    says 'bounds no volume'
    rm bad.csv sheet.obj
}

test_outputs_that_fail() {
    refuses 73 box -o absent/out.obj
    echo mine >out.obj
    expect 73 meshgen box -o out.obj --no-clobber
    [ "$(cat out.obj)" = mine ] || fail "--no-clobber let the file be changed"
    rm out.obj
    refuses 74 box -o /dev/full
    printf '1,0\n1,2\n' >same.obj
    expect 64 meshgen revolve same.obj -o same.obj
    rm same.obj
    pipe_breaks meshgen sphere --segments 1024 -o -
}

test_makes_and_pipes() {
    expect 0 meshgen box --from=0,0,0 --to 1,2,3 -o out.obj --stats stats.json
    [ ! -s stdout ] && [ ! -s stderr ] || fail "it talked"
    holds stats.json '.counters.triangles == 12 and .counters.volume == 6'
    head -1 out.obj | grep -q '^# meshgen box --from=0,0,0' || fail "no history in the file"
    # Facets have the normals of their own planes, turned with them.
    expect 0 meshgen box -o out.obj
    grep -q '^vn' out.obj && fail "a box has normals"
    expect 0 meshgen prism --place 0,0,0:0,0,90 -o out.obj
    grep -q '^vn -1 ' out.obj || grep -q '^vn 1 ' out.obj || fail "normals were not turned: $(grep '^vn' out.obj)"
    expect 0 meshgen sphere --segments 8 --explain --place 1,2,3:0,0,90:2
    prints '^from: -1,0,1'
    prints '^to: 3,4,5'
    expect 0 bash -c 'printf "1,0\n1,2\n" | meshgen revolve - -o - | meshgen flecks - -o - --count 3 |
        mesh2vol - -o out.vdb --ior 1.5 --resolution 16 --quiet'
    expect 0 bash -c 'meshgen implicit metaballs --seed 3 --threads 1 -o out1.obj &&
        meshgen implicit metaballs --seed 3 --threads 2 -o out2.obj &&
        cmp <(tail -n +2 out1.obj) <(tail -n +2 out2.obj)'
    printf '[prism]\nsides=5\nside=2\n' >five.ini
    expect 0 meshgen prism --config five.ini --explain
    prints '^points: 10'
    rm out*
    printf '[prism]\nsids=5\n' >five.ini
    refuses 64 prism --config five.ini -o out.obj
    rm five.ini stats.json
}

test_mesh2vol_takes_all() {
    printf '0,0\n1,0\n0.6,1\n1,2\n0,2\n' >vase.csv
    meshgen box -o within.obj
    local kind
    for kind in "revolve vase.csv" "implicit torus" "implicit gyroid --resolution 64" "implicit genus2" \
        "implicit splash --time 0.7" brilliant prism box "sphere --segments 32" "logo Ag8" \
        "wave --bottom=-0.3 --squares 32" "flecks within.obj --count 8"; do
        expect 0 bash -c "meshgen $kind -o - | mesh2vol - -o out.vdb --ior 1.5 --resolution 24"
        grep -v 'has a wall of' stderr >talk && fail "$kind: mesh2vol talked: $(cat talk)"
    done
    rm -f out* vase.csv within.obj talk
}

run_tests
