#!/bin/bash
# mesh2vol's manners: the right status for every way to go wrong, and no file left by any of them.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=mesh2vol
. "$(dirname "$0")/../support/manners.sh"
small="--ior 1.5 --resolution 21 --padding 3"

# makes FILE ARGUMENTS...: the tool writes the file.
makes() {
    local file=$1
    shift
    rm -f "$file"
    expect 0 mesh2vol "$@" -o "$file"
    [ -s "$file" ] || fail "'$*' made no $file"
}

is_silent() { [ -s stderr ] && fail "is not silent"; }

# rejects OPTION VALUE...: each value is wrong usage, and the message names the option.
rejects() {
    local option=$1 value
    shift
    for value in "$@"; do
        refuses 64 box.obj --ior 1.5 -o out.vdb "$option=$value"
        says "$option"
    done
}

# has_grids FILE NAME...: in alphabetical order, where there is something that lists them.
has_grids() {
    command -v vdb_print >/dev/null || return
    local file=$1 found
    shift
    found=$(vdb_print -l "$file" | sed -n 's/^Name: //p' | sort | tr '\n' ' ')
    [ "$found" = "$* " ] || fail "$file has '$found', expected '$*'"
}

# lines_of FILE COUNT PATTERN: so many lines of its listing match.
lines_of() {
    command -v vdb_print >/dev/null || return
    [ "$(vdb_print -l "$1" | grep -cE "$3")" = "$2" ] || fail "$1: not $2 lines of $3"
}

test_help() {
    expect 0 mesh2vol --help
    expect 0 mesh2vol --version
}

test_bad_usage() {
    refuses 64
    refuses 64 box.obj --ior 1.5
    says "--output"
    refuses 64 box.obj -o out.vdb
    says "not given: --ior or --material"
    refuses 64 box.obj $small -o out.vdb -o out2.vdb
    refuses 64 box.obj $small -o out.vdb --colour red
    refuses 64 box.obj --ior 1.5 -o out.vdb --resolution 9 --voxel-size 1
    refuses 64 box.obj --ior 1.5 -o out.vdb --resolution 16 --padding 8
    says "--resolution: found 16, expected more than twice the --padding of 8"
    refuses 64 box.obj --ior 1.5 -o out.vdb --padding 1 --bounds 0,0,0,1,1,1
    refuses 64 box.obj box.obj --ior 1 --ior 2 --ior 3 -o out.vdb
    says "--ior: given 3 times, expected once or once for each"
    refuses 64 box.obj --ior 1 --ior 2 -o out.vdb
    refuses 64 box.obj box.obj $small -o out.vdb
    says "--name: found 'box' for two objects"
    refuses 64 box.obj $small --sdf -o out.vdb # it is written without being asked for
}

test_numbers_for_meshes() {
    local numbers
    for numbers in "--ior 1.5 1.33" "--ior 1.5 1.33 1 1" "--ior 1.5 --absorption 1 1,2,3"; do
        refuses 64 box.obj box.obj -o out.vdb $numbers
        says "is a number, not a mesh: .* again for each"
    done
    refuses 64 box.obj box.obj -o out.vdb --material bk7 water
    says "water: is a material, not a mesh: "
    cp box.obj 1.33 # unless there is one
    makes number.vdb 1.33 box.obj $small
    rm 1.33
}

test_bad_values() {
    refuses 64 box.obj -o out.vdb --ior 0
    says "--ior: found 0, expected above 0"
    local value
    for value in -1 nan inf 1e-300 1e300 glass ""; do
        refuses 64 box.obj -o out.vdb "--ior=$value"
        says "--ior"
    done
    rejects --dispersion nan blue 1e300
    rejects --abbe -1 0.99 1000.1 nan blue ""
    rejects --material "" glass bk "fused silica" 1.5
    rejects --medium-material "" glass
    rejects --medium-abbe -1 0.5 2000 nan x
    rejects --unit 0 -1 1e-10 1e10 nan x
    rejects --absorption -1 1,2 1,2,-3 1,2,nan 1,2,3,4 red
    rejects --scattering -0.5 1,,2
    rejects --anisotropy 1 -1 1.5 0.99999999999 nan
    rejects --emission -1 inf
    rejects --opacity -0.1 1.1 nan
    rejects --albedo 2 -1 1,1,1.5
    rejects --reflectance -1
    rejects --priority 1.5 high
    rejects --name "" medium a,b "a[1]" $'a\tb'
    rejects --boundary "" Sharp sdf 1
    rejects --medium-ior 0 -1 nan x
    rejects --medium-absorption -1 1,2
    rejects --medium-scattering -1
    rejects --medium-anisotropy 1
    rejects --medium-emission -1
    rejects --medium-dispersion nan
    rejects --resolution 0 -5 2047 1.5 x
    rejects --voxel-size 0 -1 nan inf 1e-9 x
    rejects --padding -1 1e9 2000 x
    rejects --supersample 0 3 16 x
    rejects --bounds 0,0,0,1,1 0,0,0,1,1,0 1,0,0,0,1,1 a,b,c,d,e,f nan,0,0,1,1,1
    rejects --sdf-band 0 -1 3.9 1000 nan
    rejects --smooth -1 90 nan x
}

