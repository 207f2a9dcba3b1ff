#!/bin/bash
# What finer voxels and more pixels cost: scale.sh BIN MESH WORK PAGE.md. Each run is made twice, the
# faster one counts.
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

"$bin/mesh2vol" "$mesh" -o "$work/d.vdb" --ior 1.5 --resolution 16 --quiet --stats "$work/device.json"
{
    cat <<END
# What more costs

Made by \`make scale\`: $(jq -r .device.renderer "$work/device.json"), $(nproc) cores. Times are the faster of
two runs. The last row of each table is the slope between its last two rows on logarithmic axes.

## Voxels

The bunny of 70,000 triangles as glass with a sharp boundary, $size pixels. Its surface grows by the square
of the resolution, the domain by the cube.

END
    resolutions
    cat <<END

- *mesh2vol*: distances and their memory follow the surface. Samples are counted in every voxel of a strip,
  on the device: that part, and the looking through of its bricks, follows the domain.
- *render* prepares what is near the surface. View rays leap: from one boundary to the next they take about
  as many looks as the logarithm of the way in voxels, and near it twice as many where the table of clearances
  is coarse and rows of distances are packed.

## Pixels

The same at 128 voxels.

END
    pixels
    cat <<END

A pixel costs the same in pictures of any size. The device makes them in strips, and holds one; the host
holds the picture.
END
} >"$work/page.md"
mv "$work/page.md" "$page"
