#!/bin/bash
# The manners of render: what it answers, with which status, and what it leaves behind.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=render
. "$(dirname "$0")/../support/manners.sh"
aim='--eye 0,0,5 --target 0,0,0'
view="$aim --fov 30 --size 16x12"

test_help() {
    expect 0 render --help
    prints 'IN.vdb'
    help_is_cut
    expect 0 render --version
    prints '^render [0-9]'
}

test_bad_usage() {
    refuses 64
    refuses 64 in.vdb
    refuses 64 in.vdb -o out.exr
    refuses 64 in.vdb $view
    refuses 64 $view -o out.exr
    refuses 64 in.vdb $view -o out.exr --nonsense
    local value
    for value in '' 16 16x 16x0 0x16 -4x4 16x12x3 1.5x2 axb 1e9x1 16,12 nanx4; do
        refuses 64 in.vdb $aim --fov 30 --size "$value" -o out.exr
        says '--size'
    done
    for value in 0 180 -30 nan inf x; do
        refuses 64 in.vdb $aim --size 4x4 --fov="$value" -o out.exr
        says '--fov'
    done
    for value in 0 -1 nan inf x; do
        refuses 64 in.vdb $aim --size 4x4 --ortho="$value" -o out.exr
        says '--ortho'
    done
    refuses 64 in.vdb $aim --size 4x4 -o out.exr
    says '--fov or --ortho'
    refuses 64 in.vdb $aim --size 4x4 --fov 30 --ortho 2 -o out.exr
    refuses 64 in.vdb --eye 1,2,3 --target 1,2,3 --fov 30 --size 4x4 -o out.exr
    says '--target'
    refuses 64 in.vdb --eye 0,5,0 --target 0,0,0 --fov 30 --size 4x4 -o out.exr
    says '--up'
    refuses 64 in.vdb $view --up 0,0,0 -o out.exr
    refuses 64 in.vdb $view --up 0,0,-2 -o out.exr
    for value in '' 1 1,2 1,2,3,4 a,b,c nan,0,0; do
        refuses 64 in.vdb --eye="$value" --target 0,0,0 --fov 30 --size 4x4 -o out.exr
        says '--eye'
    done
    for value in step=0 step=-1 step=nan step=1e9 max-steps=-1 integrator=magic \
        interpolation=nearest tolerance=0 tolerance=-1 tolerance=nan tolerance=x aov=depth aov=Z, \
        aov=Z,Z,depth background=-1 background=1,2 background=nan env-up=x env-rotate=nan \
        tone=loud exposure=x seed=-1 threads=-1 device=nothing progress=loud; do
        refuses 64 in.vdb $view -o out.exr "--$value"
        says "${value%%=*}"
    done
    refuses 64 in.vdb $view -o out.exr --env env.exr --background 1
    refuses 64 in.vdb $view -o out.exr --aov Z,Z
    refuses 64 in.vdb $view -o out.exr --tolerance 1 --integrator rk4
    says '--tolerance'
    refuses 64 in.vdb $view -o out.exr --exposure nan
    refuses 64 in.vdb $view -o out.tif
    says '.tga'
    refuses 71 in.vdb $aim --fov 30 --size 100000x100000 -o out.exr
    printf 'stepp=2\n' >typo.ini
    refuses 64 in.vdb $view -o out.exr --config typo.ini
    says 'stepp'
    refuses 65 in.vdb $view -o out.exr --grid-ior typo
    says "no grid 'typo'"
    # A volume is no picture, whatever reads it.
    refuses 65 in.vdb $view -o out.exr --env in.vdb
    refuses 64 in.vdb $view -o out.exr -o out.exr
    refuses 64 - - $view -o out.exr
}

test_what_is_missing_is_told_at_once() {
    refuses 64
    says 'not given: --output, IN.vdb|MESH, --eye, --target, --size, --fov or --ortho'
    refuses 64 in.vdb --eye 0,0,5 --fov 30 -o out.exr
    says 'not given: --target, --size '
    refuses 64 in.vdb $aim --fov 30 --sise 16x12 -o out.exr
    says '--sise (did you mean --size?)'
    refuses 64 in.vdb $view -o out.exr --env-rot=30 --interpolaton cubic
    says '--env-rot (did you mean --env-rotate?), --interpolaton (did you mean --interpolation?)'
    refuses 64 in.vdb $view -o out.exr --frobnicate
    says 'no such option: --frobnicate'
    grep -q 'did you mean' stderr && fail "it suggests what is not alike"
    printf 'ey=0,0,5\n' >typo.ini
    refuses 64 in.vdb $view -o out.exr --config typo.ini
    says "typo.ini: no option 'ey' (did you mean eye?)"
}