test_bad_input() {
    refuses 66 none.obj $small -o out.vdb
    says none.obj
    refuses 66 box.obj $small -o out.vdb --config none.toml
    refuses 65 garbage.off $small -o out.vdb
    says garbage.off
    refuses 65 "$script" $small -o out.vdb # of no kind that is known
    refuses 65 open.obj $small -o out.vdb
    says "open.obj: bounds no volume: open: 4 edges with a single face, around 1 hole"
    says "--repair closes it"
    refuses 65 inverted.obj $small -o out.vdb
    says "inside out"
    refuses 65 pulled.obj $small --repair -o out.vdb # every face closed by its own back
    says "pulled.obj: .*expected"
    refuses 65 sheet.obj $small --repair -o out.vdb
    refuses 65 box.obj open.obj $small -o out.vdb
}

test_open_sheets() {
    printf 'v -1 0.1 -1\nv 1 0 -1\nv 1 0.1 1\nv -1 0 1\nf 1 4 3\nf 1 3 2\n' >water.obj
    local pool="--ior 1.3 --resolution 20 --bounds=-1,-0.5,-1,1,0.5,1"
    refuses 65 water.obj --ior 1.3 -o out.vdb
    says "around 1 hole .*with --bounds, .*--fill-below"
    refuses 65 water.obj --ior 1.3 --resolution 20 --bounds=-1,-1,-1,1.2,1,1 -o out.vdb
    says "its rim lies within the domain, at (1, .*--fill-below"
    refuses 64 water.obj --ior 1.3 --fill-below yes -o out.vdb
    says "--fill-below: given without --bounds"
    refuses 64 water.obj $pool --fill-below maybe -o out.vdb
    says "--fill-below: found 'maybe', expected yes or no"
    refuses 64 water.obj $pool --fill-below yes --fill-below no -o out.vdb
    makes behind.vdb water.obj $pool --stats stats.json
    says "water.obj: open sheet, closed outside the domain from 4 edges .*: filled behind its faces"
    grep -q '"sheets_closed": *1' stats.json || fail "--stats counts no sheet"
    makes below.vdb water.obj $pool --fill-below yes
    expect 0 mesh2vol water.obj box.obj $pool --fill-below yes --fill-below no --explain -o out.vdb
    grep -q '^sheet water.obj: open sheet, .*: filled below it' stdout || fail "--explain tells of no sheet"
    makes both.vdb water.obj box.obj $pool --fill-below yes
    says "box.obj: is closed: --fill-below does nothing"
}

test_ground() {
    rejects --ground x 0: 0:2 0:1,1 0:0.5:checker 0:0.5:checker=1 "0:0.5:checker 0" \
        "0:0.5:checker 1:1" nan 1e13
    rejects --ground-margin -1 nan x
    refuses 64 box.obj $small -o out.vdb --ground-margin 1
    says "--ground-margin: given without --ground"
    refuses 64 box.obj $small -o out.vdb --ground 0 --boundary blurred
    says "--ground: given with --boundary blurred"
    refuses 64 box.obj $small -o out.vdb --ground 1e3
    says "--ground: found Y 1000, expected below the objects' top"
    refuses 64 box.obj --ior 1.5 --resolution 24 --padding 2 -o out.vdb --ground=-0.5
    says "--ground: .* voxels above the low face of a domain .*--padding"
    refuses 64 box.obj --ior 1.5 --bounds=-1,-1,-1,2,2,2 -o out.vdb --ground 0 --ground-margin 1
    says "--ground-margin: given with --bounds"
    refuses 64 box.obj $small -o out.vdb --ground=-0.5 --name ground
    says "--name: found 'ground' for two objects"
    makes ground.vdb box.obj --ior 1.5 --resolution 24 --ground=-0.5 --ground-margin 0.5
    has_grids ground.vdb albedo albedo.ground ior ior.box ior.ground opacity opacity.ground \
        sdf.box sdf.ground
    # Down to the ground and to the sides as told, whatever is on it; and by default.
    lines_of ground.vdb 1 'eikonal:ground: -0.5 0.5,0.5,0.5 0$'
}

