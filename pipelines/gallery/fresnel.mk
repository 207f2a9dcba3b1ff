# Caption: A sphere of black glass: what is left is Fresnel's reflection, more of it at grazing angles.
# Answers: 004 figure 3.4
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := fresnel
RESOLUTION ?= 96
SIZE       ?= 480x360
include pipelines/gallery/common.mk

MESHES         := $(MADE)/sphere.obj
VOLUME_OPTIONS  = --ior 1.5 --absorption 20 --resolution $(RESOLUTION)
SMOOTH         := off
LIGHT_OPTIONS  ?= --light directional:0,-1,0
VIEW_OPTIONS    = --eye 0,0.3,4.6 --target 0,0,0 --fov 34 --size $(SIZE) --samples $(SAMPLES) --env $(VIEW_FILES) \
                  --env-rotate 200 --tone filmic --exposure=-0.3
VIEW_FILES     := $(DATA)/courtyard.exr
include pipelines/chain.mk

$(MADE)/sphere.obj: | $(WORK)
	$(MESHGEN) sphere -o $@
