#!/bin/bash
# The manners of lightsim: what it answers, with which status, and what it leaves behind.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=lightsim
. "$(dirname "$0")/../support/manners.sh"
sun='--light directional:0,-1,0'
few='--photons 1000'

test_help() {
    expect 0 lightsim --help
    prints 'IN.vdb'
    expect 0 lightsim --version
    prints '^lightsim [0-9]'
}

test_bad_usage() {
    refuses 64
    refuses 64 in.vdb
    refuses 64 in.vdb -o out.vdb
    says '--light'
    refuses 64 in.vdb $sun
    refuses 64 in.vdb extra.vdb $sun -o out.vdb
    refuses 64 in.vdb $sun -o out.vdb --nonsense
    local spec
    for spec in '' sun directional directional: directional:1,2 directional:1,2,3,4 directional:0,0,0 \
        directional:a,b,c directional:1,2,nan directional:1,2,inf directional:1,2,3: \
        directional:1,2,3:1,2 directional:1,2,3:-1,0,0 directional:1,2,3:1,2,3:-4 point point:1,2 \
        point:1,2,x point:1,2,3:1,2,3,4 point:nan,0,0 'directional:1e300,1e300,1e300' \
        'directional: 1,2,3' spot:1,2,3 rect:1,2,3:1,0,0 sphere:1,2,3:0 environment: 'a b=point:1,2,3'; do
        refuses 64 in.vdb -o out.vdb --light "$spec"
    done
    local option
    for option in photons=0 photons=-5 photons=x photons=1e30 octree-tolerance=-1 \
        octree-tolerance=nan shadow-cull=0 shadow-cull=1.1 shadow-cull=nan octree-tolerance2=0.001 step-limit=0 step-limit=-1 step-limit=nan step-min=0 step-min=nan \
        step-min=1e9 max-steps=0 max-steps=100000 drop-below=1 drop-below=-1 drop-below=nan \
        step=0 step=nan integrator=magic interpolation=nearest tolerance=0 tolerance=nan \
        thin-to=1 thin-to=-0.1 thin-to=nan smoothing=-1 smoothing=65 smoothing=x method=magic bounces=-1 bounces=65 bounces=x \
        outputs=nothing outputs=fluence, outputs= seed=-1 threads=-1 device=nothing \
        progress=loud; do
        refuses 64 in.vdb $sun -o out.vdb "--$option"
        says "${option%%=*}"
    done
}

test_old_names() {
    # What an option was called once still works, is not in --help, and says what it is called now.
    expect 0 lightsim --help
    grep -q -e '--trace-tolerance\|--tolerance2' stdout && fail "--help has an old name"
    prints '--octree-tolerance2'
    expect 0 lightsim in.vdb $sun $few -o out.vdb --trace-tolerance 0.5 --stats stats.json
    says '^lightsim: warning: --trace-tolerance is called --tolerance now$'
    holds stats.json '.warnings | map(test("trace-tolerance")) | any'
    holds stats.json '.counters.position_error_voxels > 0'
    expect 0 lightsim in.vdb $sun $few -o new.vdb --tolerance 0.5 --stats new.json
    grep -q 'is called' stderr && fail "--tolerance warns of its name"
    [ "$(jq .counters.steps stats.json)" = "$(jq .counters.steps new.json)" ] ||
        fail "--trace-tolerance is not --tolerance"
    expect 0 lightsim in.vdb $sun $few -o out.vdb --tolerance2 0.5 --stats stats.json
    says '^lightsim: warning: --tolerance2 is called --octree-tolerance2 now, and'
    expect 0 lightsim in.vdb $sun $few -o new.vdb --octree-tolerance2 0.5 --stats new.json
    [ "$(jq .counters.steps stats.json)" = "$(jq .counters.steps new.json)" ] ||
        fail "--tolerance2 is not --octree-tolerance2"
    expect 0 lightsim in.vdb $sun $few -o out.vdb --tolerance2 0.5 --quiet
    [ ! -s stderr ] || fail "--quiet warns"
    echo 'tolerance2=0.5' >old.ini
    expect 0 lightsim in.vdb $sun $few -o out.vdb --config old.ini
    says 'octree-tolerance2'
    rm -f out.vdb new.vdb
    refuses 64 in.vdb $sun -o out.vdb --tolerance2 0.5 --octree-tolerance2 0.5
    says 'given, too'
    refuses 64 in.vdb $sun -o out.vdb --trace-tolerance 0
    says '--tolerance: found 0'
    refuses 64 in.vdb $sun -o out.vdb --trace-tolerance 1 --integrator rk4
}

