# Caption: A rounded cube of three kinds of glass, which scatter what light they focus.
# Answers: 000 figure 1, right
# Small: RESOLUTION=56 SIZE=96x72 SAMPLES=1 PHOTONS=60000
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := cube
RESOLUTION ?= 160
PHOTONS    ?= 1000000
SIZE       ?= 480x360
include pipelines/gallery/common.mk

# The cube, and in it a slab and a ball of other glass, which rule there as the later ones.
MESHES         := $(MADE)/cube.obj $(MADE)/slab.obj $(MADE)/ball.obj
VOLUME_OPTIONS  = --ior 1.45 --ior 1.6 --ior 1.75 --absorption 0.5,0.16,0.06 --absorption 0.06,0.4,1.4 \
                  --absorption 1.3,0.2,0.5 --scattering 0.12 --scattering 0.2 --scattering 0.3 --anisotropy 0.5 \
                  --resolution $(RESOLUTION) --ground '-1.03:0.5,0.48,0.45' --ground-margin 1.3
SMOOTH         := off
LIGHT_OPTIONS  ?= --light directional:0.5,-0.9,-0.45:4.2,4,3.7 --photons $(PHOTONS) --surface-detail 1 --max-depth 8
VIEW_OPTIONS    = --eye 3.4,2.5,5.6 --target 0.05,-0.22,0 --fov 28 --size $(SIZE) --samples $(SAMPLES) --env $(ROOM)
VIEW_FILES      = $(ROOM)
include pipelines/chain.mk

$(MADE)/cube.obj: | $(WORK)
	$(MESHGEN) implicit rounded-cube --round 0.3 -o $@
$(MADE)/slab.obj: | $(WORK)
	$(MESHGEN) implicit rounded-cube --round 0.4 --place 0.28,-0.3,0.1:0,25,0:0.62 -o $@
$(MADE)/ball.obj: | $(WORK)
	$(MESHGEN) sphere --place=-0.35,0.38,-0.2:0,0,0:0.46 -o $@