test_no_memory_no_device() {
    # Less than a process may have.
    expect 71 bash -c 'ulimit -v 6000000; exec "$0" "$@"' mesh2vol box.obj --ior 1.5 \
        --resolution 2046 --padding 0 --cube --absorption 1 --scattering 1 -o out.vdb
    says "the grids need .*bytes"
    refuses 69 box.obj $small --device 99 -o out.vdb
}

test_bad_output() {
    refuses 73 box.obj $small -o none/out.vdb
    refuses 64 box.obj $small -o box.obj
    refuses 74 box.obj $small -o /dev/full
    touch there.vdb
    refuses 73 box.obj $small --no-clobber -o there.vdb
    [ -s there.vdb ] && fail "--no-clobber wrote"
    rm there.vdb
}

test_explain_makes_no_file() {
    local before
    before=$(ls -A)
    expect 0 mesh2vol box.obj --ior 1.5 --explain
    [ "$(ls -A)" = "$before" ] || fail "--explain left a file"
}

test_a_box() {
    makes box.vdb box.obj $small
    is_silent
    has_grids box.vdb ior ior.box sdf # only what differs from a vacuum is written
    lines_of box.vdb 4 'class: level set|eikonal:object: box$|eikonal:(order|priority): 0$'
    lines_of box.vdb 5 'Number of active voxels: +(3,696|0)$|Background value: 1(\.5)?$'
    mesh2vol box.obj $small -o - >piped.vdb
    has_grids piped.vdb ior ior.box sdf
    makes blurred.vdb box.obj $small --boundary blurred
    has_grids blurred.vdb ior
    makes grids.vdb box.obj $small --absorption 1,0,0 --opacity 1 --albedo 0.5 --anisotropy 0.5 \
        --medium-scattering 0.1
    has_grids grids.vdb absorption absorption.box albedo albedo.box anisotropy.box ior ior.box \
        opacity opacity.box scattering scattering.medium sdf
    local voxels
    for voxels in 1 2 4 7 16; do makes few.vdb box.obj --ior 1.5 --resolution $voxels; done
}

test_repair() {
    makes open.vdb open.obj $small --repair
    says "filled 1 hole"
    makes inverted.vdb inverted.obj $small --repair
}

test_repair_of_soup() {
    makes near.vdb near.obj $small --repair
    says "merged 14 points within"
    says "repaired: 12 triangles, 8 points, 1 component, volume 6.0000"
}

# An inner shell that looks outward makes no cavity.
test_a_cavity_that_is_none() {
    { cat box.obj && awk '/^v/ {print "v", $2 / 2 + 0.25, $3 / 2 + 0.5, $4 / 2 + 0.75}
        /^f/ {print "f", $2 + 8, $3 + 8, $4 + 8, $5 + 8}' box.obj; } >solid.obj
    makes solid.vdb solid.obj $small
    says "warning: solid.obj: 1 closed part looks outward within another and is solid like it, volume 6:"
    awk '/^f/ && ++n > 6 {print "f", $5, $4, $3, $2; next} {print}' solid.obj >hollow.obj
    makes hollow.vdb hollow.obj $small
    grep -q "looks outward" stderr && fail "a cavity is told of"
}

# counted NAME: a counter of stats.json.
counted() { tr -d ' \n' <stats.json | grep -o "\"$1\":[0-9]*" | cut -d: -f2; }

# smoothed COMPARISON OPTIONS...: how many triangles of a cylinder of 24 sides there are in the end.
smoothed() {
    local comparison=$1
    shift
    makes smooth.vdb cylinder.obj --ior 1.5 --resolution 64 --stats stats.json "$@"
    [ "$(counted triangles_read)" -eq 92 ] || fail "not 92 triangles were read"
    [ "$(counted triangles)" "$comparison" 92 ] || fail "$* made $(counted triangles) triangles"
}

test_smooth() {
    awk 'BEGIN { for (i = 0; i < 48; ++i)
            print "v", cos(i % 24 * 3.14159265 / 12), int(i / 24), sin(i % 24 * 3.14159265 / 12)
        printf "f"; for (i = 1; i <= 24; ++i) printf " %d", i; print ""
        printf "f"; for (i = 48; i > 24; --i) printf " %d", i; print ""
        for (i = 0; i < 24; ++i) { j = (i + 1) % 24; print "f", i + 1, i + 25, j + 25, j + 1 } }' \
        >cylinder.obj
    smoothed -gt
    smoothed -gt --smooth 16
    smoothed -eq --smooth 14 # its sides meet at 15 degrees
    smoothed -eq --smooth 0
    makes flat.vdb box.obj $small --stats stats.json
    [ "$(counted triangles)" -eq 12 ] || fail "a box has $(counted triangles) triangles"
}

