# The demo's mesh, materials and surroundings, shared by the picture and the animation.
# SPDX-License-Identifier: GPL-3.0-or-later
DATA       ?= data
RESOLUTION ?= 128
BUNNY := $(DATA)/bunny.off

# Amber glass in thin haze: what is behind the bunny is bent, dimmed by length and colour, and its
# shadow and caustics show in the air.
BUNNY_VOLUME := --ior 1.4 --absorption 0.25,0.9,1.5 --medium-scattering 0.2 \
                --bounds=-0.95,-1.0,-0.5,0.95,0.6,0.5 --resolution $(RESOLUTION)
BUNNY_VIEW   := --eye 0.1,0.25,3.4 --target 0.02,-0.2,0 --fov 22.5 --tone filmic --exposure=0.2
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
