# A wine glass with a wall of 1 mm at 1024 voxels: its picture, the same by POV-Ray, and its rays held
# against those through the exact surface.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/wineglass.mk picture    out/wineglass.png, in some two minutes on two cores
#   make -f pipelines/wineglass.mk rays       how far render's rays are from the exact ones
#   make -f pipelines/wineglass.mk compare    out/wineglass/both.png, and what idiff says of the two
#   make -f pipelines/wineglass.mk            all three; without POV-Ray the first two
#
# Needs OpenImageIO's oiiotool and idiff; for `compare` POV-Ray (Debian: povray).
SHELL := /bin/bash
.DELETE_ON_ERROR:
.DEFAULT_GOAL := all
BUILD ?= build
BIN   ?= $(BUILD)/bin
OUT   ?= out
HERE  := pipelines/wineglass
WORK  := $(OUT)/wineglass
RESOLUTION ?= 1024
# As in glass.pov.
SIZE  := 480x640
VIEW  := --eye=-150,95,-420 --target 0,60,0 --fov 17

.PHONY: all picture rays compare
all: picture rays $(if $(shell command -v povray),compare,without)
picture: $(OUT)/wineglass.png

.PHONY: without
without:
	@echo "wineglass.mk: no POV-Ray to compare with (Debian: povray)"

rays: $(WORK)/rays.txt
	@cat $<

compare: $(WORK)/both.png
	@idiff -a $(WORK)/eikonal.exr $(WORK)/povray.exr | grep error ; true

$(WORK)/profile.txt: $(HERE)/profile.awk
	@mkdir -p $(@D)
	awk -f $< >$@

$(WORK)/glass.obj: $(HERE)/mesh.awk $(WORK)/profile.txt
	awk -f $^ >$@

# A bright backdrop behind a table's edge, a window to the left, a strip light to the right, and two
# windows behind the viewer.
$(WORK)/environment.exr: pipelines/wineglass.mk
	@mkdir -p $(@D)
	oiiotool --pattern fill:top=0.05,0.06,0.08:bottom=0.02,0.016,0.012 1024x512 3 \
	  --fill:color=1,1.05,1.1 230x120+345+110 --blur 91x91 \
	  --fill:color=0.1,0.06,0.035 1024x256+0+268 --blur 9x9 \
	  --fill:color=0.5,0.34,0.22 260x34+330+272 --blur 31x31 \
	  --fill:color=9,8.6,8 46x150+640+140 --fill:color=5,5.5,6.5 60x110+200+120 \
	  --fill:color=6,6,6 60x60+930+120 --fill:color=6,6,6 60x60+0+120 \
	  --fill:color=2.5,2.5,2.6 200x50+400+10 --blur 5x5 -d float -o $@

$(WORK)/glass.vdb: $(WORK)/glass.obj $(BIN)/mesh2vol
	$(BIN)/mesh2vol $< -o $@ --ior 1.5 --resolution $(RESOLUTION) --stats $(WORK)/mesh2vol.json

$(WORK)/aovs.exr: $(WORK)/glass.vdb $(WORK)/environment.exr $(BIN)/render
	$(BIN)/render $< -o $@ $(VIEW) --size $(SIZE) --env $(WORK)/environment.exr \
	  --aov exit_position,exit_direction --stats $(WORK)/render.json

$(OUT)/wineglass.png: $(WORK)/glass.vdb $(WORK)/environment.exr $(BIN)/render
	$(BIN)/render $< -o $@ $(VIEW) --size $(SIZE) --env $(WORK)/environment.exr --samples 4 \
	  --tone filmic --exposure=0.3

.PHONY: FORCE
$(BUILD)/tests/wineglass: FORCE
	@cmake --build $(BUILD) --target wineglass >/dev/null

$(WORK)/rays.txt: $(WORK)/aovs.exr $(WORK)/profile.txt | $(BUILD)/tests/wineglass
	voxel=$$(vdb_print -l $(WORK)/glass.vdb | awk '/voxel size:/ { print $$3; exit }'); \
	$(BUILD)/tests/wineglass $(WORK)/profile.txt $< $(VIEW) --voxel $$voxel >$@

$(WORK)/eikonal.exr: $(WORK)/aovs.exr
	oiiotool $< --ch R,G,B -o $@

$(WORK)/povray.exr: $(HERE)/glass.pov $(WORK)/environment.exr $(WORK)/glass.inc
	@command -v povray >/dev/null || { echo "wineglass.mk: POV-Ray is missing (Debian: povray)" >&2; exit 69; }
	cd $(WORK) && povray +I$(CURDIR)/$(HERE)/glass.pov +Opovray.exr +FE \
	  +W$(firstword $(subst x, ,$(SIZE))) +H$(lastword $(subst x, ,$(SIZE))) -D -A 2>povray.log \
	  || { tail povray.log >&2; exit 70; }

$(WORK)/glass.inc: $(HERE)/lathe.awk $(WORK)/profile.txt
	awk -f $^ >$@

$(WORK)/both.png: $(WORK)/eikonal.exr $(WORK)/povray.exr
	oiiotool $(WORK)/eikonal.exr $(WORK)/povray.exr --sub --abs --mulc 10 -o $(WORK)/.difference.exr
	oiiotool $(WORK)/eikonal.exr $(WORK)/povray.exr $(WORK)/.difference.exr --mosaic:pad=4 3x1 \
	  --colorconvert linear sRGB -o $@
