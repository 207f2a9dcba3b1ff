# The demo's mesh, materials and surroundings, shared by the picture and the animation.
# SPDX-License-Identifier: GPL-3.0-or-later
DATA       ?= data
RESOLUTION ?= 160
BUNNY  := $(DATA)/bunny.off
PLINTH := $(OUT)/plinth.obj

# Amber glass on a pale plinth: what is behind the bunny is bent, mirrored and dimmed by length and
# colour, and its shadow is full of caustics. The bunny stands 0.003 deep in the plinth, which rules
# there as the later of the two.
BUNNY_VOLUME := --ior 1.45 --ior 1 --absorption 0.2,0.9,1.9 --absorption 0 --opacity 0 --opacity 1 \
                --albedo 0 --albedo 0.6,0.57,0.53 --bounds=-1,-0.6,-0.68,1,0.55,0.68 \
                --resolution $(RESOLUTION)
BUNNY_VIEW   := --eye 0.7,1.2,3.4 --target 0.04,-0.11,0 --fov 22.5 --tone filmic --exposure=0.5
STUDIO       := $(OUT)/studio.exr

# The 75,408-triangle Stanford bunny of Debian's CGAL demos. Slim images drop /usr/share/doc on
# installation, so the package itself is unpacked.
$(BUNNY):
	@mkdir -p $(DATA)/package
	cd $(DATA)/package && chmod a+rwx . && \
	  { ls libcgal-demo_*.deb >/dev/null 2>&1 || apt-get download -qq libcgal-demo; }
	dpkg-deb --fsys-tarfile $(DATA)/package/libcgal-demo_*.deb \
	  | tar -xO ./usr/share/doc/libcgal-dev/data.tar.gz \
	  | tar -xzO data/meshes/bunny00.off >$@.new
	mv $@.new $@
	rm -r $(DATA)/package

# A dark studio: a soft box above, a strip light at the side, a faint horizon.
$(STUDIO):
	@mkdir -p $(@D)
	oiiotool --pattern fill:top=0.012,0.016,0.024:bottom=0.002,0.002,0.003 512x256 3 \
	  --fill:color=3.0,2.8,2.5 80x40+150+30 --fill:color=1.2,1.5,2.0 30x110+350+60 \
	  --fill:color=0.035,0.03,0.025 512x40+0+140 --blur 7x7 -d float -o $(@D)/.studio.exr
	mv $(@D)/.studio.exr $@

# A slab, 0.07 high, whose edges are as round as its voxels can show.
$(PLINTH): pipelines/bunny_scene.mk
	@mkdir -p $(@D)
	$(BIN)/meshgen box --from=-0.95,-0.56,-0.62 --to 0.95,-0.49,0.62 --bevel 0.03 -o $@
