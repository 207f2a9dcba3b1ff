#!/usr/bin/env bash
# Installs the Debian packages listed in a file that are not there yet, and says so.
# Without apt it names the commands and headers that are missing and fails if there are any.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
list=${1:?usage: install_packages.sh packages.txt}
mapfile -t packages < <(sed 's/#.*//' "$list" | awk 'NF {print $1}')

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    missing=()
    for command in g++ cmake ninja pkg-config jq oiiotool vdb_print; do
        command -v "$command" >/dev/null || missing+=("$command")
    done
    for header in openvdb/openvdb.h OpenEXR/ImfHeader.h OpenImageIO/imageio.h CGAL/version.h \
                  EGL/egl.h epoxy/gl.h glm/glm.hpp freetype2/ft2build.h CLI/CLI.hpp nlohmann/json.hpp gtest/gtest.h; do
        found=no
        for folder in ${CPATH//:/ } /usr/include /usr/local/include; do
            [ -e "$folder/$header" ] && found=yes
        done
        [ $found = yes ] || missing+=("$header")
    done
    [ ${#missing[@]} -eq 0 ] && exit 0
    echo "This machine has no apt-get. Missing here: ${missing[*]}" >&2
    echo "The Debian names of all packages needed are in $list." >&2
    exit 69
fi

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

run=()
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "Not installed: ${missing[*]}" >&2
        echo "Neither root nor sudo: ask who may to run: apt-get install ${missing[*]}" >&2
        exit 69
    fi
    run=(sudo)
fi
echo "Installing: ${missing[*]}"
"${run[@]}" apt-get update -qq
"${run[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