test_config() {
    expect 0 render in.vdb $view --background 0.1,0.2,0.3 -o first.exr
    local line
    for line in 'eye=0,0,5' 'eye = 0, 0, 5  # from afar' 'eye="0,0,5"' 'eye=[0,0,5]' "eye='0,0,5'"; do
        printf '# a view\n%s\ntarget=0,0,0\nfov=30\nsize=16x12\nbackground=0.1,0.2,0.3\n' "$line" >view.ini
        expect 0 render in.vdb --config view.ini -o out.exr
        idiff -q first.exr out.exr >/dev/null || fail "'$line' is another view"
    done
    # As editors of another system write it.
    sed -i '1s/^/\xef\xbb\xbf/; s/$/\r/' view.ini
    expect 0 render in.vdb --config view.ini -o out.exr
    idiff -q first.exr out.exr >/dev/null || fail "with a byte order mark it is another view"
    rm -f first.exr out.exr
}

test_output_is_input() {
    cp in.vdb out.vdb
    expect 64 render out.vdb $view -o out.vdb
    cmp -s in.vdb out.vdb || fail "the input was changed"
    expect 64 render in.vdb out.vdb $view -o other.exr --stats out.vdb
    cmp -s in.vdb out.vdb || fail "the input was changed by --stats"
    cp env.exr out.exr
    expect 64 render in.vdb $view --env out.exr -o out.exr
    cmp -s env.exr out.exr || fail "the environment was changed"
    rm -f out.vdb out.exr
    refuses 64 in.vdb $view -o out.exr -o ./out.exr
    refuses 64 in.vdb $view -o - --stats -
    [ ! -e other.exr ] || fail "other.exr was written"
}

test_missing_input() {
    refuses 66 absent.vdb $view -o out.exr
    says absent.vdb
    refuses 66 in.vdb absent.vdb $view -o out.exr
    refuses 66 in.vdb $view --env absent.exr -o out.exr
    says absent.exr
    refuses 66 in.vdb $view -o out.exr --config absent.toml
}

test_bad_input() {
    head -c 5000 /dev/zero | tr '\0' x >garbage.vdb
    : >empty.vdb
    local file size part
    for file in garbage.vdb empty.vdb; do
        refuses 65 $file $view -o out.exr
        says $file
        refuses 65 in.vdb $view --env $file -o out.exr
        says $file
    done
    size=$(stat -c %s in.vdb)
    for part in 300 $((size / 2)) $((size - 1)); do
        head -c "$part" in.vdb >cut.vdb
        refuses 65 cut.vdb $view -o out.exr
        says cut.vdb
    done
    # Wider than any device's texture.
    oiiotool --create 40000x2 3 -d half -o wide.exr
    refuses 71 in.vdb $view --env wide.exr -o out.exr
    says 'environment map needs'
    head -c 500 env.exr >cut.exr
    refuses 65 in.vdb $view --env cut.exr -o out.exr
    says cut.exr
    make_volume moved.vdb size=16 voxel=0.1 centre=0.05,0,0 fluence constant:1 || fail make_volume
    refuses 65 in.vdb moved.vdb $view -o out.exr
    says 'moved.vdb: its domain overlaps that of in.vdb'
}

test_values_out_of_range() {
    local grid value alias
    while read -r grid value alias; do
        make_volume bad.vdb size=4 scattering constant:1:all fluence constant:1:all \
            opacity box:0.6:1:0:all "$alias" "$value:all" || fail "make_volume"
        refuses 65 bad.vdb $view -o out.exr --grid-"$grid" "${alias%=*}"
        says "grid '${alias%=*}'"
    done <<'END'
emission delta:1,2,3:-1 v_x
albedo delta:1,2,3:-1 v_x
albedo delta:1,2,3:2 v_x
ior constant:0 x=1
anisotropy constant:1 x
END
}

