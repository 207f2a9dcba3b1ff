# Caption: The surface of a fluid as a sequence: a drop falls into a pool, whose floor is lit through the waves.
# Answers: 003 figure 1
# Small: RESOLUTION=48 SIZE=80x60 'TIMES=0.24 0.45'
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := fluid
RESOLUTION ?= 96
TIMES      ?= 0.10 0.24 0.30 0.45 0.60 0.75
SIZE       ?= 240x180
include pipelines/gallery/common.mk
picture: $(OUT)/fluid.png
.PHONY: picture
$(OUT)/fluid.png:
	$(MAKE) -f pipelines/splash.mk BIN=$(BIN) OUT=$(MADE) SIZE=$(SIZE) RESOLUTION=$(RESOLUTION) TIMES='$(TIMES)'
	cp $(MADE)/splash.png $@
