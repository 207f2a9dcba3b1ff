# Caption: White light through a slit and prisms of flint and of crown glass, in smoke and on a wall.
# Answers: 000 section 3 (dispersion, which the source leaves out)
# Small: SIZE=120x68 WALL=4 SMOKE=2 GLASSES=sf10
# SPDX-License-Identifier: GPL-3.0-or-later
NAME := prism
SIZE ?= 480x272
WALL ?= 16
include pipelines/gallery/common.mk
picture: $(OUT)/prism.png
.PHONY: picture
$(OUT)/prism.png:
	$(MAKE) -f pipelines/rainbow.mk BIN=$(BIN) OUT=$(MADE) SIZE=$(SIZE) WALL=$(WALL)
	cp $(MADE)/rainbow.png $@