test_outputs_that_fail() {
    refuses 73 in.vdb $view -o absent/out.exr
    says absent/out.exr
    echo mine >out.exr
    expect 73 render in.vdb $view -o out.exr --no-clobber
    [ "$(cat out.exr)" = mine ] || fail "--no-clobber let the file be changed"
    rm out.exr
    refuses 74 in.vdb $view -o /dev/full
    expect 74 bash -c "render in.vdb $view -o - >/dev/full"
    refuses 74 in.vdb $view -o out.exr --stats /dev/full
    pipe_breaks render in.vdb $aim --fov 30 --size 300x300 -o -
    # Of two outputs one that fails keeps the other from being written.
    refuses 73 in.vdb $view -o out.exr -o absent/out.png
}

test_devices() {
    refuses 69 in.vdb $view -o out.exr --device 99
    refuses 69 in.vdb $view -o out.exr --device software --require-gpu
}

test_explains() {
    expect 0 render in.vdb $view --explain
    prints '^refraction: on'
    prints '^tracing: verlet, linear'
    prints '^absorption: on'
    prints '^scattering: off'
    prints '^environment: off'
    expect 0 render in.vdb $view --explain --background 1 -o out.exr
    prints '^environment: on'
    nothing_left
}

test_stats() {
    expect 0 render in.vdb $view -o out.exr --stats stats.json
    [ ! -s stdout ] || fail "it wrote to standard output"
    holds stats.json '.tool == "render" and (.version | test("^[0-9]")) and
        (.command | test("--fov 30"))'
    holds stats.json '.device | (.vendor and .renderer and .version) and
        (.software | type == "boolean")'
    holds stats.json '.effects | .refraction.on == true and (.refraction.why | length > 0)'
    holds stats.json '[.passes[].name] | index("view") != null and index("read") != null'
    holds stats.json '.counters | .rays > 0 and .rays <= 192 and .steps > .rays and .trapped == 0'
    holds stats.json '.memory | .gpu_peak_bytes > 0 and .rss_peak_bytes > 0'
    holds stats.json '.wall_ms > 0'
    rm out.exr
}

test_boundaries() {
    make_volume ball.vdb size=24 voxel=0.1 ior=1 constant:1.5:all sdf ball:0.9:all ||
        fail make_volume
    local look='--eye 0,0,5 --target 0,0,0 --fov 25 --size 24x24 --background 1'
    # Lossless glass in even light is invisible but for what is dropped: at most one branch in ten.
    expect 0 render ball.vdb $look -o out.exr --stats stats.json
    holds stats.json '.effects.sharp_boundaries | .on and (.why | test("sdf"))'
    holds stats.json '.counters | .boundaries_met > 0 and .light_dropped_by_depth < 0.01 and
        .light_dropped_as_dim < 0.01'
    expect 0 render ball.vdb $look -o same.exr --boundary sharp
    idiff -q out.exr same.exr >/dev/null || fail "auto is not sharp where there are distances"
    expect 0 render ball.vdb $look -o blurred.exr --boundary blurred --stats stats.json
    holds stats.json '.effects.sharp_boundaries | .on == false and (.why | test("blurred"))'
    expect 0 render ball.vdb $look -o shallow.exr --max-depth 1 --stats stats.json
    # Depth 1 shows the mirror's share alone: 4 % at the centre, and nearly all else is dropped.
    holds stats.json '.counters.light_dropped_by_depth > 0.3'
    says 'warning: [0-9.]* % of the light was dropped by --max-depth'
    expect 0 render ball.vdb $look -o shallow.exr
    [ ! -s stderr ] || fail "it warns of light that it does not drop"
    expect 0 render ball.vdb $look -o smooth.exr --samples 4
    idiff -q out.exr smooth.exr >/dev/null && fail "--samples changes nothing"
    mv smooth.exr first.exr
    expect 0 render ball.vdb $look -o smooth.exr --samples 4
    cmp -s smooth.exr first.exr || fail "--samples is not the same every time"
    rm out.exr same.exr blurred.exr shallow.exr smooth.exr first.exr
    refuses 65 in.vdb $view -o out.exr --boundary sharp
    says "no grid 'sdf'"
    for bad in soft 1; do
        refuses 64 ball.vdb $look -o out.exr --boundary $bad
        says boundary
    done
    for bad in -1 65 x 1.5; do
        refuses 64 ball.vdb $look -o out.exr --max-depth $bad
        says max-depth
    done
    for bad in -1 1 x; do
        refuses 64 ball.vdb $look -o out.exr --cutoff $bad
        says cutoff
    done
    for bad in 0 -1 5000 x; do
        refuses 64 ball.vdb $look -o out.exr --samples $bad
        says samples
    done
}

