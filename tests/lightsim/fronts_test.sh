#!/bin/bash
# The manners of lightsim --method wavefront: what it refuses, and the meshes that it leaves.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=lightsim
. "$(dirname "$0")/../support/manners.sh"
sun='--light directional:0,-1,0'

test_fronts_need_the_method() {
    refuses 64 in.vdb $sun -o out.vdb --dump-fronts fronts
    says '--dump-fronts: .*expected --method wavefront'
    refuses 64 in.vdb $sun -o out.vdb --method wave
    says 'auto, photons, beams or wavefront'
    touch file
    refuses 73 in.vdb $sun -o out.vdb --method wavefront --dump-fronts file/fronts
    rm file
}

test_explains_the_method() {
    expect 0 lightsim in.vdb $sun -o out.vdb --method wavefront --explain
    prints '^wavefront: on (fluence is made of it)'
    prints '^photons: off (--method wavefront)'
}

test_fronts_are_meshes() {
    expect 0 lightsim in.vdb $sun -o out.vdb --method wavefront --dump-fronts fronts --quiet
    head -1 fronts/front_0001.ply | grep -q '^ply$' || fail 'no mesh front_0001.ply'
    grep -aq '^property float irradiance$' fronts/front_0001.ply || fail 'no irradiance'
    mkdir again
    expect 0 lightsim in.vdb $sun -o out2.vdb --method wavefront --dump-fronts again --quiet
    diff -r fronts again >/dev/null || fail 'a second run gave other fronts'
    rm -rf fronts again out.vdb out2.vdb
}

test_hundreds_of_fronts() {
    make_volume long.vdb size=16 voxel=0.1 ior constant:1 scattering constant:0.1,0.2,0.3
    expect 0 lightsim long.vdb $sun -o out.vdb --method wavefront --step 0.1 --dump-fronts fronts --quiet
    [ "$(ls fronts | wc -l)" -gt 100 ] || fail "only $(ls fronts | wc -l) fronts"
    rm -rf fronts out.vdb long.vdb
}

make_volume in.vdb size=16 voxel=0.1 ior sphere:0.5:1.5:1:all scattering constant:0.1,0.2,0.3 || exit 2
run_tests
