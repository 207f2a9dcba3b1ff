# The surface of a fluid as a sequence: a drop falls into a pool, a mesh and a volume a frame, the pool's floor
# lit through the waves. Another sequence's level sets come in by sim2vol --sdf-from.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -j2 -f pipelines/splash.mk               out/splash.png, six frames
#   make -j2 -f pipelines/splash.mk TIMES='0.2 0.25 0.3'
SHELL := /bin/bash
.DELETE_ON_ERROR:
.SECONDARY:
BIN        ?= build/bin
OUT        ?= out
TIMES      ?= 0.10 0.24 0.30 0.45 0.60 0.75
RESOLUTION ?= 112
SIZE       ?= 320x240
WORK       := $(OUT)/splash
VIEW       := --eye 0.9,2.1,3.2 --target 0,0.05,0 --fov 26 --samples 4
default: $(OUT)/splash.png
.PHONY: default

$(WORK)/%.obj:
	@mkdir -p $(@D)
	$(BIN)/meshgen implicit splash --time $* --resolution 160 -o $@

$(WORK)/floor.obj:
	@mkdir -p $(@D)
	$(BIN)/meshgen box --from=-1.2,-0.7,-1.2 --to=1.2,-0.5,1.2 -o $@

$(WORK)/sky.exr: pipelines/splash.mk
	@mkdir -p $(@D)
	oiiotool --pattern fill:top=0.6,0.8,1.1:bottom=0.3,0.3,0.3 256x128 3 --fill:color=4,4,4 30x24+150+20 \
	  --blur 5x5 -d float -o $@

# The domain's faces cut the pool open, and do not refract; where the floor is, the later object, water gives way.
$(WORK)/%.png: $(WORK)/%.obj $(WORK)/floor.obj $(WORK)/sky.exr
	$(BIN)/mesh2vol $(WORK)/$*.obj $(WORK)/floor.obj -o $(WORK)/$*.vdb --ior 1.33 --ior 1 --opacity 0 --opacity 1 \
	  --albedo 0 --albedo 0.75,0.82,0.85 --absorption 0.8,0.2,0.1 --absorption 0 --resolution $(RESOLUTION) \
	  --bounds=-0.9,-0.56,-0.9,0.9,1.0,0.9 --quiet
	$(BIN)/lightsim $(WORK)/$*.vdb -o $(WORK)/$*_lit.vdb --light directional:-0.3,-1,-0.2:3
	$(BIN)/render $(WORK)/$*_lit.vdb -o $@ $(VIEW) --size $(SIZE) --env $(WORK)/sky.exr

$(OUT)/splash.png: $(TIMES:%=$(WORK)/%.png)
	oiiotool $^ --mosaic:pad=4 3x$$(( ($(words $(TIMES)) + 2) / 3 )) -o $@
