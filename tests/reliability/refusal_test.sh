#!/bin/bash
# What the tools do where the system refuses: the n-th call of a function fails, for n from 1 on.
# refusal_test.sh BUILD_FOLDER LIBRARY [NAME... | -NAME...]
# SPDX-License-Identifier: GPL-3.0-or-later
tool=refusals
library=$(realpath "$2")
set -- "$1" "${@:3}"
. "$(dirname "$0")/../support/manners.sh"
rounds=0

# refuse ORDER STATUSES OUTPUT COMMAND...: so ordered, the command ends within its time with one of
# the statuses, in one line of error, leaving nothing; or with 0 and the bytes it should write.
refuse() {
    local order=$1 statuses=$2 output=$3 found
    shift 3
    rounds=$((rounds + 1))
    rm -f "$output"
    REFUSE=$order LD_PRELOAD=$library timeout -k 1 30 "$@" >stdout 2>stderr
    found=$?
    case " 0 $statuses " in
    *" $found "*) ;;
    *) fail "REFUSE=$order '$*' gave $found, expected $statuses" ;;
    esac
    if [ $found -eq 0 ]; then
        cmp -s "$output" "whole-$output" || fail "REFUSE=$order '$*' gave 0 and other bytes"
    else
        [ -e "$output" ] && fail "REFUSE=$order '$*' left $output"
        [ "$(wc -l <stderr)" -eq 1 ] || fail "REFUSE=$order '$*': expected one line"
        grep -q "^$1: error: " stderr || fail "REFUSE=$order '$*': does not say who speaks"
    fi
    local left
    left=$(find . -name '.*.*')
    [ -z "$left" ] || fail "REFUSE=$order '$*' left $left"
    rm -f $left
}

# counted FUNCTION COMMAND...: how many calls of it there are.
counted() {
    REFUSE=$1:0 REFUSE_COUNT=count LD_PRELOAD=$library "${@:2}" 2>/dev/null
    cat count
}

# All calls of those that are few; of many, those at growing distances, by three fifths each.
some_of() {
    awk -v all="$1" 'BEGIN {for (n = 1; n <= all; n = int(n * (all > 40 ? 1.6 : 1)) + 1) print n}'
}

# each_refused OUTPUT COMMAND...: of every function, some calls alone and all from there on.
each_refused() {
    local output=$1 all n
    shift
    "$@" 2>/dev/null && mv "$output" "whole-$output" || fail "'$*' fails by itself"
    local function statuses
    while read -r function statuses; do
        all=$(counted "$function" "$@")
        for n in $(some_of "$all"); do
            refuse "$function:$n" "$statuses" "$output" "$@"
            [ "$function" = threads ] || refuse "$function:$n+" "$statuses" "$output" "$@"
        done
    done <<'END'
threads 71
eglInitialize 69
glCompileShader 70
write 74
fsync 74
rename 73
malloc 65 66 69 70 71 74
END
}

test_mesh2vol() { each_refused out.vdb mesh2vol box.obj -o out.vdb --ior 1.5 --resolution 12 --quiet; }

test_volsmooth() { each_refused out.vdb volsmooth slope.vdb -o out.vdb --quiet; }

test_lightsim() {
    each_refused out.vdb lightsim lit.vdb -o out.vdb --light directional:0,-1,0 --photons 1000 --quiet
}

test_render() {
    local look='--eye 0,0,5 --target 0,0,0 --fov 40 --size 20x15 --background 1,1,1 --quiet'
    each_refused out.exr render box.vdb -o out.exr $look --aov all
    each_refused out.png render box.vdb -o out.png ${look/--background 1,1,1/--env map.png}
}

# Little address space: the picture, or 71. (The loader of libraries itself needs some 100 MB.)
test_address_space() {
    local look='--eye 0,0,5 --target 0,0,0 --fov 40 --size 20x15 --background 1,1,1 --quiet' limit found
    render box.vdb -o out.exr $look && mv out.exr whole-out.exr || fail "the picture fails"
    for limit in $(seq 200000 25000 700000); do
        rounds=$((rounds + 1))
        (ulimit -v "$limit" && exec timeout -k 1 30 render box.vdb -o out.exr $look) >stdout 2>stderr
        found=$?
        case $found in
        0) cmp -s out.exr whole-out.exr || fail "ulimit -v $limit: other bytes" ;;
        71) [ "$(wc -l <stderr)" -eq 1 ] || fail "ulimit -v $limit: expected one line" ;;
        *) fail "ulimit -v $limit gave $found, expected 0 or 71" ;;
        esac
        [ $found -ne 0 ] || rm out.exr
        nothing_left
    done
    [ $found -eq 0 ] || fail "700 MB are not enough"
}

# A device that can't be had, and kernels that don't compile.
test_device() {
    local look='--eye 0,0,5 --target 0,0,0 --fov 40 --size 20x15 --quiet'
    expect_of render 69 env __EGL_VENDOR_LIBRARY_DIRS=/nonexistent __EGL_VENDOR_LIBRARY_FILENAMES=none \
        render box.vdb -o out.exr $look
    local path
    mkdir -p broken/view broken/lightsim broken/smooth broken/voxelize
    for path in view/trace.comp lightsim/trace.comp smooth/gaussian.comp voxelize/crossings.frag; do
        echo 'void main() { nonsense }' >broken/$path.glsl
    done
    export EIKONAL_SHADERS=$PWD/broken
    expect_of render 70 render box.vdb -o out.exr $look
    expect_of lightsim 70 lightsim lit.vdb -o out.vdb --light directional:0,-1,0 --photons 1000
    expect_of volsmooth 70 volsmooth slope.vdb -o out.vdb
    expect_of mesh2vol 70 mesh2vol box.obj -o out.vdb --ior 1.5 --resolution 12
    unset EIKONAL_SHADERS
}

expect_of() { # TOOL STATUS COMMAND...
    tool=$1
    shift
    expect "$@"
    nothing_left
}

cat >box.obj <<'END'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 2 3 7 6
f 1 5 8 4
END
mesh2vol box.obj -o box.vdb --ior 1.5 --resolution 12 --quiet || exit 2
make_volume slope.vdb size=8 voxel=0.1 ior sphere:0.3:1.5:1:all || exit 2
make_volume lit.vdb size=8 voxel=0.1 ior sphere:0.3:1.5:1:all scattering sphere:0.3:1,2,3:0 || exit 2
oiiotool --pattern constant:color=0.5,0.4,0.3 16x8 3 -d uint8 -o map.png || exit 2
trap 'echo "$rounds refusals tried"; rm -rf "$folder"' EXIT
run_tests
