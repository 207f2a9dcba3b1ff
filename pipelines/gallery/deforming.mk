# Caption: Bodies that deform: in image space (upper rows) beside the same frames through volumes.
# Answers: 003 figure 9, 002
# Needs: data/bunny.off
# Small: RESOLUTION=40 FRAMES=2 SIZE=64x64
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := deforming
RESOLUTION ?= 96
FRAMES     ?= 5
SIZE       ?= 120x120
include pipelines/gallery/common.mk
picture: $(OUT)/deforming.png
.PHONY: picture
$(OUT)/deforming.png:
	$(MAKE) -f pipelines/animation.mk BIN=$(BIN) OUT=$(MADE) DATA=$(DATA) SIZE=$(SIZE) RESOLUTION=$(RESOLUTION) FRAMES=$(FRAMES)
	cp $(MADE)/animation/contact.png $@
