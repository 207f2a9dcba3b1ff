# A diamond in the standard brilliant cut among many lamps: what it mirrors within is split into colours, its fire.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/diamond.mk                        out/diamond.png
#   make -f pipelines/diamond.mk MATERIAL=zircon        another stone; what docs/materials.md has a name for
#   make -f pipelines/diamond.mk CUT='--crown 30'       another cut: see meshgen brilliant --help
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
BIN        ?= build/bin
OUT        ?= out
MATERIAL   ?= diamond
CUT        ?=
RESOLUTION ?= 384
SIZE       ?= 300x250
SAMPLES    ?= 12
WORK       := $(OUT)/diamond
VIEW       := --eye 0.3,2.6,3.2 --target 0,0.5,0 --fov 34 --max-depth 24 --exposure=-0.6 --tone filmic
default: $(OUT)/diamond.png
.PHONY: default

$(WORK)/stone.obj:
	@mkdir -p $(@D)
	$(BIN)/meshgen brilliant $(CUT) -o $@

# Lamps where a golden spiral puts them above the horizon, and a window.
$(WORK)/lamps.exr: pipelines/diamond.mk
	@mkdir -p $(@D)
	oiiotool --pattern constant:color=0.03,0.035,0.045 1024x512 3 --fill:color=1,1,1.05 300x90+360+40 \
	  $$(awk 'BEGIN { for (k = 0; k < 40; ++k) { turns = k * 0.618034; x = int(1000 * (turns - int(turns))); \
	    edge = 10 + 4 * (k % 4); printf "--fill:color=9,9,9 %dx%d+%d+%d ", edge, edge, x, 15 + 5.5 * k } }') \
	  -d half -o $@

$(WORK)/stone.vdb: $(WORK)/stone.obj
	$(BIN)/mesh2vol $< -o $@ --material $(MATERIAL) --smooth 0 --resolution $(RESOLUTION)

$(OUT)/diamond.png: $(WORK)/stone.vdb $(WORK)/lamps.exr
	$(BIN)/render $< -o $@ --env $(WORK)/lamps.exr $(VIEW) --size $(SIZE) --samples $(SAMPLES)
