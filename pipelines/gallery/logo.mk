# Caption: A block of glass with letters of denser, coloured glass in it.
# Answers: 000 figure 8, left
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := logo
RESOLUTION ?= 256
SIZE       ?= 480x320
include pipelines/gallery/common.mk

MESHES         := $(MADE)/block.obj $(MADE)/letters.obj
VOLUME_OPTIONS  = --ior 1.5 --ior 1.62 --absorption 0.05,0.02,0.03 --absorption 2.6,0.5,0.1 \
                  --resolution $(RESOLUTION) --ground '0:0.5,0.47,0.42'
SMOOTH         := off
LIGHT_OPTIONS  ?= --light directional:-0.5,-0.8,-0.55:3.4,3.3,3.1 --surface-detail 3
VIEW_OPTIONS    = --eye=-2.3,2.9,6.6 --target 0,0.62,0 --fov 26 --size $(SIZE) --samples $(SAMPLES) --env $(ROOM)
VIEW_FILES      = $(ROOM)
include pipelines/chain.mk

$(MADE)/block.obj: | $(WORK)
	$(MESHGEN) box --from=-1.9,0.001,-0.45 --to 1.9,1.3,0.45 -o $@
$(MADE)/letters.obj: | $(WORK)
	$(MESHGEN) logo eikonal --height 0.62 --depth 0.3 --place=-1.55,0.36,0 -o $@