test_tolerance() {
    make_volume rod.vdb size=24,24,48 ior rod:1.5:0.05:all || fail make_volume
    local look='--eye 0,0,60 --target 0,0,0 --ortho 12 --size 8x8'
    expect 0 render rod.vdb $look -o out.exr --tolerance 0.01 --stats stats.json
    grep -q tolerance stderr && fail "it warns of a tolerance that it keeps"
    holds stats.json '.counters | .position_error_voxels > 0 and .position_error_voxels <= 0.01 and
        .over_tolerance == 0'
    expect 0 render rod.vdb $look -o out.exr --tolerance 1e-8 --stats stats.json
    says 'warning: --tolerance 1e-08 is out of reach'
    holds stats.json '.counters | .position_error_voxels > 1e-8 and .position_error_voxels < 1e-3 and
        .over_tolerance == .rays'
    holds stats.json '.warnings | map(test("out of reach")) | any'
    expect 0 render rod.vdb $look -o out.exr --max-steps 7 --stats stats.json
    says 'warning: 64 rays used up --max-steps'
    holds stats.json '.counters.trapped == 64'
    rm out.exr
    # A run that fails says why, and nothing else.
    refuses 74 rod.vdb $look -o /dev/full --max-steps 7
}

test_header_and_channels() {
    expect 0 render in.vdb $view -o out.exr --aov all
    oiiotool --info -v out.exr >info || fail "oiiotool does not read it"
    local text
    for text in '16 x *12, 2[0-9] channel, float openexr' 'eikonal:tool: "render"' \
        '^render in.vdb .*--aov all' worldtocamera: worldtoNDC: 'chromaticities: 0.64, 0.33' \
        'exit_position.X' 'exit_direction.Z' 'deflection.X' 'deflection.Y' 'transmittance.G' ' optical_path_length.V' \
        'position.Y' 'normal.Z' ' path_length.V' ' steps.V' ' Z[ ,(]' ' error.V' 'AR, AG, AB\|AB'; do
        grep -qi -e "$text" info || fail "'$text' is not in the header: $(cat info)"
    done
    grep -qi 'datetime\|capdate' info && fail "the header holds a date"
    expect 0 render in.vdb $view -o out.exr
    oiiotool --info -v out.exr >info
    grep -q 'exit_position' info && fail "a picture not asked for was written"
    rm out.exr
}

test_light_of_points() {
    make_volume floor.vdb size=16 voxel=0.1 ior constant:1 opacity sphere:0.5:1:0 albedo constant:0.5
    expect 0 render floor.vdb $view -o points.exr --aov position,normal
    says 'warning: .*run lightsim first'
    expect 0 lightsim floor.vdb --light directional:0,0,-1 --at points.exr -o light.exr
    expect 0 render floor.vdb $view -o out.exr --light light.exr
    [ ! -s stderr ] || fail "it warns, though it has light"
    # The middle looks along the light at a ball of albedo 1/2, of five voxels: about 1/2π = 0.159.
    oiiotool out.exr --cut 1x1+8+6 --printstats | grep -q 'Stats Avg: 0.1[3-9]' ||
        fail "out.exr: $(oiiotool out.exr --cut 1x1+8+6 --printstats)"
    rm out.exr
    refuses 65 floor.vdb $aim --fov 30 --size 12x16 -o out.exr --light light.exr
    says '16x12 pixels, expected --size 12x16'
    refuses 65 floor.vdb $view -o out.exr --light points.exr
    says "no channel 'irradiance.R'"
    oiiotool light.exr --mulc 1e30 --mulc 1e30 -o dark.exr
    refuses 65 floor.vdb $view -o out.exr --light dark.exr
    says "channel 'irradiance.R' holds inf.*expected a finite number"
    refuses 65 floor.vdb $view -o out.exr --light floor.vdb
    refuses 66 floor.vdb $view -o out.exr --light nothing.exr
    rm -f points.exr light.exr dark.exr floor.vdb
}

