#!/bin/bash
# mesh2vol's manners: the right status for every way to go wrong, and no file left by any of them.
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: mesh2vol_test.sh MESH2VOL [CASE]; with CASE (the text a failure prints) only that one runs.
set -u
tool=$(realpath "$1")
only=${2-}
script=$(realpath "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() { # CASE WHAT
    failures=$((failures + 1))
    echo "FAILED: $1: $2"
    echo "  rerun: bash $script $tool '$1'"
}

# expect CASE STATUS ARGUMENT...: runs the tool; on failure there must be one line on standard
# error that names the tool, nothing on standard output, and no new file.
expect() {
    local case=$1 wanted=$2
    shift 2
    [ -z "$only" ] || [ "$only" = "$case" ] || return 0
    local before status
    before=$(ls -A)
    "$tool" "$@" >../"$(basename "$work")".out 2>../"$(basename "$work")".err
    status=$?
    local out err
    out=../$(basename "$work").out
    err=../$(basename "$work").err
    if [ $status -ne "$wanted" ]; then
        fail "$case" "status $status, expected $wanted: $(head -1 "$err")"
    elif [ "$wanted" -ne 0 ]; then
        [ "$before" = "$(ls -A)" ] || fail "$case" "left a file: $(ls -A | tr '\n' ' ')"
        [ "$(wc -l <"$err")" = 1 ] && grep -q '^mesh2vol: error: ' "$err" ||
            fail "$case" "said: $(cat "$err")"
        [ -s "$out" ] && fail "$case" "wrote to standard output"
    fi
    last=$(cat "$err")
    rm -f "$out" "$err"
    return 0
}

# said CASE TEXT: the last run's standard error has the text.
said() {
    [ -z "$only" ] || [ "$only" = "$1" ] || return 0
    case $last in *"$2"*) ;; *) fail "$1" "'$2' is not in: $last" ;; esac
}

