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
        [ "$(grep -c '^mesh2vol: error: ' "$err")" = 1 ] || fail "$case" "said: $(cat "$err")"
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
refused --name ""
refused --medium-ior 0 -1 nan x
refused --medium-absorption -1 1,2
refused --medium-scattering -1
refused --medium-anisotropy 1
refused --medium-emission -1
refused --medium-dispersion nan
refused --resolution 0 -5 2047 1.5 x 16
refused --voxel-size 0 -1 nan inf 1e-9 x
refused --padding -1 1e9 2000 x
refused --supersample 0 3 16 x
refused --bounds 0,0,0,1,1 0,0,0,1,1,0 1,0,0,0,1,1 a,b,c,d,e,f nan,0,0,1,1,1
refused --sdf-band 0 -1 1000 nan
expect "resolution and voxel size" 64 box.obj --ior 1.5 -o x.vdb --resolution 9 --voxel-size 1
expect "padding and bounds" 64 box.obj --ior 1.5 -o x.vdb --padding 1 --bounds 0,0,0,1,1,1
expect "three indices for two meshes" 64 box.obj box.obj --ior 1 --ior 2 --ior 3 -o x.vdb
said "three indices for two meshes" "--ior: given 3 times, expected once or once for each"
expect "two indices for one mesh" 64 box.obj --ior 1 --ior 2 -o x.vdb
expect "same name for two distances" 64 box.obj box.obj $small --sdf -o x.vdb

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
    --sdf --name first --name second box.obj box.obj
expect "mesh outside the bounds" 0 box.obj --ior 1.5 --resolution 9 --bounds 5,5,5,6,6,6 -o far.vdb
said "mesh outside the bounds" "warning: 'box' covers no voxel"

# grids FILE: the names in it.
grids() { vdb_print -l "$1" | sed -n 's/^Name: //p' | tr '\n' ' '; }
if command -v vdb_print >/dev/null; then
    expect "grids" 0 box.obj $small -o grids.vdb --absorption 1,0,0 --opacity 1 --albedo 0.5 --sdf \
        --anisotropy 0.5
    check "grids" test "$(grids grids.vdb)" = "absorption albedo ior opacity sdf "
    check "only what differs is written" test "$(grids box.vdb)" = "ior "
    check "class and box" test "$(vdb_print -l box.vdb |
        grep -cE 'class: fog volume|Number of active voxels: +3,520$|Background value: 1$')" = 3
    check "names" test "$(grids several.vdb)" = "ior sdf.first sdf.second "
    "$tool" box.obj $small -o - >piped.vdb
    check "pipe" test "$(grids piped.vdb)" = "ior "
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
repeats "repeats with distances" box.obj --ior 1.5 --sdf --resolution 40

[ $failures -eq 0 ] || exit 1
echo "mesh2vol: all as expected"
