# Caption: Dye dropped into water: a brush that is a volume file, stamped frame after frame.
# Answers: 003 figure 8
# Small: RESOLUTION=32 FRAMES=2 SIZE=80x60
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := painting
RESOLUTION ?= 72
FRAMES     ?= 6
SIZE       ?= 240x180
include pipelines/gallery/common.mk
picture: $(OUT)/painting.png
.PHONY: picture
$(OUT)/painting.png:
	$(MAKE) -f pipelines/painting.mk BIN=$(BIN) OUT=$(MADE) SIZE=$(SIZE) RESOLUTION=$(RESOLUTION) FRAMES=$(FRAMES)
	cp $(MADE)/painting.png $@