test_warnings_come_last() {
    # On its own the error: a script reads the first line.
    refuses 74 in.vdb $sun $few -o /dev/full --tolerance2 0.5
    refuses 73 glass.vdb $sun -o absent/out.vdb --tolerance2 0.5
    # A note, too.
    refuses 74 glass.vdb $sun -o /dev/full
    expect 0 lightsim in.vdb $sun $few -o out.vdb --tolerance2 0.5 --progress json
    tail -1 stderr | grep -q 'warning: --tolerance2' || fail "the warning is not last"
    rm -f out.vdb
}

test_output_is_input() {
    cp in.vdb out.vdb
    expect 64 lightsim out.vdb $sun $few -o out.vdb
    cmp -s in.vdb out.vdb || fail "the input was changed"
    ln -s out.vdb link.vdb
    expect 64 lightsim out.vdb $sun $few -o link.vdb
    cmp -s in.vdb out.vdb || fail "the input was changed through a link"
    expect 64 lightsim out.vdb $sun $few -o other.vdb --stats out.vdb
    [ ! -e other.vdb ] || fail "other.vdb was written"
    expect 64 lightsim out.vdb $sun $few -o other.vdb --dump-octree out.vdb
    cmp -s in.vdb out.vdb || fail "the input was changed by --dump-octree"
    expect 64 lightsim in.vdb $sun $few -o other.vdb --dump-octree other.vdb
    [ ! -e other.vdb ] || fail "other.vdb was written"
    rm -f out.vdb link.vdb other.vdb
}

test_missing_input() {
    refuses 66 absent.vdb $sun -o out.vdb
    says absent.vdb
    refuses 66 in.vdb $sun -o out.vdb --config absent.toml
    refuses 66 in.vdb $sun -o out.vdb --proxy absent.obj
}

test_bad_input() {
    head -c 5000 /dev/zero | tr '\0' x >garbage.vdb
    : >empty.vdb
    mkdir -p folder.vdb
    local file size part
    for file in garbage.vdb empty.vdb folder.vdb; do
        refuses 65 $file $sun -o out.vdb
        says $file
    done
    refuses 65 in.vdb $sun -o out.vdb --proxy garbage.vdb
    size=$(stat -c %s in.vdb)
    for part in 10 300 $((size / 2)) $((size - 1)); do
        head -c "$part" in.vdb >cut.vdb
        refuses 65 cut.vdb $sun -o out.vdb
        says cut.vdb
    done
    expect 65 bash -c "lightsim - $sun -o out.vdb <cut.vdb"
    nothing_left
}

test_values_out_of_range() {
    # Under another name the maker and the reader do not check; one voxel of each is bad.
    local grid value alias
    while read -r grid value alias; do
        make_volume bad.vdb size=4 scattering constant:1:all "$alias" "$value:all" ||
            fail "make_volume"
        refuses 65 bad.vdb $sun $few -o out.vdb --grid-"$grid" "${alias%=*}"
        says "grid '${alias%=*}'"
        case $value in delta*) says '1, *2, *3' ;; *) says '0, *0, *0' ;; esac
    done <<'END'
scattering delta:1,2,3:-1 v_x
absorption delta:1,2,3:-1 v_x
opacity delta:1,2,3:2 x
opacity delta:1,2,3:-1 x
ior constant:0 x=1
ior constant:-1.5 x=1
anisotropy constant:1 x
anisotropy constant:-1 x
END
    # A NaN among the bytes of an otherwise good grid: 7.5, stored once, becomes one.
    make_volume bad.vdb size=4 scattering delta:1,2,3:7.5,1,1 || fail "make_volume"
    # 7.5 is the bytes 00 00 F0 40, a NaN 00 00 C0 7F.
    LC_ALL=C sed 's/\x00\x00\xF0\x40/\x00\x00\xC0\x7F/g' bad.vdb >nan.vdb
    cmp -s bad.vdb nan.vdb && fail "the test found no value to spoil"
    refuses 65 nan.vdb $sun $few -o out.vdb
    says "'scattering'"
    says '1, *2, *3'
}