test_stats() {
    makes stats.vdb box.obj $small --stats stats.json
    local word
    for word in '"occupied_voxels"' '"voxelize"' '"why"' '"triangles": 12'; do
        grep -q -e "$word" stats.json || fail "no $word in the statistics"
    done
}

# Told by what they hold, and called alike from run to run.
test_streams() {
    makes file.vdb box.obj $small --name mesh
    expect 0 mesh2vol - -o stream.vdb $small <box.obj
    has_grids stream.vdb ior ior.mesh sdf
    cat box.obj | expect 0 mesh2vol - -o stream.vdb $small
    expect 0 mesh2vol <(gzip -c box.obj | gunzip) -o stream.vdb $small
    has_grids stream.vdb ior ior.mesh sdf
    mkfifo fifo
    cat box.obj >fifo &
    expect 0 mesh2vol fifo <(cat far.obj) -o stream.vdb $small
    has_grids stream.vdb ior ior.mesh1 ior.mesh2 sdf.mesh1 sdf.mesh2
    expect 64 mesh2vol - - -o out.vdb $small <box.obj
    expect 65 mesh2vol - -o out.vdb $small <garbage.off
    says "standard input: found no extension and no content that tells"
    expect 65 mesh2vol - -o out.vdb $small </dev/null
    says "standard input: found an empty file"
    expect 65 mesh2vol <(gzip -c box.obj) -o out.vdb $small
    says "compressed by gzip"
    nothing_left
}

# values FILE GRID...: their backgrounds, which is all that grids of one object have.
values() {
    local file=$1 grid
    shift
    for grid in "$@"; do
        vdb_print -l "$file" | sed -n "/^Name: $grid\$/,/Background/s/.*Background value: //p"
    done | tr '\n' ' '
}

# has_values FILE "VALUES" GRID...
has_values() {
    command -v vdb_print >/dev/null || return
    local found
    found=$(values "$1" "${@:3}")
    [ "$found" = "$2 " ] || fail "$1 has '$found' for ${*:3}, expected '$2'"
}

test_materials() {
    local size="--resolution 21 --padding 3"
    makes glass.vdb box.obj $size --material N-BK7
    has_grids glass.vdb dispersion dispersion.box ior ior.box sdf # absorption wants a unit
    has_values glass.vdb "1.5168 0.0042175" ior.box dispersion.box
    makes glass.vdb box.obj $size --material bk7 --unit 0.01
    has_values glass.vdb "[0.0023, 0.0018, 0.003]" absorption.box
    # Numbers win, each alone.
    makes glass.vdb box.obj $size --material bk7 --unit 1 --ior 1.4
    has_values glass.vdb "1.4 0.0042175 [0.23, 0.18, 0.3]" ior.box dispersion.box absorption.box
    makes glass.vdb box.obj $size --material bk7 --unit 1 --dispersion 0.25 --absorption 2
    has_values glass.vdb "1.5168 0.25 [2, 2, 2]" ior.box dispersion.box absorption.box
    makes glass.vdb box.obj $size --material bk7 --abbe 0
    has_grids glass.vdb ior ior.box sdf
    makes glass.vdb box.obj $size --material BK7 --medium-material Fused_Silica
    has_values glass.vdb "1.45846 0.0035399" ior dispersion.medium
    makes glass.vdb box.obj $size --material bk7 --unit 10 --medium-material water --medium-ior 1.5 \
        --medium-dispersion 0.5
    has_values glass.vdb "1.5 0.5 [3, 0.47, 0]" ior dispersion.medium absorption.medium
    refuses 64 box.obj -o out.vdb --material bk8
    says "--material: found 'bk8' (did you mean bk7?), expected one of acrylic, air, bk7, .*, or none"
}

