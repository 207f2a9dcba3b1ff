#!/bin/bash
# What more of a thing costs: scale.sh BIN MESH WORK PAGE.md [TABLES]. Each run is made twice, the faster
# one counts. TABLES are those to make anew.
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
bin=$1 mesh=$2 work=$3 page=$4
mkdir -p "$work"
view='--eye -0.1,0.2,0.4 --target -0.017,0.11,0 --fov 25 --background 1,1,1 --quiet'
size=640x480

# least FILTER FILES...: the least value of jq's filter [its own unit].
least() { jq -s "[.[] | $1] | min | round" "${@:2}"; }
pass() { echo "([.passes[] | select($1) | .cpu_ms] | add)"; }
megabytes() { echo "(.memory.$1 / 1e6)"; }

# table TITLE...: the head of a table.
table() {
    printf '| %s ' "$@"
    printf '|\n'
    printf '|---%.0s' "$@"
    printf '|\n'
}
row() { printf '| %s ' "$@"; printf '|\n'; }

# slope CSV COLUMN: of the last two rows, as a power of the first column.
slope() { awk -F, -v c="$2" '{x[NR] = $1; y[NR] = $c} END {
    printf "%.2f", log(y[NR] / y[NR - 1]) / log(x[NR] / x[NR - 1])}' "$1"; }

resolutions() {
    local r i csv=$work/resolutions.csv
    : >"$csv"
    table 'voxels' 'mesh2vol [ms]' 'its distances' 'its host [MB]' 'render: prepare [ms]' 'view [ms]' \
        'device [MB]' 'host [MB]'
    for r in 64 128 256 512 1024; do
        for i in 1 2; do
            "$bin/mesh2vol" "$mesh" -o "$work/$r.vdb" --ior 1.5 --resolution $r --quiet \
                --stats "$work/m$r.$i.json"
            "$bin/render" "$work/$r.vdb" -o "$work/$r.exr" $view --size $size --stats "$work/r$r.$i.json"
        done
        local m="$work/m$r.1.json $work/m$r.2.json" v="$work/r$r.1.json $work/r$r.2.json"
        local cells=("$r" "$(least .wall_ms $m)" "$(least "$(pass '.name == "sdf"')" $m)"
            "$(least "$(megabytes rss_peak_bytes)" $m)"
            "$(least "$(pass '.name == "read" or .name == "medium"')" $v)"
            "$(least "$(pass '.name == "view"')" $v)"
            "$(least "$(megabytes gpu_peak_bytes)" $v)" "$(least "$(megabytes rss_peak_bytes)" $v)")
        (IFS=,; echo "${cells[*]}") >>"$csv"
        row "${cells[@]}"
        rm -f "$work/$r.vdb" "$work/$r.exr"
    done
    row 'power of the last step' "$(slope "$csv" 2)" "$(slope "$csv" 3)" "$(slope "$csv" 4)" \
        "$(slope "$csv" 5)" "$(slope "$csv" 6)" "$(slope "$csv" 7)" "$(slope "$csv" 8)"
}

pixels() {
    local s i csv=$work/pixels.csv
    : >"$csv"
    "$bin/mesh2vol" "$mesh" -o "$work/p.vdb" --ior 1.5 --resolution 128 --quiet
    table 'pixels' 'view [ms]' 'write [ms]' 'device [MB]' 'host [MB]'
    for s in 480x270 960x540 1920x1080 3840x2160 7680x4320; do
        for i in 1 2; do
            "$bin/render" "$work/p.vdb" -o "$work/p.exr" $view --size $s --stats "$work/p$s.$i.json"
        done
        local v="$work/p$s.1.json $work/p$s.2.json"
        local cells=("$((${s%x*} * ${s#*x}))" "$(least "$(pass '.name == "view"')" $v)"
            "$(least "$(pass '.name == "write"')" $v)" "$(least "$(megabytes gpu_peak_bytes)" $v)"
            "$(least "$(megabytes rss_peak_bytes)" $v)")
        (IFS=,; echo "${cells[*]}") >>"$csv"
        row "$s" "${cells[@]:1}"
    done
    row 'power of the last step' "$(slope "$csv" 2)" "$(slope "$csv" 3)" "$(slope "$csv" 4)" "$(slope "$csv" 5)"
    rm -f "$work/p.vdb" "$work/p.exr"
}

