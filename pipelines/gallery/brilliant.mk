# Caption: A diamond in the brilliant cut among many lamps: total reflection and fire.
# Answers: 004 section 7 (total reflection), with dispersion
# Small: RESOLUTION=64 SIZE=60x50 SAMPLES=2
# SPDX-License-Identifier: GPL-3.0-or-later
NAME := brilliant
SIZE ?= 240x200
RESOLUTION ?= 256
SAMPLES ?= 3
include pipelines/gallery/common.mk
picture: $(OUT)/brilliant.png
.PHONY: picture
$(OUT)/brilliant.png:
	$(MAKE) -f pipelines/diamond.mk BIN=$(BIN) OUT=$(MADE) SIZE=$(SIZE) RESOLUTION=$(RESOLUTION) SAMPLES=$(SAMPLES)
	cp $(MADE)/diamond.png $@