test_some_have_a_material() {
    local size="--resolution 21 --padding 3"
    makes mixed.vdb box.obj far.obj $size --material bk7 --material none --ior none --ior 1.33 \
        --abbe none --abbe 50
    has_values mixed.vdb "1.5168 1.33 0.0042175" ior.box ior.far dispersion.box
    makes mixed.vdb two.obj $size --material none --material water --ior 1.5 --ior None
    has_values mixed.vdb "1.5 1.3334" ior.two.near_a_ ior.two.far
    refuses 64 box.obj far.obj -o out.vdb --material bk7 --material none
    says "--ior: none for object 2, expected one, or a --material"
    refuses 64 two.obj -o out.vdb --material bk7 --material none # known when it has been read
    says "--ior: none for object 2"
    refuses 64 box.obj far.obj -o out.vdb --ior 1.5 --abbe none --abbe 50 --dispersion 0.01
    says "--abbe: given with --dispersion for object 2, expected one of the two"
    makes mixed.vdb box.obj far.obj $size --ior 1.5 --abbe none --abbe 50 --dispersion 0.01 \
        --dispersion none
    refuses 64 box.obj -o out.vdb --ior 1.5 --medium-abbe 50 --medium-dispersion 0.01
    says "--medium-abbe"
}

test_crystals() {
    command -v vdb_print >/dev/null || return 0
    makes crystal.vdb box.obj --resolution 21 --padding 3 --material calcite --axis 0,0.6,0.8 \
        --absorption 1 --absorption-extraordinary 2,3,4
    vdb_print -m crystal.vdb >printed
    grep -q "eikonal:axis: \[0, 0.6, 0.8\]" printed || fail "no axis"
    grep -q "eikonal:ior_extraordinary: 1.48618" printed || fail "no n_e"
    grep -q "eikonal:dispersion_extraordinary: 0.003216" printed || fail "no dispersion of n_e"
    grep -q "eikonal:absorption_extraordinary: \[2, 3, 4\]" printed || fail "no absorption of e-rays"
    makes plain.vdb box.obj $small --ior-extraordinary 1.6 --axis 0,0,0
    vdb_print -m plain.vdb | grep -q "eikonal:axis" && fail "an axis of 0 is one"
    for bad in "--axis 0,0,2 --ior-extraordinary 1.6" "--axis 0,0,1" "--ior-extraordinary 1.6" \
        "--axis 0,0,1 --ior-extraordinary 0.9" "--axis 0,0,1 --ior-extraordinary 1.6 --boundary blurred" \
        "--axis 0,0,1 --ior-extraordinary 1.6 --absorption-extraordinary -1"; do
        refuses 64 box.obj -o out.vdb --ior 1.5 $bad
        says "--axis\|--ior-extraordinary\|--absorption-extraordinary"
    done
}

test_metal_and_roughness() {
    local size="--resolution 21 --padding 3"
    makes metal.vdb box.obj far.obj $size --metal Gold --metal none --ior none --ior 1.5 \
        --roughness 0.1 --roughness 0.25
    vdb_print -m metal.vdb >printed
    grep -q "eikonal:metal_index: \[0.222, 0.428, 1.335\]" printed || fail "no metal's n"
    grep -q "eikonal:metal_extinction: \[3.208, 2.461, 1.872\]" printed || fail "no metal's k"
    [ "$(grep -c 'eikonal:metal_index' printed)" = 1 ] || fail "glass is metal, too"
    grep -q "eikonal:roughness: 0.1" printed || fail "no roughness of the first"
    grep -q "eikonal:roughness: 0.25" printed || fail "no roughness of the second"
    has_values metal.vdb "1" opacity.box
    # It outlives the stages that follow.
    expect 0 volsmooth metal.vdb -o smooth.vdb
    vdb_print -m smooth.vdb | grep -q "eikonal:metal_index" || fail "volsmooth drops the metal"
    refuses 64 box.obj -o out.vdb --metal cheese
    says "--metal: found 'cheese', expected one of aluminium, .*, or none"
    refuses 64 box.obj -o out.vdb --metal silvr
    says "did you mean silver"
    for bad in -0.1 1.5 rough; do
        refuses 64 box.obj -o out.vdb --ior 1.5 --roughness $bad
        says "--roughness"
    done
    refuses 64 box.obj -o out.vdb --ior 1.5 --roughness 0.2 --boundary blurred
    says "--roughness: given with --boundary blurred"
    rm -f smooth.vdb
}

