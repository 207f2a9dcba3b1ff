#!/usr/bin/env bash
# A contact sheet of the gallery, as HTML: sheet.sh FOLDER NAME... . Or as a page with small pictures beside it:
# sheet.sh --page PAGE.md PICTURES FOLDER NAME...
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
here=$(dirname "$0")
of() { sed -n "s/^# $2: //p" "$here/$1.mk"; }             # of PICTURE WHAT
commands() {                                              # that made a picture, without folders
    sed -E ':a; /\\$/ { N; s/ *\\\n[ \t]*/ /; ba }' "$1" | # whole lines
        sed -n -E '/bin\/(meshgen|mesh2vol|volsmooth|volpaint|sim2vol|lightsim|render) /p' |
        sed -E 's#[^ ]*bin/(meshgen|mesh2vol|volsmooth|volpaint|sim2vol|lightsim|render) #\1 #g; s#  +# #g'
}
escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
if [ "$1" = --page ]; then
    page=$2 pictures=$3 folder=$4
    shift 4
    mkdir -p "$pictures"
    {
        echo "# Gallery"
        echo
        echo "Each picture by \`make -f pipelines/gallery/NAME.mk\`, all of them and a contact sheet by \`make gallery\`. Seconds are of"
        echo "processors, summed over all stages, without a GPU (Mesa's llvmpipe), from meshes to the picture: two cores take"
        echo "half as long."
        for name in "$@"; do
            oiiotool "$folder/$name.png" --ch R,G,B --resize 480x0 -d uint8 --quality 88 -o "$pictures/$name.jpg"
            printf '\n## %s\n\n![%s](gallery/%s.jpg)\n\n%s Answers %s. %s s: `make -f pipelines/gallery/%s.mk`.\n' "$name" \
                "$(of "$name" Caption)" "$name" "$(of "$name" Caption)" "$(of "$name" Answers)" "$(<"$folder/$name.seconds")" "$name"
        done
        others=
        for recipe in "$here"/*.mk; do
            name=$(basename "$recipe" .mk)
            [[ $name == common || " $* " == *" $name "* ]] || others+=" \`$name\`"
        done
        [ -z "$others" ] || printf '\nMore recipes, not shown here:%s.\n' "$others"
    } >"$page"
    exit
fi
folder=$1
shift
cat <<'END'
<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Eikonal: gallery</title>
<style>
body { font: 15px/1.5 sans-serif; margin: 2em; background: #16181b; color: #ddd }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(480px, 1fr)); gap: 2em }
img { width: 100%; height: auto; display: block } pre { white-space: pre-wrap; font-size: 12px; color: #aaa }
h2 { font-size: 16px; margin: .6em 0 0 } p { margin: .2em 0 }
</style>
<h1>Gallery</h1><main>
END
for name in "$@"; do
    printf '<article><img src="%s.png" alt="%s"><h2>%s</h2><p>Answers %s. %s s of processors.</p><details><summary>Commands</summary><pre>%s</pre></details></article>\n' \
        "$name" "$(of "$name" Caption | escaped)" "$(of "$name" Caption | escaped)" "$(of "$name" Answers | escaped)" \
        "$(<"$folder/$name.seconds")" "$(commands "$folder/$name.log" | escaped)"
done
echo '</main></html>'