test_plate() {
    oiiotool --pattern constant:color=0.25,0.5,1 16x12 3 -d float -o plate.exr
    refuses 64 in.vdb $view -o out.exr --plate plate.exr
    says '--plate-distance'
    refuses 64 in.vdb $view -o out.exr --plate-distance 9
    says 'no --plate'
    refuses 64 in.vdb $view -o out.exr --plate plate.exr --plate plate.exr --plate-distance 9
    says 'one picture'
    local value
    for value in distance=0 distance=-1 distance=nan height=0 height=-1 height=inf; do
        refuses 64 in.vdb $view -o out.exr --plate plate.exr --plate-distance 9 --plate-$value
        says "--plate-${value%%=*}"
    done
    refuses 66 in.vdb $view -o out.exr --plate nothing.exr --plate-distance 9
    refuses 65 in.vdb $view -o out.exr --plate in.vdb --plate-distance 9
    expect 64 render in.vdb $view -o plate.exr --plate plate.exr --plate-distance 9
    says 'is an input'
    expect 0 render in.vdb $view -o out.exr --plate plate.exr --plate-distance 9 --explain
    prints 'plate: on (--plate)'
    expect 0 render in.vdb $view -o out.exr --plate plate.exr --plate-distance 90
    oiiotool out.exr --cut 1x1+0+0 --printstats | grep -q 'Stats Avg: 0.25[0-9]* 0.5[0-9]* 1.0' ||
        fail "the plate is not seen: $(oiiotool out.exr --cut 1x1+0+0 --printstats)"
    rm -f plate.exr out.exr
}

test_several_outputs() {
    expect 0 render in.vdb $view --background 0.5 -o out.exr -o out.png
    oiiotool --info out.png | grep -q '16 x *12, 3 channel, uint8 png' ||
        fail "out.png: $(oiiotool --info out.png)"
    oiiotool --info out.exr | grep -q float || fail "out.exr: $(oiiotool --info out.exr)"
    # Its corner sees the background past the ball: 0.5 is 188 in sRGB.
    oiiotool --dumpdata out.png | grep -q 'Pixel (0, 0): 188 188 188' ||
        fail "out.png: $(oiiotool --dumpdata out.png | head -3)"
    expect 0 render in.vdb $view --background 0.5 -o out.png --exposure 1
    oiiotool --dumpdata out.png | grep -q 'Pixel (0, 0): 255 255 255' || fail "--exposure does nothing"
    rm -f out.exr out.png
}

test_progress() {
    expect 0 render in.vdb $view -o out.exr --progress alf
    says '^ALF_PROGRESS 100%$'
    expect 0 render in.vdb $view -o out.exr --progress openjd
    says '^openjd_progress: 100$'
    expect 0 render in.vdb $view -o out.exr --progress json
    jq -es 'all(.tool == "render") and (.[-1].progress == 1)' stderr >/dev/null ||
        fail "progress is no JSON, or does not end at 1"
    expect 0 render in.vdb $view -o out.exr --progress text
    says '^render: 100% [0-9:]* taken$'
    # Longer runs tell every second how long it will take. How long is long depends on the machine.
    local samples seconds=$SECONDS
    for samples in 2 8 32 128; do
        seconds=$SECONDS
        expect 0 render in.vdb $aim --fov 10 --size 200x150 --step 0.03 --samples $samples -o out.exr --progress text
        grep -qE '^render: [0-9]+% [0-9:]+ left$' stderr && break
    done
    says '^render: [0-9]*% [0-9:]* left$'
    [ "$(wc -l <stderr)" -le $((SECONDS - seconds + 5)) ] || fail "it talks more than once a second"
    expect 0 render in.vdb $view -o out.exr --quiet
    [ ! -s stderr ] || fail "--quiet talks"
    [ ! -s stdout ] || fail "it wrote to standard output"
    rm out.exr
}

test_pipes_and_repeats() {
    local threads
    for threads in 1 2; do
        expect 0 bash -c "LP_NUM_THREADS=$threads render - $view --aov all -o - <in.vdb >out$threads"
    done
    cmp -s out1 out2 || fail "two pictures through a pipe differ"
    rm -f out*
    for threads in 1 2 2; do
        echo "threads=$threads" >options.toml
        expect 0 render in.vdb $view --aov all -o out.exr --env env.exr --config options.toml
        [ ! -e first.exr ] || cmp -s first.exr out.exr || fail "$threads threads give other bytes"
        mv out.exr first.exr
    done
    rm -f first.exr
}

test_signal_leaves_nothing() {
    local signal
    for signal in TERM INT; do
        dies_by $signal render in.vdb $aim --fov 10 --size 8000x8000 --step 0.01 -o out.exr --quiet
    done
}

make_volume in.vdb size=16 voxel=0.1 ior sphere:0.5:1.5:1:all absorption sphere:0.5:1,2,3:0 ||
    exit 2
oiiotool --pattern constant:color=0.5,0.4,0.3 32x16 3 -d float -o env.exr || exit 2
run_tests