test_abbe_numbers() {
    # (1.5 - 1) / 50 / (1 / 0.48613^2 - 1 / 0.65627^2)
    makes abbe.vdb box.obj $small --abbe 50 --medium-ior 1.25 --medium-abbe 25
    has_values abbe.vdb "0.00523655 0.00523655" dispersion.box dispersion.medium
}

test_materials_are_told() {
    expect 0 mesh2vol box.obj far.obj --explain --material sf10 --material none --ior none --ior 1.3 \
        --medium-material water --unit 0.1
    prints "^material box: sf10, ior 1.72825, dispersion 0.0134233, absorption 0.033"
    prints "^material medium: water, ior 1.3334, dispersion 0.0031311, absorption 0.03"
    grep -q "^material far" stdout && fail "a number is called a material"
    makes unit.vdb box.obj --material diamond --resolution 36 --unit 0.1
    says "warning: --unit: nothing absorbs by its material's name"
    makes unit.vdb box.obj --material bk7 --resolution 36 --unit 0.1
    is_silent
    local name
    expect 0 mesh2vol --help
    for name in acrylic bk7 diamond f2 fused-silica ice polycarbonate sapphire sf10 water zircon; do
        prints "[ ,]$name\(,\|$\)"
    done
}

test_objects_of_a_file() {
    makes two.vdb two.obj $small
    has_grids two.vdb ior ior.two.far ior.two.near_a_ sdf.two.far sdf.two.near_a_
    lines_of two.vdb 2 'eikonal:order: [01]$'
    makes two.vdb two.obj $small --name pair --ior 1.3 --absorption 0 --absorption 1
    has_grids two.vdb absorption absorption.pair.far ior ior.pair.far ior.pair.near_a_ \
        sdf.pair.far sdf.pair.near_a_
    makes two.vdb two.obj box.obj --ior 1.5 --ior 1.3 --priority 0 --priority 1 --priority 2 \
        --name a --name b --name c --resolution 40
    has_grids two.vdb ior ior.a ior.b ior.c sdf.a sdf.b sdf.c
    refuses 64 two.obj -o out.vdb --ior 1 --ior 2 --ior 3
    says "given 3 times, expected once or once for each of the 2 objects in it"
    refuses 64 two.obj box.obj -o out.vdb --ior 1 --ior 2 --ior 3 --ior 4
    says "once for each of the 2 meshes or once for each of the 3 objects in them"
    sed '$d' two.obj >lid.obj
    refuses 65 lid.obj -o out.vdb $small
    says "lid.obj: 'far': bounds no volume: open"
}

# So many boxes beside one another.
boxes() {
    local k
    for k in $(seq 0 $(($1 - 1))); do
        echo "o box$k"
        awk -v k="$k" '/^v/ {print "v", $2 + 2 * k, $3, $4}
            /^f/ {for (i = 2; i <= 5; ++i) $i += 8 * k; print}' box.obj
    done
}

test_many_objects() {
    boxes 13 >many.obj
    makes many.vdb many.obj --ior 1.5 --voxel-size 0.2
    says "many.obj: 13 objects, all alike and more than 12, are taken as one"
    has_grids many.vdb ior ior.many sdf
    makes many.vdb many.obj --voxel-size 0.2 $(printf -- '--ior 1.%s ' $(seq 10 22))
    lines_of many.vdb 13 'class: level set'
    # As many as later stages take, and one more: in one file, or of a file each.
    local of
    boxes 64 >many.obj
    makes many.vdb many.obj --voxel-size 0.5 $(printf -- '--ior 1.%s ' $(seq 10 73))
    lines_of many.vdb 64 'class: level set'
    boxes 65 >many.obj
    of=$(printf -- '--ior 1.%s ' $(seq 10 74))
    refuses 64 many.obj -o out.vdb --voxel-size 0.5 $of
    says "MESH: found 65 objects, expected at most 64 with sharp boundaries (--boundary blurred"
    makes many.vdb many.obj --voxel-size 0.5 --boundary blurred $of
    refuses 64 $(printf 'box.obj %.0s' $(seq 65)) -o out.vdb --ior 1.5
    says "MESH: found 65 objects, expected at most 64"
}