# check CASE COMMAND...: the command succeeds.
check() {
    local case=$1
    shift
    [ -z "$only" ] || [ "$only" = "$case" ] || return 0
    "$@" || fail "$case" "$*"
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
sed 's/^f 5 6 7 8$//' box.obj >open.obj
sed 's/^f \(.\) \(.\) \(.\) \(.\)/f \4 \3 \2 \1/' box.obj >inverted.obj
echo 'this is no mesh' >garbage.off
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n' >sheet.obj
small="--ior 1.5 --resolution 20 --padding 3"

expect help 0 --help
expect version 0 --version
expect nothing 64
expect "no output" 64 box.obj --ior 1.5
said "no output" "--output"
expect "no ior" 64 box.obj -o x.vdb
said "no ior" "--ior"
expect "two outputs" 64 box.obj $small -o x.vdb -o y.vdb
expect "unknown option" 64 box.obj $small -o x.vdb --colour red

# refused OPTION VALUE...: each value is wrong usage, and the message names the option.
refused() {
    local option=$1 value
    shift
    for value in "$@"; do
        expect "$option $value" 64 box.obj --ior 1.5 -o x.vdb "$option=$value"
        said "$option $value" "$option"
    done
}
expect "--ior 0" 64 box.obj -o x.vdb --ior 0
said "--ior 0" "--ior: found 0, expected above 0"
for value in -1 nan inf 1e-300 1e300 glass ""; do
    expect "--ior '$value'" 64 box.obj -o x.vdb "--ior=$value"
    said "--ior '$value'" "--ior"
done
refused --dispersion nan blue 1e300
refused --absorption -1 1,2 1,2,-3 1,2,nan 1,2,3,4 red
refused --scattering -0.5 1,,2
refused --anisotropy 1 -1 1.5 0.99999999999 nan
refused --emission -1 inf
refused --opacity -0.1 1.1 nan
refused --albedo 2 -1 1,1,1.5
refused --reflectance -1
refused --priority 1.5 high
refused --name "" medium a,b "a[1]" $'a\tb'
refused --boundary "" Sharp sdf 1
refused --medium-ior 0 -1 nan x
refused --medium-absorption -1 1,2
refused --medium-scattering -1
refused --medium-anisotropy 1
refused --medium-emission -1
refused --medium-dispersion nan
refused --resolution 0 -5 2047 1.5 x
refused --voxel-size 0 -1 nan inf 1e-9 x
refused --padding -1 1e9 2000 x
refused --supersample 0 3 16 x
refused --bounds 0,0,0,1,1 0,0,0,1,1,0 1,0,0,0,1,1 a,b,c,d,e,f nan,0,0,1,1,1
refused --sdf-band 0 -1 3.9 1000 nan
expect "resolution and voxel size" 64 box.obj --ior 1.5 -o x.vdb --resolution 9 --voxel-size 1
expect "padding too wide" 64 box.obj --ior 1.5 -o x.vdb --resolution 16 --padding 8
said "padding too wide" "--resolution: found 16, expected more than twice the --padding of 8"
expect "padding and bounds" 64 box.obj --ior 1.5 -o x.vdb --padding 1 --bounds 0,0,0,1,1,1
expect "three indices for two meshes" 64 box.obj box.obj --ior 1 --ior 2 --ior 3 -o x.vdb
said "three indices for two meshes" "--ior: given 3 times, expected once or once for each"
expect "two indices for one mesh" 64 box.obj --ior 1 --ior 2 -o x.vdb
expect "same name for two objects" 64 box.obj box.obj $small -o x.vdb
said "same name for two objects" "--name: found 'box' for two objects"
expect "no more --sdf" 64 box.obj $small --sdf -o x.vdb

expect "missing mesh" 66 none.obj $small -o x.vdb
said "missing mesh" none.obj
expect "missing config" 66 box.obj $small -o x.vdb --config none.toml
expect "garbage mesh" 65 garbage.off $small -o x.vdb
said "garbage mesh" garbage.off
expect "unknown kind of mesh" 65 "$script" $small -o x.vdb
expect "open mesh" 65 open.obj $small -o x.vdb
said "open mesh" "open.obj: bounds no volume: open: 4 edges with a single face, around 1 hole"
said "open mesh" "--repair closes it"
expect "inverted mesh" 65 inverted.obj $small -o x.vdb
said "inverted mesh" "inside out"
expect "flat mesh repaired" 65 sheet.obj $small --repair -o x.vdb
expect "second mesh open" 65 box.obj open.obj $small -o x.vdb
expect "more than the host holds" 71 box.obj --ior 1.5 --resolution 2046 --padding 0 --cube \
    --absorption 1 --scattering 1 --emission 1 --opacity 1 --albedo 0.5 -o x.vdb
said "more than the host holds" "bytes"
expect "missing folder" 73 box.obj $small -o none/x.vdb
expect "output is an input" 64 box.obj $small -o box.obj
expect "full disk" 74 box.obj $small -o /dev/full
expect "no such device" 69 box.obj $small --device 99 -o x.vdb

touch there.vdb
expect "no clobber" 73 box.obj $small --no-clobber -o there.vdb
check "no clobber" test ! -s there.vdb
rm there.vdb

# From here on files are made.
expect "explain" 0 box.obj --ior 1.5 --explain
check "explain leaves no file" test "$(ls ./*.vdb 2>/dev/null | wc -l)" = 0
expect "box" 0 box.obj $small -o box.vdb
[ -z "$last" ] || [ -n "$only" ] || fail "box" "is not silent: $last"
expect "open repaired" 0 open.obj $small --repair -o open.vdb
said "open repaired" "filled 1 hole"
expect "inverted repaired" 0 inverted.obj $small --repair -o inverted.vdb
expect "stats" 0 box.obj $small -o stats.vdb --stats stats.json
for word in '"occupied_voxels"' '"voxelize"' '"why"' '"triangles": 12'; do
    check "stats" grep -q -- "$word" stats.json
done
expect "outputs before meshes" 0 -o several.vdb --ior 1.5 --ior 1.2 --resolution 20 --padding 3 \
    --name first --name second.part box.obj box.obj
expect "same name, blurred" 0 box.obj box.obj $small --boundary blurred -o same.vdb
rm -f same.vdb
for voxels in 1 2 4 7 16; do
    expect "resolution $voxels" 0 box.obj --ior 1.5 --resolution $voxels -o few.vdb
done
sed 's/^v 1/v 0.01/' box.obj >thin.obj
expect "thin wall" 0 thin.obj $small -o thin.vdb --stats thin.json
said "thin wall" "warning: 'thin' has a wall of 0.01 units, 0.0467 voxels, at (0.005, "
said "thin wall" "--resolution 606 would"
check "thin wall" grep -q '"thinnest_wall_voxels": 0.0466' thin.json
expect "thin wall that can't be written" 74 thin.obj $small -o /dev/full
expect "thin wall, --voxel-size" 0 thin.obj --ior 1.5 --voxel-size 0.1 -o thin.vdb
said "thin wall, --voxel-size" "--voxel-size 0.005 would"
expect "thin wall resolved" 0 thin.obj --ior 1.5 --voxel-size 0.005 --padding 4 -o thin.vdb --quiet
[ -z "$last" ] || [ -n "$only" ] || fail "thin wall resolved" "is not silent: $last"
expect "thin wall, blurred" 0 thin.obj $small --boundary blurred -o thin.vdb
case $last in *wall*) fail "thin wall, blurred" "speaks of walls: $last" ;; esac
cp box.obj 'a,b[1].obj'
expect "a file's name that no object may have" 0 'a,b[1].obj' $small -o named.vdb
expect "mesh outside the bounds" 0 box.obj --ior 1.5 --resolution 9 --bounds 5,5,5,6,6,6 -o far.vdb
said "mesh outside the bounds" "warning: 'box' covers no voxel"

