# Dye dropped into water, frame after frame: a brush that is a volume file is stamped where the drop has come to,
# and what is in the water spreads a little.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/painting.mk                  out/painting.png, six frames
#   make -f pipelines/painting.mk FRAMES=24        a longer stroke
#   make -f pipelines/painting.mk INK=9,2,0.5      another dye: its absorption at a stamp [1/unit]
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
.SECONDARY:
BIN        ?= build/bin
OUT        ?= out
FRAMES     ?= 6
INK        ?= 0.3,4,5
RESOLUTION ?= 72
SIZE       ?= 320x240
WORK       := $(OUT)/painting
VIEW       := --eye 1.1,1.3,3.4 --target 0,-0.03,0 --fov 24 --samples 4 --exposure=-0.2 --tone filmic
default: $(OUT)/painting.png
.PHONY: default

$(WORK)/tank.obj:
	@mkdir -p $(@D)
	$(BIN)/meshgen box --from=-0.6,-0.5,-0.4 --to=0.6,0.4,0.4 -o $@

$(WORK)/table.obj:
	@mkdir -p $(@D)
	$(BIN)/meshgen box --from=-1.1,-0.62,-0.8 --to=1.1,-0.52,0.8 -o $@

$(WORK)/sky.exr: pipelines/painting.mk
	@mkdir -p $(@D)
	oiiotool --pattern fill:top=0.8,0.95,1.2:bottom=0.3,0.28,0.26 256x128 3 --fill:color=4,4,4 30x24+150+20 \
	  --blur 5x5 -d float -o $@

# The brush: a drop, coverage at its rim.
$(WORK)/drop.vdb:
	@mkdir -p $(@D)
	$(BIN)/meshgen sphere --radius 0.1 --segments 64 -o - | $(BIN)/mesh2vol - -o $@ --boundary blurred --ior 1 \
	  --absorption $(INK) --scattering 2 --resolution 20 --quiet

$(WORK)/frame_0.vdb: $(WORK)/tank.obj $(WORK)/table.obj
	$(BIN)/mesh2vol $^ -o $@ --ior 1.33 --ior 1 --opacity 0 --opacity 1 --albedo 0 --albedo 0.75 \
	  --resolution $(RESOLUTION) --smooth 0 --quiet

# Where the drop goes within a frame, and how large it still is: it sinks, slows down, and swings to the sides.
STROKE = awk -v k=$(1) -v n=$(FRAMES) 'BEGIN { for (i = 1; i <= 5; ++i) { t = (k - 1 + i / 5) / n; \
  printf "--stamp $(WORK)/drop.vdb:%g,%g,%g:0,0,0:%g ", 0.3 * sin(7 * t), 0.38 - 0.7 * (1 - (1 - t) ^ 2), \
  0.15 * cos(7 * t), 1 - 0.6 * t } }'

define frame
$(WORK)/frame_$(1).vdb: $(WORK)/frame_$(shell expr $(1) - 1).vdb $(WORK)/drop.vdb
	$(BIN)/volpaint $$< -o - --object tank $$$$($(call STROKE,$(1))) | \
	  $(BIN)/volsmooth - -o $$@ --grids absorption.tank,scattering.tank --sigma 0.7
endef
NUMBERS := $(shell seq $(FRAMES))
$(foreach k,$(NUMBERS),$(eval $(call frame,$(k))))

$(WORK)/%.png: $(WORK)/%.vdb $(WORK)/sky.exr
	$(BIN)/lightsim $< -o $(WORK)/$*_lit.vdb --light directional:-0.5,-1,-0.35:3 \
	  --light directional:0.5,-1,0.9:1.2
	$(BIN)/render $(WORK)/$*_lit.vdb -o $@ $(VIEW) --size $(SIZE) --env $(WORK)/sky.exr

$(OUT)/painting.png: $(NUMBERS:%=$(WORK)/frame_%.png)
	oiiotool $^ --mosaic:pad=4 3x$$(( ($(FRAMES) + 2) / 3 )) -o $@