test_names() {
    expect 0 mesh2vol -o several.vdb --ior 1.5 --ior 1.2 --resolution 20 --padding 3 \
        --name first --name second.part box.obj box.obj # outputs before meshes
    has_grids several.vdb ior ior.first ior.second.part sdf.first sdf.second.part
    makes several.vdb box.obj far.obj $small --name none --name second
    has_grids several.vdb ior ior.box ior.second sdf.box sdf.second
    makes same.vdb box.obj box.obj $small --boundary blurred # where objects have no names
    cp box.obj 'a,b[1].obj'
    makes named.vdb 'a,b[1].obj' $small
    has_grids named.vdb ior ior.a_b_1_ sdf
}

test_thin_walls() {
    sed 's/^v 1/v 0.01/' box.obj >thin.obj
    makes thin.vdb thin.obj $small --stats thin.json
    says "warning: 'thin' has a wall of 0.01 units, 0.05 voxels, at (0.005, "
    says "--resolution 1506 would"
    grep -q '"thinnest_wall_voxels": 0.0[45]' thin.json || fail "not in the statistics"
    refuses 74 thin.obj $small -o /dev/full
    makes thin.vdb thin.obj --ior 1.5 --voxel-size 0.1
    says "--voxel-size 0.002 would"
    makes thin.vdb box.obj --ior 1.5 --resolution 20 --padding 3
    says "'box' has a wall of 1 units, 4.67 voxels, .* may be 0.057° off; .* --resolution 21 would"
    makes thin.vdb box.obj --ior 1.5 --resolution 21 --padding 3
    is_silent
    makes thin.vdb thin.obj $small --boundary blurred
    grep -q wall stderr && fail "speaks of walls, blurred"
}

test_a_mesh_outside_the_bounds() {
    makes far.vdb box.obj --ior 1.5 --resolution 9 --bounds 5,5,5,6,6,6
    says "warning: 'box' covers no voxel"
}

# One thread, one again, and two give the same bytes. Their number comes from a file, since the
# volume's history holds the command.
test_it_repeats() {
    local options threads
    for options in '--absorption 1,2,3' '--boundary blurred'; do
        rm -f first.vdb
        for threads in 1 1 2; do
            echo "threads=$threads" >threads.toml
            makes same.vdb box.obj --ior 1.5 --resolution 40 $options --config threads.toml
            [ -e first.vdb ] || cp same.vdb first.vdb
            cmp -s first.vdb same.vdb || fail "$options: other bytes by $threads threads"
        done
    done
}

cat >box.obj <<'END'
v 0 0 0
v 1 0 0
v 1 2 0
v 0 2 0
v 0 0 3
v 1 0 3
v 1 2 3
v 0 2 3
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END
sed 's/^v 0/v 5/;s/^v 1/v 6/' box.obj >far.obj
awk '/^f/ {for (i = 2; i <= NF; ++i) $i += 8} {print}' far.obj >behind.obj
{ echo 'o near,a,' && cat box.obj && echo 'o far' && cat behind.obj; } >two.obj
sed 's/^f 5 6 7 8$//' box.obj >open.obj
sed 's/^f \(.\) \(.\) \(.\) \(.\)/f \4 \3 \2 \1/' box.obj >inverted.obj
echo 'this is no mesh' >garbage.off
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n' >sheet.obj
# Sides with corners of their own, rounded to six digits, or pulled apart by a hundredth.
soup() {
    awk -v apart="$1" '/^v/ {for (k = 2; k < 5; ++k) x[n + 0, k] = $k; ++n}
        /^f/ {for (i = 2; i <= 5; ++i) {
            printf "v"
            for (k = 2; k < 5; ++k) printf " %.9g", x[$i - 1, k] + apart * (sides % 5 - 2)
            print ""}
            print "f -4 -3 -2 -1"; ++sides}' box.obj
}
soup 1e-7 >near.obj
soup 0.02 >pulled.obj
run_tests
