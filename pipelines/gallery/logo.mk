# Caption: A block of glass with letters of denser, coloured glass in it.
# Answers: 000 figure 8, left
# Small: RESOLUTION=96 SIZE=96x64 SAMPLES=1
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := logo
RESOLUTION ?= 224
SIZE       ?= 480x320
include pipelines/gallery/common.mk

MESHES         := $(MADE)/block.obj $(MADE)/letters.obj
VOLUME_OPTIONS  = --ior 1.5 --ior 1.62 --absorption 0.05,0.02,0.03 --absorption 2.6,0.5,0.1 \
                  --resolution $(RESOLUTION) --ground '0:0.5,0.47,0.42' --ground-margin 1.1
SMOOTH         := off
LIGHT_OPTIONS  ?= --light directional:-0.5,-0.8,-0.55:3.4,3.3,3.1 --surface-detail 1 --max-depth 6
VIEW_OPTIONS    = --eye 0.8,1.9,7 --target 0,0.5,0 --fov 28 --size $(SIZE) --samples $(SAMPLES) --env $(ROOM)
VIEW_FILES      = $(ROOM)
include pipelines/chain.mk

$(MADE)/block.obj: | $(WORK)
	$(MESHGEN) box --from=-1.9,0.001,-0.45 --to 1.9,1.3,0.45 -o $@
$(MADE)/letters.obj: | $(WORK)
	$(MESHGEN) logo eikonal --height 0.6 --depth 0.34 --place=0,0.36,0 -o $@
