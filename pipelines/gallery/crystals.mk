# Caption: Calcite doubles a page, tourmaline is dark along one axis, quartz and a compressed disc show interference colours.
# Answers: 004 appendix A, which its author left as theory
# Small: SAMPLES=1 WIDTH=160 STRESS_SIZE=32x32
# SPDX-License-Identifier: GPL-3.0-or-later
NAME := crystals
WIDTH ?= 480
STRESS_SIZE ?= 160x160
include pipelines/gallery/common.mk
picture: $(OUT)/crystals.png
.PHONY: picture
$(OUT)/crystals.png:
	$(MAKE) -f pipelines/crystals.mk BIN=$(BIN) OUT=$(MADE) SAMPLES=$(SAMPLES) \
	  STRESS_SIZE=$(STRESS_SIZE) STRESS_SAMPLES=1
	for name in rhomb tourmaline wedge stress; do oiiotool $(MADE)/crystals/$$name.png --ch R,G,B \
	  --resize $(WIDTH)x0 -o $(MADE)/$$name.png || exit 1; done
	oiiotool $(MADE)/stress.png $(MADE)/wedge.png $(MADE)/tourmaline.png $(MADE)/rhomb.png \
	  --create $(WIDTH)x$$(($(WIDTH) * 71 / 40)) 3 --paste +0+0 --paste +0+$$(($(WIDTH) / 4)) \
	  --paste +0+$$(($(WIDTH) * 7 / 8)) --paste +0+$$(($(WIDTH) * 51 / 40)) -d uint8 -o $@
