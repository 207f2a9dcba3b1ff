# The small scene of the pipeline's tests and golden pictures: sourced, with the tools in PATH.
# SPDX-License-Identifier: GPL-3.0-or-later

# An L, lying in no mirror of the axes.
write_mesh() {
    cat >mesh.obj <<'END'
v 0 0 0
v 2 0 0
v 2 1 0
v 1 1 0
v 1 2.5 0
v 0 2.5 0
v 0 0 1
v 2 0 1
v 2 1 1
v 1 1 1
v 1 2.5 1
v 0 2.5 1
f 6 4 3
f 6 5 4
f 6 3 1
f 3 2 1
f 7 9 10
f 7 8 9
f 7 10 12
f 10 11 12
f 1 2 8 7
f 2 3 9 8
f 3 4 10 9
f 4 5 11 10
f 5 6 12 11
f 6 1 7 12
END
}

voxelize='--boundary blurred --ior 1.3 --resolution 40 --absorption 0.1,0.3,0.5 --scattering 2,1.5,1 --anisotropy 0.5'
light='--light directional:-1,-2,-0.7:25,25,20 --photons 60000'
dim_light='--light directional:-1,-2,-0.7:4,4,3 --photons 60000'
glance='--eye 4,3,7 --target 0.9,1.1,0.5 --fov 25 --size 96x72 --background 0.05,0.1,0.2'

# chain_by_files PICTURE: one stage after the other.
chain_by_files() {
    mesh2vol mesh.obj -o a.vdb $voxelize --quiet && volsmooth a.vdb -o b.vdb --quiet &&
        lightsim b.vdb -o c.vdb $light --quiet && render c.vdb -o "$1" $glance --quiet
}

# chain_by_pipes PICTURE: all stages at once.
chain_by_pipes() {
    mesh2vol mesh.obj -o - $voxelize --quiet | volsmooth - -o - --quiet |
        lightsim - -o - $light --quiet | render - -o "$1" $glance --quiet
}

# An opaque, diffuse one of the same shape under the same light.
chain_opaque() {
    mesh2vol mesh.obj -o a.vdb --boundary blurred --ior 1 --opacity 1 --albedo 0.9,0.5,0.2 --resolution 40 --quiet &&
        volsmooth a.vdb -o b.vdb --quiet && lightsim b.vdb -o c.vdb $dim_light --quiet &&
        render c.vdb -o "$1" $glance --quiet
}

# Clear glass with sharp boundaries beside an opaque block, in haze: reflections, shadows, caustics.
chain_sharp() {
    awk '/^v/ {print "v", -0.4 - $2, $3, $4}
         /^f/ {printf "f"; for (i = NF; i > 1; --i) printf " %s", $i; print ""}' mesh.obj >block.obj
    mesh2vol mesh.obj block.obj -o a.vdb --resolution 56 --ior 1.5 --ior 1 --opacity 0 --opacity 1 \
        --absorption 0.1,0.3,0.5 --absorption 0 --albedo 0 --albedo 0.9,0.5,0.2 \
        --medium-scattering 0.15 --quiet &&
        lightsim a.vdb -o b.vdb $dim_light --quiet &&
        render b.vdb -o "$1" --eye 2.5,3.4,7 --target -0.1,1.1,0.5 --fov 30 --size 96x72 \
            --background 0.05,0.1,0.2 --samples 2 --quiet
}