test_outputs_that_fail() {
    refuses 73 in.vdb $sun $few -o absent/out.vdb
    says absent/out.vdb
    echo mine >out.vdb
    expect 73 lightsim in.vdb $sun $few -o out.vdb --no-clobber
    [ "$(cat out.vdb)" = mine ] || fail "--no-clobber let the file be changed"
    rm out.vdb
    refuses 74 in.vdb $sun $few -o /dev/full
    expect 74 bash -c "lightsim in.vdb $sun $few -o - >/dev/full"
    refuses 74 in.vdb $sun $few -o out.vdb --stats /dev/full
    pipe_breaks lightsim in.vdb $sun $few -o -
}

test_devices() {
    refuses 69 in.vdb $sun $few -o out.vdb --device 99
    refuses 69 in.vdb $sun $few -o out.vdb --device software --require-gpu
    expect 0 lightsim --device list
    prints '^0 '
}

test_explains() {
    expect 0 lightsim in.vdb $sun --explain
    prints '^voxels: 16 x 16 x 16'
    prints '^scattering: on'
    prints '^refraction: on'
    prints '^light_direction: off (no grid .anisotropy., or 0 everywhere)'
    prints '^irradiance: off (no grid .opacity., or 0 everywhere)'
    expect 0 lightsim in.vdb $sun --explain -o out.vdb
    nothing_left
    expect 0 lightsim glass.vdb $sun --explain
    prints '^fluence: off'
}

test_stats() {
    expect 0 lightsim in.vdb $sun --photons 5000 -o out.vdb --stats stats.json --seed 3
    [ ! -s stdout ] || fail "it wrote to standard output"
    holds stats.json '.tool == "lightsim" and (.version | test("^[0-9]")) and
        (.command | test("--seed 3"))'
    holds stats.json '.device | (.vendor and .renderer and .version) and
        (.software | type == "boolean")'
    holds stats.json '.effects | .scattering.on == true and (.scattering.why | length > 0) and
        .light_direction.on == false and .opaque.on == false'
    holds stats.json '[.passes[].name] | index("photons") != null and index("octree") != null'
    holds stats.json 'all(.passes[]; .gpu_ms >= 0 and .cpu_ms >= 0)'
    holds stats.json '.counters | .photons > 4000 and .steps >= .photons and
        .deposits >= .steps and .atomic_adds == 3 * .deposits and .trapped == 0'
    holds stats.json '.energy | [.emitted, .entered, .absorbed, .scattered, .escaped, .lost] |
        all(length == 3)'
    holds stats.json '.energy as $e | all(range(3); $e.entered[.] -
        ($e.absorbed[.] + $e.scattered[.] + $e.escaped[.] + $e.lost[.]) |
        fabs < 1e-4 * $e.entered[0])'
    holds stats.json '.memory | .gpu_peak_bytes > 0 and .rss_peak_bytes > 0'
    holds stats.json '.wall_ms > 0'
    rm -f out.vdb
}

test_copies_what_needs_nothing() {
    expect 0 lightsim glass.vdb $sun -o out.vdb --stats stats.json
    says 'nothing to simulate'
    holds stats.json '.device == null'
    [ "$(vdb_print out.vdb | grep -c fluence)" -eq 0 ] || fail "a fluence grid was written"
    expect 0 lightsim glass.vdb $sun -o out.vdb --quiet
    [ ! -s stderr ] || fail "--quiet talks"
    rm out.vdb
}

test_writes_what_is_asked() {
    expect 0 lightsim in.vdb $sun $few -o out.vdb
    [ "$(vdb_print out.vdb | grep -c light_direction)" -eq 0 ] || fail "light_direction written"
    [ "$(vdb_print out.vdb | grep -c fluence)" -gt 0 ] || fail "no fluence was written"
    vdb_print -l out.vdb >text
    grep -q 'eikonal:command.*lightsim' text || grep -q 'lightsim' text || fail "no history"
    expect 0 lightsim glass.vdb $sun $few -o out.vdb --outputs light_direction
    [ "$(vdb_print out.vdb | grep -c fluence)" -eq 0 ] || fail "fluence was written"
    [ "$(vdb_print out.vdb | grep -c light_direction)" -gt 0 ] || fail "no light_direction"
    expect 0 lightsim in.vdb $sun $few -o out.vdb --dump-octree outree.vdb
    [ "$(vdb_print outree.vdb | grep -c octree_level)" -gt 0 ] || fail "no octree was written"
    rm -f out.vdb outree.vdb
}