# grids FILE: the names in it.
grids() { vdb_print -l "$1" | sed -n 's/^Name: //p' | sort | tr '\n' ' '; }
if command -v vdb_print >/dev/null; then
    expect "grids" 0 box.obj $small -o grids.vdb --absorption 1,0,0 --opacity 1 --albedo 0.5 \
        --anisotropy 0.5 --medium-scattering 0.1
    check "grids" test "$(grids grids.vdb)" = "absorption absorption.box albedo albedo.box\
 anisotropy.box ior ior.box opacity opacity.box scattering scattering.medium sdf "
    check "only what differs is written" test "$(grids box.vdb)" = "ior ior.box sdf "
    expect "blurred" 0 box.obj $small --boundary blurred -o blurred.vdb
    check "blurred" test "$(grids blurred.vdb)" = "ior "
    check "an object's facts" test "$(vdb_print -l box.vdb |
        grep -cE 'class: level set|eikonal:object: box$|eikonal:(order|priority): 0$')" = 4
    check "a file's name that no object may have" test "$(grids named.vdb)" = "ior ior.a_b_1_ sdf "
    check "class and box" test "$(vdb_print -l box.vdb |
        grep -cE 'Number of active voxels: +(3,520|0)$|Background value: 1(\.5)?$')" = 5
    check "names" test "$(grids several.vdb)" = "ior ior.first ior.second.part\
 sdf.first sdf.second.part "
    "$tool" box.obj $small -o - >piped.vdb
    check "pipe" test "$(grids piped.vdb)" = "ior ior.box sdf "
fi

# The number of threads comes from a file, since the volume's history holds the command.
repeats() { # CASE ARGUMENT...: one thread, one again, and two give the same bytes
    local case=$1 threads
    shift
    for threads in 1 1 2; do
        echo "threads=$threads" >threads.toml
        expect "$case" 0 "$@" --config threads.toml -o same.vdb
        [ ! -e first.vdb ] || check "$case" cmp first.vdb same.vdb
        [ ! -e same.vdb ] || mv same.vdb first.vdb
    done
    rm -f first.vdb
}
repeats "repeats" box.obj --ior 1.5 --absorption 1,2,3 --resolution 40
repeats "repeats blurred" box.obj --ior 1.5 --boundary blurred --resolution 40

[ $failures -eq 0 ] || exit 1
echo "mesh2vol: all as expected"
