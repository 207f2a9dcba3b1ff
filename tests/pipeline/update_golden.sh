#!/bin/bash
# Renders the golden pictures anew: update_golden.sh BUILD_FOLDER, then look at them, then commit.
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
PATH=$(cd "$1" && pwd)/bin:$PATH
here=$(cd "$(dirname "$0")" && pwd)
. "$here/chain.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
write_mesh
chain_by_files glass.exr
chain_opaque opaque.exr
chain_sharp sharp.exr
mkdir -p "$here/golden"
for picture in glass opaque sharp; do
    # Halves and no history, which names every command: the pixels are what is compared.
    oiiotool $picture.exr --ch R,G,B,A -d half --compression zip --eraseattrib 'eikonal:.*' \
        --eraseattrib 'Software|DateTime|Exif:.*|ImageHistory' --nosoftwareattrib \
        -o "$here/golden/$picture.exr"
    echo "golden/$picture.exr: $(stat -c %s "$here/golden/$picture.exr") bytes, to be looked at"
done