# lit VDB OPTIONS...: lightsim's statistics, of two runs.
lit() {
    local i
    for i in 1 2; do
        "$bin/lightsim" "$1" -o "$work/lit.vdb" "${@:2}" --quiet --stats "$work/l.$i.json"
    done
}
# What lightsim took, its photons alone, and memory.
lit_cells() {
    local l="$work/l.1.json $work/l.2.json"
    echo "$(least .wall_ms $l)" "$(least "$(pass '.name == "photons"')" $l)" \
        "$(least "$(megabytes gpu_peak_bytes)" $l)" "$(least "$(megabytes rss_peak_bytes)" $l)"
}

# slopes CSV COLUMNS: the last row of a table.
slopes() {
    local c cells=()
    for ((c = 2; c <= $2; ++c)); do cells+=("$(slope "$1" $c)"); done
    row 'power of the last step' "${cells[@]}"
}

# The table of lit_cells by what `run VALUE` simulates, for each value.
light_table() {
    local value cells csv=$work/$1.csv
    : >"$csv"
    table "$1" 'lightsim [ms]' 'its photons' 'device [MB]' 'host [MB]'
    for value in "${@:3}"; do
        "$2" "$value"
        cells=("$value" $(lit_cells))
        (IFS=,; echo "${cells[*]}") >>"$csv"
        row "${cells[@]}"
    done
    slopes "$csv" 5
}

sun='directional:0.5,-1,-0.15'
jade() { "$bin/mesh2vol" "$mesh" -o "$work/j.vdb" --ior 1.5 --scattering 30 --resolution "$1" --quiet; }
lit_voxels() { jade "$1" && lit "$work/j.vdb" --light $sun --photons 100000; }
lit_photons() { lit "$work/j.vdb" --light $sun --photons "$1"; }
lit_lights() {
    local k lights=()
    for ((k = 0; k < $1; ++k)); do lights+=(--light $sun); done
    lit "$work/j.vdb" "${lights[@]}" --photons 10000
}

# balls COUNT QUADS: an OBJ of balls on a lattice of four an edge, each of 4 QUADS² triangles.
balls() {
    awk -v count="$1" -v n="$2" 'BEGIN {
        pi = atan2(0, -1)
        for (k = 0; k < count; ++k) {
            print "o ball" k
            for (i = 0; i <= n; ++i)
                for (j = 0; j < 2 * n && (j == 0 || i % n != 0); ++j) {
                    a = pi * i / n; b = pi * j / n
                    printf "v %.7g %.7g %.7g\n", k % 4 + 0.4 * sin(a) * cos(b),
                        int(k / 4) % 4 + 0.4 * cos(a), int(k / 16) + 0.4 * sin(a) * sin(b)
                }
            first = k * (2 * n * (n - 1) + 2) + 1; last = first + 2 * n * (n - 1) + 1
            for (j = 0; j < 2 * n; ++j) {
                next_j = (j + 1) % (2 * n)
                print "f", first, first + 1 + next_j, first + 1 + j
                print "f", last, last - 2 * n + j, last - 2 * n + next_j
                for (i = 1; i < n - 1; ++i) {
                    at = first + 1 + 2 * n * (i - 1)
                    print "f", at + j, at + next_j, at + 2 * n + j
                    print "f", at + next_j, at + 2 * n + next_j, at + 2 * n + j
                }
            }
        }
    }'
}

objects() {
    local count i csv=$work/objects.csv
    : >"$csv"
    table 'objects' 'mesh2vol [ms]' 'its host [MB]' 'render: prepare [ms]' 'view [ms]' \
        'view, a million looks [ms]' 'device [MB]'
    for count in 1 2 4 8 16 32 64; do
        balls $count 16 >"$work/balls.obj"
        # Options as many as objects keep each an object of its own.
        local iors=()
        for ((i = 0; i < count; ++i)); do iors+=(--ior 1.$((i % 5 + 3))); done
        for i in 1 2; do
            "$bin/mesh2vol" "$work/balls.obj" -o "$work/b.vdb" "${iors[@]}" --quiet --resolution 128 \
                --bounds -0.5,-0.5,-0.5,3.5,3.5,3.5 --stats "$work/m.$i.json"
            "$bin/render" "$work/b.vdb" -o "$work/b.exr" --eye 5,6,9 --target 1.5,1.5,1.5 --fov 30 \
                --background 1 --size 160x120 --quiet --stats "$work/r.$i.json"
        done
        local m="$work/m.1.json $work/m.2.json" v="$work/r.1.json $work/r.2.json"
        local view_pass cells
        view_pass=$(pass '.name == "view"')
        cells=("$count" "$(least .wall_ms $m)" "$(least "$(megabytes rss_peak_bytes)" $m)"
            "$(least "$(pass '.name == "read" or .name == "medium"')" $v)" "$(least "$view_pass" $v)"
            "$(least "($view_pass / .counters.steps * 1e6)" $v)" "$(least "$(megabytes gpu_peak_bytes)" $v)")
        (IFS=,; echo "${cells[*]}") >>"$csv"
        row "${cells[@]}"
    done
    slopes "$csv" 7
}

