#!/bin/bash
# Hard cases at the command line: what scripts read of trapped rays, of energy, of refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=render
. "$(dirname "$0")/../support/manners.sh"
few='--photons 2000'
books='.energy as $e | all(range(3); ($e.entered[.] - ($e.absorbed[.] + $e.scattered[.] +
    $e.escaped[.] + $e.lost[.])) | fabs <= 1e-4 * $e.entered[0])'

# An index of 0 or less, wherever it stands.
test_no_index_at_or_below_nothing() {
    local value
    for value in 0 -1.5; do
        make_volume bad.vdb size=4 x=1 constant:$value:all scattering constant:1:all || fail make_volume
        tool=render
        refuses 65 bad.vdb --eye 0,0,9 --target 0,0,0 --fov 30 --size 4x4 -o out.exr --grid-ior x
        says "grid 'x': voxel (0, 0, 0) is $value, expected > 0"
        tool=lightsim
        refuses 65 bad.vdb --light directional:0,-1,0 $few -o out.vdb --grid-ior x
        says "grid 'x': voxel (0, 0, 0)"
        tool=mesh2vol
        refuses 64 box.obj --ior=$value -o out.vdb
    done
    tool=render
}

# |g| = 1 is a beam, not a lobe.
test_no_lobe_without_width() {
    local value
    for value in 1 -1 1.5; do
        make_volume bad.vdb size=4 x delta:1,2,3:$value scattering constant:1:all \
            fluence constant:1:all light_direction constant:0,0,1:all || fail make_volume
        refuses 65 bad.vdb --eye 0,0,9 --target 0,0,0 --fov 30 --size 4x4 -o out.exr \
            --grid-anisotropy x
        says "voxel (1, 2, 3) is $value, expected between -1 and 1"
    done
}

# A voxel that no VDB can hold; those at both ends of what it can are fine.
test_voxels_of_any_size_or_a_clear_word() {
    local size
    tool=make_volume
    refuses 65 out.vdb size=4 voxel=1e-6 ior constant:1.5:all
    says 'expected a scene in a smaller unit'
    tool=mesh2vol
    refuses 64 box.obj --ior 1.5 --voxel-size 1e-6 -o out.vdb
    says '--voxel-size'
    tool=render
    for size in 2e-5 1e6; do
        make_volume in.vdb size=4 voxel=$size ior sphere:1e9:1.5:1:all \
            absorption constant:0:all || fail make_volume
        expect 0 render in.vdb --eye 0,0,"$size" --target 0,0,0 --ortho "$size" --size 2x2 \
            --background 0.5 -o out.exr
        oiiotool --stats out.exr >text
        grep -q 'Stats NanCount: 0 0 0 0' text || fail "$(cat text)"
        rm -f out.exr
    done
}

# Rays along the wall of a diamond ball, inside: total reflection keeps them, each is counted.
test_trapped_rays_are_counted() {
    local integrator
    for integrator in verlet euler; do
        expect 0 render ring.vdb --eye 1,0,0 --target 1,0,-1 --fov 20 --size 4x4 -o out.exr \
            --aov steps --stats stats.json --max-steps 300 --step 0.25 --integrator $integrator
        holds stats.json '.counters.rays == 16 and .counters.trapped == 16 and
            .counters.steps == 16 * 300'
        oiiotool --stats out.exr >text
        grep -q 'Stats NanCount: 0 0 0 0 0' text || fail "$(cat text)"
    done
    # Without a limit given there is one all the same.
    expect 0 timeout 60 render ring.vdb --eye 1,0,0 --target 1,0,-1 --fov 20 --size 4x4 \
        -o out.exr --stats stats.json
    holds stats.json '.counters.trapped == 16'
    rm -f out.exr
}

# A lamp in it: what never gets out is booked as lost, and the books close.
test_trapped_photons_are_counted_and_booked() {
    tool=lightsim
    expect 0 timeout 60 lightsim ring.vdb --light point:1,0,0:1,2,3 $few --max-steps 400 \
        --outputs fluence -o out.vdb --stats stats.json
    holds stats.json '.counters.trapped > 0.5 * .counters.photons'
    holds stats.json '.energy.lost[0] > 0.5 * .energy.entered[0]'
    holds stats.json "$books"
    rm -f out.vdb
    tool=render
}

# Diamond in air and air in diamond, with something that takes a little everywhere.
test_books_close_at_high_contrast() {
    local inside outside
    tool=lightsim
    while read -r inside outside; do
        make_volume in.vdb size=24 voxel=0.1 ior=$outside sphere:0.8:$inside:$outside:all \
            absorption constant:0.1,0.2,0.3:all scattering constant:0.05:all || fail make_volume
        expect 0 volsmooth in.vdb -o in.vdb.smooth --sigma 1.5
        expect 0 lightsim in.vdb.smooth --light directional:1,-2,0.5:3,2,1 $few -o out.vdb \
            --stats stats.json
        holds stats.json "$books"
        holds stats.json '.energy | .absorbed[0] > 0 and .scattered[0] > 0 and .escaped[0] > 0'
        rm -f out.vdb
    done <<'END'
2.42 1
1 2.42
1.5 1.33
0.999 1
END
    tool=render
}

# More light than a float holds is no silent picture.
test_overflow_is_a_fault() {
    tool=lightsim
    refuses 70 fog.vdb --light directional:0,-1,0:1e39 $few -o out.vdb
    says fluence
    tool=render
    refuses 70 fog.vdb --eye 0,0,9 --target 0,0,0 --ortho 1 --size 2x2 --grid-emission v_x -o out.exr
    says "channel 'R'"
}

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >box.obj
make_volume sharp.vdb size=32 voxel=0.1 ior sphere:1.2:2.42:1:all || exit 2
volsmooth sharp.vdb -o ring.vdb --sigma 1.5 --quiet || exit 2
make_volume fog.vdb size=8 scattering constant:1:all v_x constant:3e38:all || exit 2
run_tests
