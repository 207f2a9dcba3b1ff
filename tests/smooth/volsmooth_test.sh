#!/bin/bash
# The manners of volsmooth: what it answers, with which status, and what it leaves behind.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=volsmooth
. "$(dirname "$0")/../support/manners.sh"

test_help() {
    expect 0 volsmooth --help
    grep -q 'IN.vdb' stdout || fail "--help does not name its input"
    expect 0 volsmooth --version
    grep -q '^volsmooth [0-9]' stdout || fail "--version names no version"
}

test_bad_usage() {
    refuses 64
    refuses 64 in.vdb
    refuses 64 -o out.vdb
    refuses 64 in.vdb -o out.vdb --nonsense
    refuses 64 in.vdb extra.vdb -o out.vdb
    local value
    for value in -1 nan inf x '' 1e9; do refuses 64 in.vdb -o out.vdb --sigma="$value"; done
    for value in 4 0 -3 1.5 x 100001; do
        refuses 64 in.vdb -o out.vdb --kernel="$value"
        says "$value"
    done
    for value in '' , ior,; do refuses 64 in.vdb -o out.vdb --grids="$value"; done
    refuses 64 in.vdb -o out.vdb --device nothing
    refuses 64 in.vdb -o out.vdb --threads -1
}

test_output_is_input() {
    cp in.vdb out.vdb
    expect 64 volsmooth out.vdb -o out.vdb
    cmp -s in.vdb out.vdb || fail "the input was changed"
    ln -s out.vdb link.vdb
    expect 64 volsmooth out.vdb -o link.vdb
    cmp -s in.vdb out.vdb || fail "the input was changed through a link"
    expect 64 volsmooth out.vdb -o other.vdb --stats out.vdb
    [ ! -e other.vdb ] || fail "other.vdb was written"
    rm -f out.vdb link.vdb other.vdb
}

test_missing_input() {
    refuses 66 absent.vdb -o out.vdb
    says absent.vdb
    refuses 66 in.vdb -o out.vdb --config absent.toml
}

test_bad_input() {
    head -c 5000 /dev/zero | tr '\0' x >garbage.vdb
    : >empty.vdb
    mkdir -p folder.vdb
    local file size
    for file in garbage.vdb empty.vdb folder.vdb; do
        refuses 65 $file -o out.vdb
        says $file
    done
    size=$(stat -c %s in.vdb)
    for part in 10 40 300 $((size / 2)) $((size - 1)); do
        head -c $part in.vdb >cut.vdb
        refuses 65 cut.vdb -o out.vdb
        says cut.vdb
        expect 65 bash -c 'volsmooth - -o out.vdb <cut.vdb'
        nothing_left
    done
}

test_unknown_grid() {
    refuses 65 in.vdb -o out.vdb --grids smoke
    says "no grid 'smoke' (found: absorption, ior, opacity)"
    refuses 65 in.vdb -o out.vdb --grids ior,smoke --sigma 0
}

test_outputs_that_fail() {
    refuses 73 in.vdb -o absent/out.vdb
    says absent/out.vdb
    echo mine >out.vdb
    expect 73 volsmooth in.vdb -o out.vdb --no-clobber
    [ "$(cat out.vdb)" = mine ] || fail "--no-clobber let the file be changed"
    rm out.vdb
    refuses 74 in.vdb -o /dev/full
    expect 74 bash -c 'volsmooth in.vdb -o - >/dev/full'
}

test_smooths() {
    expect 0 volsmooth in.vdb -o out.vdb --stats stats.json
    grep -q '"voxels": 65536' stats.json || fail "--stats does not count the voxels of two grids"
    grep -q '"name": "smooth"' stats.json || fail "--stats has no pass 'smooth'"
    [ ! -s stdout ] || fail "it wrote to standard output"
    cmp -s in.vdb out.vdb && fail "nothing was smoothed"
    rm out.vdb
}

test_explains() {
    expect 0 volsmooth in.vdb --explain
    grep -q '^ior: on' stdout || fail "--explain does not say that ior is smoothed"
    expect 0 volsmooth in.vdb --explain --grids absorption
    grep -q '^absorption: on' stdout || fail "--explain does not say what --grids asks for"
    nothing_left
}

test_objects() {
    # A mesh's index is constant within; only the mixed one is smoothed.
    printf 'v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >tetra.obj
    expect 0 mesh2vol tetra.obj -o tetra.vdb --ior 1.5 --resolution 32
    expect 0 volsmooth tetra.vdb --explain
    prints '^ior: on'
    prints '^ior.tetra: off (it has one value)'
    expect 0 volsmooth tetra.vdb -o out.vdb --grids sdf
    if command -v vdb_print >/dev/null; then
        vdb_print -l out.vdb >stdout
        prints 'class: level set'
        prints 'eikonal:object: tetra'
    fi
    rm -f out.vdb
    refuses 65 tetra.vdb -o out.vdb --grids sdf.tetra
    says "no grid 'sdf.tetra'"
    expect 0 make_volume twice.vdb size=8 sdf.medium sphere:3:-1:1 ior sphere:3:1.5:1:all
    refuses 65 twice.vdb -o out.vdb
    says "expected another name"
}

test_copies_what_needs_nothing() {
    expect 0 volsmooth in.vdb -o out.vdb --sigma 0 --stats stats.json
    says 'nothing in in.vdb to smooth'
    grep -q '"device": null' stats.json || fail "it opened a device"
    expect 0 volsmooth in.vdb -o out.vdb --sigma 0 --quiet
    [ ! -s stderr ] || fail "--quiet talks"
    rm out.vdb
    expect 0 make_volume fog.vdb size=8 scattering sphere:3:1:0
    expect 0 volsmooth fog.vdb -o out.vdb
    says 'nothing in fog.vdb to smooth'
    rm out.vdb
}

test_pipes_and_repeats() {
    # The history holds the command, which is therefore the same each time.
    local threads
    for threads in 1 2; do
        expect 0 bash -c "volsmooth - -o - <in.vdb | LP_NUM_THREADS=$threads volsmooth - -o - >out$threads"
    done
    cmp -s out1 out2 || fail "two runs through a pipe differ"
    expect 0 volsmooth out1 -o out.vdb --sigma 0 # reads what came through
    rm -f out*
    mkdir a b c
    expect 0 volsmooth in.vdb -o a/out.vdb --threads 1
    expect 0 volsmooth in.vdb -o b/out.vdb --threads 1
    expect 0 volsmooth in.vdb -o c/out.vdb --threads 2
    cmp -s a/out.vdb b/out.vdb || fail "a second run gives other bytes"
    # Two numbers of threads are two commands in the history, and the file's identifier is made
    # from that: all but the first block is compared, which ends before the grids' values.
    cmp -s <(tail -c +4096 a/out.vdb) <(tail -c +4096 c/out.vdb) ||
        fail "the number of threads changes the values"
    rm -r a b c
}

test_signal_leaves_nothing() {
    # A volume large enough to be met at work.
    local signal
    for signal in TERM INT HUP; do
        dies_by $signal volsmooth large.vdb -o out.vdb --quiet
    done
}

make_volume in.vdb size=32 voxel=0.1 ior sphere:1:1.5:1:all opacity sphere:0.5:1:0 \
    absorption sphere:1:1,2,3:0 || exit 2
make_volume large.vdb size=192 voxel=0.1 ior linear:2:0.01,0.02,0.03:all || exit 2
run_tests
