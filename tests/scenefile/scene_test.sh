#!/bin/bash
# Scenes of a modeller by three commands and no number: the same pictures as by numbers, and what is
# refused, told or named.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=mesh2vol
. "$(dirname "$0")/../support/manners.sh"
here=$(dirname "$script")
small="--resolution 24 --padding 4"
# By Rec. 709's R, G, B what 1/2, 1/4 and 1/8 in half a unit come to.
absorption=1.3862943611198906,2.772588722239781,4.1588830833596715

# lit NAME MESH2VOL_ARGUMENTS...: NAME.vdb, lit as closed.gltf says.
lit() {
    local file=$1
    shift
    expect 0 mesh2vol "$@" $small -o scene.vdb
    expect 0 lightsim scene.vdb --lights $here/closed.gltf -o $file.vdb
}

# shows NAME RENDER_ARGUMENTS...: NAME.png of lit.vdb.
shows() {
    local file=$1
    shift
    expect 0 render lit.vdb -o $file.png "$@"
    [ -s $file.png ] || fail "no $file.png"
}

same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }

test_three_commands_are_the_same_as_numbers() {
    lit lit $here/closed.gltf
    shows scene --camera $here/closed.gltf:View --size 48x32
    shows typed --eye 0.5,3,5 --target 0.5,2.5158770817240729,4.125 --up 0,0.875,-0.4841229182759271 \
        --fov 34.37746770784939 --size 48x32
    same scene.png typed.png
    shows above --camera $here/closed.gltf:Above --size 32x32
    shows typed --eye 0,5,0 --target 0,4,0 --up 0,0,-1 --ortho 4 --size 32x32
    same above.png typed.png

    expect 0 mesh2vol $here/box.obj $here/slab.obj --ior 1.25 --ior 1 --absorption $absorption \
        --absorption 0 --opacity 0 --opacity 1 --albedo 0 --albedo 0.75,0.5,0.25 $small -o scene.vdb
    expect 0 lightsim scene.vdb -o lit.vdb \
        --light spot:0.25,4,0:0,-1,0:21.485917317405871:7.161972439135290:10 \
        --light directional:0,-1,0:1,0.5,0.25
    shows numbers --camera $here/closed.gltf:View --size 48x32
    same scene.png numbers.png
}

test_names_of_objects_and_options_that_win() {
    expect 0 mesh2vol $here/closed.gltf $small -o scene.vdb --explain
    prints "material closed.Box: 'Glass' of the file: ior 1.25, absorption"
    prints "material closed.Slab: 'Matt' of the file: opaque, albedo 0.75,0.5,0.25"
    expect 0 mesh2vol $here/closed.gltf $small -o scene.vdb --explain --material sf10 --material none
    prints "material closed.Box: sf10"
    prints "material closed.Slab: 'Matt' of the file"
    sed 's/, "material": [01]//g' $here/closed.gltf >bare.gltf
    expect 0 mesh2vol bare.gltf $small -o scene.vdb --explain
    prints "material bare.Box: 'no material' of the file: opaque, albedo 0.8"
    expect 0 mesh2vol bare.gltf $small -o scene.vdb --explain --ior 1.5
    prints "opacity: off"
    expect 0 mesh2vol - $small -o scene.vdb --explain <$here/closed.gltf
    prints "material mesh.Box: 'Glass'"
}

test_an_opaque_sheet_is_a_plate() {
    expect 0 mesh2vol $here/sheet.gltf $small -o scene.vdb
    says "warning: .*sheet.gltf: open and opaque, made plates of 6 voxels behind their faces: 'Floor'"
    [ "$(grep -c plates stderr)" = 1 ] || fail "said more than once"
    sed 's/"mesh": 2/"mesh": 2, "scale": [1, 1, 1]/; s/"material": 1/"material": 0/g' $here/sheet.gltf >glass.gltf
    refuses 65 glass.gltf $small -o out.vdb
    says "bounds no volume"
}

test_cameras() {
    lit lit $here/closed.gltf
    expect 0 render lit.vdb -o first.png --camera $here/closed.gltf --size 24x16
    says "has 2 cameras, View, Above: takes the first"
    expect 0 render lit.vdb -o first.png --camera $here/closed.gltf --size 24x16 --quiet
    [ -s stderr ] && fail "is not silent"
    expect 0 render lit.vdb -o first.png --camera $here/closed.gltf:Lens --explain
    prints "picture: 640x427"
    tool=render
    refuses 64 lit.vdb -o out.png --camera $here/closed.gltf --eye 0,0,1
    refuses 64 lit.vdb -o out.png --eye 0,0,1
    says "not given: --target, --size, --fov or --ortho"
    refuses 65 lit.vdb -o out.png --camera $here/closed.gltf:Nowhere
    says "no camera 'Nowhere', expected one of View, Above"
    refuses 66 lit.vdb -o out.png --camera nowhere.glb
    refuses 65 lit.vdb -o out.png --camera $here/box.obj
    tool=mesh2vol
}

test_lights() {
    lit lit $here/closed.gltf
    tool=lightsim
    refuses 64 scene.vdb -o out.vdb
    says "not given: --light or --lights"
    refuses 64 scene.vdb -o out.vdb --lights $here/closed.gltf --light Key=point:0,1,0
    says "two are named Key"
    sed 's/KHR_lights_punctual/KHR_nothing/g' $here/closed.gltf >dark.gltf
    refuses 65 scene.vdb -o out.vdb --lights dark.gltf
    says "has no lights"
    refuses 65 scene.vdb -o out.vdb --lights $here/box.obj
    tool=mesh2vol
}

test_materials_of_obj() {
    {
        echo "mtllib box.mtl"
        sed -n '/^v/p' $here/box.obj
        echo "usemtl wine"
        sed -n '/^f/p' $here/box.obj
    } >box.obj
    refuses 64 box.obj $small -o out.vdb
    says "not given: --ior or --material"
    expect 0 mesh2vol box.obj --ior 1.5 $small -o scene.vdb
    says "warning: box.obj: goes without its materials: box.mtl: can't open"
    printf 'newmtl wine\nNi 1.34\nTf 1 0.5 0.25\nKs 1 1 1\n' >box.mtl
    expect 0 mesh2vol box.obj $small -o scene.vdb --explain
    prints "material box: 'wine' of the file: ior 1.34, tint 1,0.5,0.25"
    says "warning: box.mtl: not understood: Ks"
    printf 'newmtl wine\nNi bottle\n' >box.mtl
    refuses 65 box.obj $small -o out.vdb
    says "box.mtl:2: found 'bottle' behind Ni"
}

test_what_is_refused() {
    echo '{"asset": {"version": "2.0"}' >cut.gltf
    refuses 65 cut.gltf -o out.vdb
    says "cut.gltf: found no sound glTF"
    sed 's/data:[^"]*/nowhere.bin/' $here/closed.gltf >apart.gltf
    refuses 66 apart.gltf -o out.vdb
    says "nowhere.bin"
    sed 's/"extensionsUsed"/"extensionsRequired": ["EXT_meshopt_compression"], "extensionsUsed"/' \
        $here/closed.gltf >packed.gltf
    refuses 65 packed.gltf -o out.vdb
    says "EXT_meshopt_compression"
    sed 's/"extensionsUsed": \[/&"KHR_materials_sheen", /' $here/closed.gltf >sheen.gltf
    expect 0 mesh2vol sheen.gltf $small -o scene.vdb
    says "warning: sheen.gltf: not understood: KHR_materials_sheen"
}

run_tests
