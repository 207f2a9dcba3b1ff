# One ball of glass by render and by POV-Ray, side by side, and ten times their difference.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/povray.mk        out/povray/both.png, and what idiff says of the two
#
# Needs POV-Ray (Debian: povray) and OpenImageIO's oiiotool and idiff.
SHELL := /bin/bash
.DELETE_ON_ERROR:
.DEFAULT_GOAL := compare
BIN  ?= build/bin
OUT  ?= out
HERE := pipelines/povray
WORK := $(OUT)/povray
SIZE := 512

.PHONY: compare
compare: $(WORK)/both.png
	@idiff -a $(WORK)/eikonal.exr $(WORK)/povray.exr | grep error ; true

$(WORK)/ball.obj: $(BIN)/meshgen
	@mkdir -p $(@D)
	$< sphere --radius 0.5 --segments 512 -o $@

# Checks, so that every bend shows, and three lamps, so that mirror reflections do.
$(WORK)/environment.exr: pipelines/povray.mk
	@mkdir -p $(@D)
	oiiotool --pattern checker:width=64:height=64:color1=0.75,0.7,0.6:color2=0.1,0.16,0.28 \
	  1024x512 3 --fill:color=4,3.6,3 150x90+300+70 --fill:color=1.6,2.2,3 60x200+760+130 \
	  --fill:color=0.9,0.25,0.1 120x60+560+330 --blur 5x5 -d float -o $@

$(WORK)/ball.vdb: $(WORK)/ball.obj $(BIN)/mesh2vol
	$(BIN)/mesh2vol $< -o $@ --ior 1.5 --resolution 128

$(WORK)/eikonal.exr: $(WORK)/ball.vdb $(WORK)/environment.exr $(BIN)/render
	$(BIN)/render $< -o $(WORK)/.rgba.exr --eye 0.9,0.6,2.4 --target 0,0,0 --fov 28 \
	  --size $(SIZE)x$(SIZE) --env $(WORK)/environment.exr --stats $(WORK)/render.json
	oiiotool $(WORK)/.rgba.exr --ch R,G,B -o $@

$(WORK)/povray.exr: $(HERE)/ball.pov $(WORK)/environment.exr
	@command -v povray >/dev/null || { echo "povray.mk: POV-Ray is missing (Debian: povray)" >&2; exit 69; }
	cd $(WORK) && povray +I$(CURDIR)/$(HERE)/ball.pov +Opovray.exr +FE +W$(SIZE) +H$(SIZE) -D -A 2>povray.log \
	  || { tail povray.log >&2; exit 70; }

$(WORK)/both.png: $(WORK)/eikonal.exr $(WORK)/povray.exr
	oiiotool $(WORK)/eikonal.exr $(WORK)/povray.exr --sub --abs --mulc 10 -o $(WORK)/.difference.exr
	oiiotool $(WORK)/eikonal.exr $(WORK)/povray.exr $(WORK)/.difference.exr --mosaic:pad=4 3x1 \
	  --colorconvert linear sRGB -o $@