test_progress() {
    expect 0 lightsim in.vdb $sun $few -o out.vdb --progress alf
    says '^ALF_PROGRESS 100%$'
    expect 0 lightsim in.vdb $sun $few -o out.vdb --progress openjd
    says '^openjd_progress: 100$'
    expect 0 lightsim in.vdb $sun $few -o out.vdb --progress json
    says '"progress":1.00'
    jq -es 'all(.tool == "lightsim") and (map(.progress) | . == sort)' stderr >/dev/null ||
        fail "progress is no JSON, or goes back"
    expect 0 lightsim in.vdb $sun $few -o out.vdb --progress none
    [ ! -s stderr ] || fail "--progress none talks"
    expect 0 lightsim in.vdb $sun $few -o out.vdb --quiet
    [ ! -s stderr ] || fail "--quiet talks"
    [ ! -s stdout ] || fail "it wrote to standard output"
    rm out.vdb
}

test_lights() {
    make_volume floor.vdb size=16 voxel=0.1 ior constant:1 opacity sphere:0.5:1:0 albedo constant:0.5
    # A sky that is brighter above, as a 4 x 2 map, in a format that is not EXR.
    printf 'P3 4 2 255 200 200 255 200 200 255 200 200 255 200 200 255 9 9 9 9 9 9 9 9 9 9 9 9\n' >sky.ppm
    local two="--light key=spot:0,2,0:0,-1,0:30:5:9 --light sky=environment:sky.ppm --light-samples 4"
    expect 0 lightsim floor.vdb $two $few -o lit.vdb --lights-apart --stats stats.json
    holds stats.json '.energy.entered[0] > 0'
    local file
    for file in lit.vdb lit.key.vdb lit.sky.vdb; do
        vdb_print $file | grep -q irradiance || fail "no irradiance in $file"
    done
    expect 0 lightsim floor.vdb --light spot:0,2,0:0,-1,0:30:5:9 $few -o alone.vdb
    cmp -s <(vdb_print -l alone.vdb | grep -v ^lightsim) <(vdb_print -l lit.key.vdb | grep -v ^lightsim) ||
        fail "a light apart differs from it alone"
    expect 0 lightsim floor.vdb $two $few -o turned.vdb --env-up z --env-rotate 90
    # Of a scene that light does nothing to there are as many files.
    expect 0 lightsim glass.vdb $two $few -o dark.vdb --lights-apart --quiet
    [ -s dark.key.vdb ] && [ -s dark.sky.vdb ] || fail "files of lights apart are missing"
    refuses 64 floor.vdb $two -o - --lights-apart
    says '--lights-apart'
    refuses 64 floor.vdb --light a=point:1,2,3 --light a=point:3,2,1 -o out2.vdb
    says 'two are named a'
    refuses 64 floor.vdb --light 2=point:1,2,3 --light point:3,2,1 -o out2.vdb
    refuses 64 lit.key.vdb $two -o lit.vdb --lights-apart
    says 'is an input'
    refuses 64 floor.vdb $two -o out2.vdb --light-samples 0
    refuses 64 floor.vdb $two -o out2.vdb --light-samples 1e9
    refuses 66 floor.vdb --light environment:nothing.exr -o out2.vdb
    refuses 65 floor.vdb --light environment:floor.vdb -o out2.vdb
    refuses 64 floor.vdb --light environment:sky.ppm -o sky.ppm
    rm -f lit*.vdb alone.vdb turned.vdb dark*.vdb sky.ppm floor.vdb stats.json
}

test_bounces() {
    make_volume hollow.vdb size=16 voxel=0.1 ior constant:1 opacity sphere:0.5:0:1 albedo constant:0.5
    local lamp="--light point:0,0,0 --photons 10000"
    expect 0 lightsim hollow.vdb $lamp -o lit.vdb --bounces 2 --stats stats.json
    holds stats.json '.effects.bounces.on and .counters.light_left_after_bounces > 0.1'
    holds stats.json '.passes | map(.name) | index("bounced photons") != null'
    holds stats.json '.energy | (.absorbed[0] + .scattered[0] + .escaped[0] + .lost[0]) / .entered[0] |
        . > 0.999 and . < 1.001'
    expect 0 lightsim hollow.vdb $lamp -o unlit.vdb --stats stats.json
    holds stats.json '.effects.bounces.on == false and .counters.light_left_after_bounces == null'
    # What does nothing says why.
    expect 0 lightsim hollow.vdb $lamp -o unlit.vdb --explain
    prints '^bounces: off (--bounces 0)'
    expect 0 lightsim in.vdb $lamp -o unlit.vdb --bounces 2 --explain
    prints '^bounces: off (no surface receives light)'
    make_volume black.vdb size=16 voxel=0.1 ior constant:1 opacity sphere:0.5:0:1
    expect 0 lightsim black.vdb $lamp -o unlit.vdb --bounces 2 --explain
    prints '^bounces: off (no opaque surface has an albedo)'
    rm -f hollow.vdb black.vdb lit.vdb unlit.vdb stats.json
}

