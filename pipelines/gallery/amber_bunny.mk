# Caption: An amber bunny with black embeddings in a case of smoke, in which it focuses light.
# Answers: 000 figure 1, middle
# Needs: data/bunny.off
# Small: RESOLUTION=64 SIZE=96x72 SAMPLES=1 PHOTONS=100000
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := amber_bunny
RESOLUTION ?= 192
PHOTONS    ?= 1500000
SIZE       ?= 480x360
include pipelines/gallery/common.mk
include pipelines/bunny_scene.mk

MESHES         := $(BUNNY) $(MADE)/flecks.obj $(PLINTH)
VOLUME_OPTIONS  = --ior 1.5 --ior 1 --ior 1 --absorption 0.35,1.4,3.6 --absorption 0 --absorption 0 --scattering 0.5,0.35,0.2 \
                  --scattering 0 --scattering 0 --anisotropy 0.4 --opacity 0 --opacity 1 --opacity 1 --albedo 0 --albedo 0.02 \
                  --albedo 0.5,0.48,0.45 --medium-scattering 0.22 --medium-anisotropy 0.4 \
                  --bounds=-1,-0.6,-0.68,1,0.75,0.68 --resolution $(RESOLUTION)
SMOOTH         := off
LIGHT_OPTIONS  ?= --light directional:0.75,-0.85,-0.1:5,4.8,4.5 --photons $(PHOTONS)
VIEW_OPTIONS    = --eye 0.9,1.0,3.6 --target 0.03,-0.02,0 --fov 23 --size $(SIZE) --samples $(SAMPLES) --env $(STUDIO) \
                  --tone filmic
VIEW_FILES      = $(STUDIO)
include pipelines/chain.mk

$(MADE)/flecks.obj: $(BUNNY) | $(WORK)
	$(MESHGEN) flecks $< --count 40 --radius 0.035 --seed 7 -o $@
