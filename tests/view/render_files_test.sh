#!/bin/bash
# What render takes as files and maps: pipes, redirections, layers, pictures as the world has them.
# SPDX-License-Identifier: GPL-3.0-or-later
tool=render
. "$(dirname "$0")/../support/manners.sh"
view='--eye 0,0,5 --target 0,0,0 --fov 30 --size 16x12'

test_what_the_shell_makes_of_files() {
    render in.vdb $view --env env.exr -o first.exr || fail "the picture fails"
    cp first.exr wanted.exr
    # Pipes and redirections under the names that shells give them.
    local path
    for path in /dev/stdout /proc/self/fd/1; do
        render in.vdb $view --env env.exr -o $path 2>stderr | cat >got.exr
        idiff -q wanted.exr got.exr >/dev/null || fail "$path into a pipe gives no such picture"
        render in.vdb $view --env env.exr -o $path >got.exr 2>stderr
        idiff -q wanted.exr got.exr >/dev/null || fail "$path into a file gives no such picture"
        # What is there already stays before it.
        { echo before; render in.vdb $view --env env.exr -o $path; } >got.exr 2>stderr
        [ "$(head -c 6 got.exr)" = before ] || fail "$path writes over what was there"
    done
    render in.vdb $view --env env.exr -o >(cat >got.exr) 2>stderr || fail "-o >(command) fails"
    for _ in $(seq 100); do
        idiff -q wanted.exr got.exr >/dev/null 2>&1 && break
        sleep 0.05
    done
    idiff -q wanted.exr got.exr >/dev/null || fail "-o >(command) gives no such picture"
    for path in env.exr env.png; do
        render in.vdb $view --env $path -o wanted.exr
        render in.vdb $view --env <(cat $path) -o got.exr 2>stderr || fail "--env <(cat $path) fails"
        idiff -q wanted.exr got.exr >/dev/null || fail "--env <(cat $path) is another map"
        render in.vdb $view --env - -o got.exr <$path 2>stderr || fail "--env - fails"
        idiff -q wanted.exr got.exr >/dev/null || fail "--env - is another map"
    done
    rm -f first.exr wanted.exr got.exr
    refuses 65 in.vdb $view --env <(echo nonsense) -o out.exr
    refuses 73 in.vdb $view -o /dev/fd/99
    refuses 73 in.vdb $view -o /dev/stdin </dev/null
}

test_environments() {
    oiiotool env.exr --ch R=R,G=G,B=B --chnames sky.R,sky.G,sky.B -o layer.exr
    expect 0 render in.vdb $view --env env.exr -o first.exr
    expect 0 render in.vdb $view --env layer.exr -o out.exr
    idiff -q first.exr out.exr >/dev/null || fail "the only layer is another map"
    expect 0 render in.vdb $view --env layer.exr:sky -o out.exr
    rm out.exr
    refuses 65 in.vdb $view --env layer.exr:sun -o out.exr
    says "no layer or part 'sun'"
    oiiotool env.exr --addc -1 -o dark.exr
    expect 0 render in.vdb $view --env dark.exr -o out.exr
    says 'warning: dark.exr: 1536 negative samples are taken as 0'
    rm out.exr
    # A run that fails does not speak of it.
    refuses 74 in.vdb $view --env dark.exr -o /dev/full
    rm -f first.exr
}

test_places() {
    local far="--place in.vdb:2.5,0,0"
    expect 0 render in.vdb $view $far -o moved.exr --env env.exr
    expect 0 render in.vdb $view --env env.exr -o plain.exr
    idiff -q plain.exr moved.exr >/dev/null && fail "a volume that is moved is where it was"
    # Where it is to be seen again, twice is not as once.
    expect 0 render in.vdb $view $far --place in.vdb:0,0,0 -o both.exr --env env.exr --stats stats.json
    idiff -q moved.exr both.exr >/dev/null && fail "two volumes look like one"
    expect 0 render in.vdb $view --place in.vdb:0,0,0 --env env.exr -o same.exr
    idiff -q plain.exr same.exr >/dev/null || fail "a volume moved by nothing is another"
    local wrong
    for wrong in in.vdb in.vdb:1,2 in.vdb:1,2,3:4 in.vdb:1,2,3:4,5,6:0 in.vdb:1,2,3:4,5,6:-1 :1,2; do
        refuses 64 in.vdb $view -o out.exr --place "$wrong"
        says "--place: found '$wrong'"
    done
    refuses 66 in.vdb $view -o out.exr --place nothing.vdb:1,0,0
    refuses 65 in.vdb $view $far --place in.vdb:2,0,0 -o out.exr
    says "its domain overlaps that of in.vdb"
    rm -f moved.exr plain.exr both.exr same.exr stats.json
}

make_volume in.vdb size=16 voxel=0.1 ior sphere:0.5:1.5:1:all absorption sphere:0.5:1,2,3:0 ||
    exit 2
oiiotool --pattern constant:color=0.5,0.4,0.3 32x16 3 -d float -o env.exr || exit 2
oiiotool env.exr -d uint8 -o env.png || exit 2
run_tests