test_points() {
    local picture="--eye 0,0,5 --target 0,0,0 --fov 30 --size 16x12"
    make_volume floor.vdb size=16 voxel=0.1 ior constant:1 opacity sphere:0.5:1:0 albedo constant:0.5
    render floor.vdb $picture -o points.exr --aov position,normal --quiet
    expect 0 lightsim floor.vdb $sun --light back=directional:0,0,-1 --at points.exr -o light.exr --lights-apart
    oiiotool --info -v light.exr >info || fail "oiiotool does not read it"
    local layer
    for layer in irradiance.R irradiance_direction.X irradiance_1.G irradiance_back.B \
        irradiance_direction_back.Z position.X normal.Z 'eikonal:tool: "lightsim"'; do
        grep -q "$layer" info || fail "no $layer: $(cat info)"
    done
    expect 0 lightsim floor.vdb $sun --at points.exr -o again.exr
    expect 0 lightsim floor.vdb $sun --at points.exr -o again2.exr
    idiff -q -fail 0 again.exr again2.exr >info || fail "two runs differ"
    refuses 64 floor.vdb $sun --at points.exr -o out.vdb
    says '.exr with --at'
    refuses 64 floor.vdb $sun --at points.exr -o out.exr --outputs irradiance
    says '--outputs'
    refuses 64 floor.vdb $sun --at points.exr -o points.exr
    refuses 66 floor.vdb $sun --at nothing.exr -o out.exr
    refuses 65 floor.vdb $sun --at floor.vdb -o out.exr
    oiiotool points.exr --ch R,G,B,position.X,position.Y,position.Z -o half.exr
    refuses 65 floor.vdb $sun --at half.exr -o out.exr
    says "no channel 'normal.X'"
    oiiotool points.exr --mulc 1e30 --mulc 1e30 -o far.exr
    refuses 65 floor.vdb $sun --at far.exr -o out.exr
    says "channel 'position.* is not a finite number in pixel"
    # Points of nothing get no light, and the run says so.
    oiiotool points.exr --mulc 0 -o none.exr
    expect 0 lightsim floor.vdb $sun --at none.exr -o out.exr
    says 'no point of none.exr'
    # A script finds the layers of lights apart however many there are, lit or not.
    expect 0 lightsim floor.vdb $sun --at none.exr -o apart.exr --lights-apart --quiet
    oiiotool --info -v apart.exr | grep -q irradiance_1.R || fail "no layer of a light apart"
    oiiotool points.exr --mulc 1e20 -o away.exr
    expect 0 lightsim floor.vdb $sun --at away.exr -o apart.exr
    says 'no point of away.exr'
    oiiotool out.exr --ch irradiance.R --printstats | grep -q 'Stats Max: 0.0' || fail "it has light"
    rm -f *.exr info floor.vdb
}

test_pipes_and_repeats() {
    local threads
    for threads in 1 2; do
        # Threads by the environment, since the history in the file holds the command.
        expect 0 bash -c "lightsim - $sun -o - --photons 20000 <in.vdb |
            LP_NUM_THREADS=$threads lightsim - $sun -o - --photons 20000 \
            --outputs fluence,light_direction >out$threads"
    done
    cmp -s out1 out2 || fail "two runs through a pipe differ"
    rm -f out*
    # A number of threads by an option's file of its own, for the same reason.
    for threads in 1 2 2; do
        echo "threads=$threads" >options.toml
        expect 0 lightsim in.vdb $sun --light point:0.3,4,0.1 --photons 20000 -o out.vdb \
            --config options.toml
        [ ! -e first.vdb ] || cmp -s first.vdb out.vdb || fail "$threads threads give other bytes"
        mv out.vdb first.vdb
    done
    rm -f first.vdb
}

test_signal_leaves_nothing() {
    local signal
    for signal in TERM INT; do
        dies_by $signal lightsim in.vdb $sun --photons 400000000 -o out.vdb --quiet
    done
}

make_volume in.vdb size=16 voxel=0.1 ior sphere:0.5:1.5:1:all scattering constant:0.1,0.2,0.3 \
    absorption sphere:0.4:1,2,3:0 || exit 2
make_volume glass.vdb size=16 voxel=0.1 ior sphere:0.5:1.5:1:all || exit 2
run_tests
