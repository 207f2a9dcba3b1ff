# Caption: A sphere of coloured glass with a core that glows, in captured surroundings.
# Answers: 000 figure 8, middle
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := emissive
RESOLUTION ?= 128
SIZE       ?= 480x360
include pipelines/gallery/common.mk

MESHES         := $(MADE)/sphere.obj $(MADE)/core.obj
VOLUME_OPTIONS  = --ior 1.45 --absorption 0.35,0.1,0.04 --absorption 0.35,0.1,0.04 --emission 0 --emission 0.5,1.1,0.15 \
                  --resolution $(RESOLUTION)
SMOOTH         := off
LIGHT_OPTIONS  ?= --light directional:0.5,-0.8,-0.3
VIEW_OPTIONS    = --eye 0,0.45,4.6 --target 0,0,0 --fov 34 --size $(SIZE) --samples $(SAMPLES) --env $(VIEW_FILES) \
                  --env-rotate 30 --tone filmic --exposure=-0.3
VIEW_FILES     := $(DATA)/courtyard.exr
include pipelines/chain.mk

$(MADE)/sphere.obj: | $(WORK)
	$(MESHGEN) sphere -o $@
$(MADE)/core.obj: | $(WORK)
	$(MESHGEN) implicit metaballs --count 14 --seed 3 --place 0,0,0:0,0,0:0.55 -o $@