triangles() {
    local quads i csv=$work/triangles.csv
    : >"$csv"
    table 'triangles' 'mesh2vol [ms]' 'reading and checks' 'distances' 'host [MB]'
    for quads in 50 158 500 1582; do
        balls 1 $quads >"$work/ball.obj"
        for i in 1 2; do
            "$bin/mesh2vol" "$work/ball.obj" -o "$work/b.vdb" --ior 1.5 --quiet --resolution 128 \
                --stats "$work/m.$i.json"
        done
        local m="$work/m.1.json $work/m.2.json"
        local cells=("$((4 * quads * (quads - 1)))" "$(least .wall_ms $m)"
            "$(least "$(pass '.name == "read" or .name == "check"')" $m)"
            "$(least "$(pass '.name == "sdf"')" $m)" "$(least "$(megabytes rss_peak_bytes)" $m)")
        (IFS=,; echo "${cells[*]}") >>"$csv"
        row "${cells[@]}"
    done
    slopes "$csv" 5
    rm -f "$work/ball.obj"
}

# What is measured now; tables of earlier runs in $work stand.
for name in ${5:-resolutions pixels voxels photons lights objects triangles}; do
    case $name in
    voxels) light_table voxels lit_voxels 64 128 256 512 ;;
    photons) jade 64 && light_table photons lit_photons 10000 100000 1000000 10000000 100000000 ;;
    lights) jade 64 && light_table lights lit_lights 1 4 16 64 ;;
    *) $name ;;
    esac >"$work/table.md"
    mv "$work/table.md" "$work/$name.md"
done

"$bin/mesh2vol" "$mesh" -o "$work/d.vdb" --ior 1.5 --resolution 16 --quiet --stats "$work/device.json"
cat >"$work/page.md" <<END
# What more costs

Made by \`make scale\`: $(jq -r .device.renderer "$work/device.json"), $(nproc) cores. Times are the faster of
two runs. The last row of each table is the slope between its last two rows on logarithmic axes.

![The tables below on logarithmic axes](scale.svg)

## Voxels

The bunny of 70,000 triangles as glass with a sharp boundary, $size pixels. Its surface grows by the square
of the resolution, the domain by the cube.

$(cat "$work/resolutions.md")

- *mesh2vol*: distances and their memory follow the surface; of curved facets the whole takes 1.6
  times that of flat ones (\`--smooth 0\`; the bunny at 256 voxels). Samples are counted in every voxel of a strip:
  that part, and the looking through of its bricks, follows the domain.
- *render* prepares what is near the surface. View rays leap: from one boundary to the next they take about
  as many looks as the logarithm of the way in voxels, and near it twice as many where the table of clearances
  is coarse and rows of distances are packed.

## Pixels

The same at 128 voxels.

$(cat "$work/pixels.md")

A pixel costs the same in pictures of any size. The device makes them in strips, and holds one; the host
holds the picture.

## Voxels that are lit

The bunny as jade, which scatters, under a sun of 100,000 photons.

$(cat "$work/voxels.md")

A photon adds to every voxel that it crosses and that receives, so that its time follows the resolution;
memory follows what receives, here the body's volume.

## Photons

The same at 64 voxels.

$(cat "$work/photons.md")

Photons are traced in batches of a million, so that memory does not grow beyond those.

## Lights

The same, 10,000 photons each.

$(cat "$work/lights.md")

Lights follow each other and share everything.

## Objects

Balls of glass on a lattice of four an edge, in 128 voxels, 160x120 pixels.

$(cat "$work/objects.md")

- *mesh2vol* and memory: each object has distances of its own.
- *render*: a look costs about the same however many objects there are. Looks are as many as boundaries are
  met, and light that meets one parts in two: that grows with how many balls lie behind each other, and up to
  16 of them lie in one layer.

## Triangles

One ball, at 128 voxels.

$(cat "$work/triangles.md")

A mesh is read and checked in time that follows its triangles, and so is it looked through for facets that want curving.
Distances follow the voxels near it, until a voxel has many triangles.
END
mv "$work/page.md" "$page"
