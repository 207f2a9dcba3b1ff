#!/usr/bin/env bash
# Gathers the tools and the libraries they need, so that they run on another Linux machine of the
# same processor with its own graphics driver: bundle.sh BUILD FOLDER
# The C library and what belongs to the driver (libEGL, libGL and theirs) stay the machine's own.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
build=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder/bin" "$folder/lib/eikonal" "$folder/libexec"
cp "$build/lib/eikonal/libeikonal_oiio.so" "$folder/lib/eikonal/"
programs=()
for program in meshgen mesh2vol sim2vol volpaint volsmooth lightsim render; do
    cp "$build/bin/$program" "$folder/libexec/"
    programs+=("$folder/libexec/$program")
    cat >"$folder/bin/$program" <<'RUN'
#!/bin/sh
here=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)
export LD_LIBRARY_PATH="$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
export EIKONAL_MODULES="${EIKONAL_MODULES:-$here/lib/eikonal}"
exec "$here/libexec/$(basename -- "$0")" "$@"
RUN
    chmod +x "$folder/bin/$program"
done
ldd "${programs[@]}" "$folder/lib/eikonal/libeikonal_oiio.so" | awk '/=> \// {print $3}' | sort -u |
    grep -Ev '/(libc|libm|libdl|libpthread|librt|ld-linux[^/]*|libEGL|libGL|libGLX|libGLdispatch|libOpenGL|libGLESv2)\.so' |
    xargs -I{} cp -L {} "$folder/lib/"
tar -C "$(dirname "$folder")" -czf "$folder.tar.gz" "$(basename "$folder")"
du -sh "$folder.tar.gz"
