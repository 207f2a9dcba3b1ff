#!/bin/bash
# The manners of volpaint: what it answers, and with which status.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=volpaint
. "$(dirname "$0")/../support/manners.sh"

test_help() {
    expect 0 volpaint --help
    local word
    for word in IN.vdb --noise --sphere --stamp --object reflectance; do prints "$word"; done
    expect 0 volpaint --version
    grep -q '^volpaint [0-9]' stdout || fail "--version names no version"
    help_is_cut
}

test_bad_usage() {
    refuses 64
    refuses 64 fog.vdb
    refuses 64 fog.vdb -o out.vdb
    says 'nothing to paint'
    refuses 64 fog.vdb -o out.vdb --noise absorption:1
    says "--noise: found 'absorption:1', expected GRID:AMOUNT"
    refuses 64 fog.vdb -o out.vdb --noise density:1:1
    says 'expected GRID one of ior'
    refuses 64 fog.vdb -o out.vdb --sphere absorption:0,0:1:1
    refuses 64 fog.vdb -o out.vdb --stamp fog.vdb
    says "--stamp: found 'fog.vdb', expected FILE:TX"
    refuses 64 - -o out.vdb --stamp -:0,0,0
}

test_bad_input() {
    refuses 66 absent.vdb -o out.vdb --noise scattering:1:1
    refuses 66 fog.vdb -o out.vdb --stamp absent.vdb:0,0,0
    refuses 65 fog.vdb -o out.vdb --object glass --noise scattering:1:1
    says "no object 'glass'"
    refuses 65 fog.vdb -o out.vdb --sphere ior:0,0,0:9:-5
    echo text >bad.vdb
    refuses 65 bad.vdb -o out.vdb --noise scattering:1:1
    rm bad.vdb
}

test_outputs_that_fail() {
    refuses 73 fog.vdb -o absent/out.vdb --noise scattering:1:1
    refuses 74 fog.vdb -o /dev/full --noise scattering:1:1
    cp fog.vdb out.vdb
    expect 64 volpaint out.vdb -o out.vdb --noise scattering:1:1
    expect 64 volpaint fog.vdb -o out.vdb --stamp out.vdb:0,0,0
    cmp -s fog.vdb out.vdb || fail "an input was changed"
    rm out.vdb
}

test_makes_and_pipes() {
    expect 0 volpaint fog.vdb -o out.vdb --noise scattering:0.5:0.4 --stats stats.json
    [ ! -s stdout ] && [ ! -s stderr ] || fail "it talked"
    holds stats.json '.counters.grids == 1'
    expect 0 volpaint fog.vdb --explain --noise scattering:0.5:0.4
    prints '^strokes: 1'
    # A shell loop is a brush's way.
    expect 0 bash -c 'cp fog.vdb out.vdb; for x in 0 0.2 0.4; do
        volpaint out.vdb -o out2.vdb --sphere absorption:$x,0,0:0.3:1 && mv out2.vdb out.vdb; done'
    if command -v vdb_print >/dev/null; then
        vdb_print -l out.vdb >stdout
        prints 'volpaint out.vdb -o out2.vdb --sphere absorption:0.4,0,0:0.3:1'
    fi
    expect 0 bash -c 'for t in 1 2; do volpaint - -o - --threads $t --noise scattering:0.5:0.4 \
        --stamp fog.vdb:0.1,0,0:0,30,0:0.5 <fog.vdb >out$t; done'
    cmp -s <(tail -c +4096 out1) <(tail -c +4096 out2) || fail "the threads change the values"
    rm -f out* stats.json
}

make_volume fog.vdb size=16 voxel=0.1 ior constant:1 scattering sphere:0.5:1:0 || exit 2
run_tests
