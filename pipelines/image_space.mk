# Refraction in image space beside exact rays: a row of methods and a row of differences for each mesh.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/image_space.mk                     out/image_space.png
#   make -f pipelines/image_space.mk IOR=1.5 LAYERS=6
#   make -f pipelines/image_space.mk out/image_space/plate.png   a board behind a ball, refracted
#
# Columns: sir, isr, dir, dir with layers, exact rays. Below each what it is off the exact ones, with 0.5 for
# nothing. Of layers and rays reflections are followed as of the others, that is, at the first interface alone
# where they are bright: --cutoff.
SHELL := /bin/bash
.DELETE_ON_ERROR:
OUT    ?= out
BIN    ?= build/bin
SIZE   ?= 200x200
IOR    ?= 1.2
LAYERS ?= 4
CUTOFF ?= 0.05
WORK   := $(OUT)/image_space
HERE   := pipelines
default: $(OUT)/image_space.png
.PHONY: default
include $(HERE)/bunny_scene.mk
include $(HERE)/models.mk
.DEFAULT_GOAL := default

SKY := $(WORK)/sky.exr
MESHES_SHOWN := armadillo refined_elephant bunny
VIEW_armadillo        := --eye 94,50,-458 --target 0,19,0 --fov 20
VIEW_refined_elephant := --eye 2.35,0.2,1.38 --target 0,0,0 --fov 23
VIEW_bunny            := --eye 0.5,0.35,3.6 --target 0,0,0 --fov 17.5
METHODS     := sir isr dir layers rays
ARGS_sir    := --method sir
ARGS_isr    := --method isr
ARGS_dir    := --method dir
ARGS_layers := --method dir --layers $(LAYERS) --cutoff $(CUTOFF)
ARGS_rays   := --method rays --cutoff $(CUTOFF)

$(WORK):
	@mkdir -p $@

# A sky over a chequered floor, soft, so that pictures differ by where rays go and not by edges that they just miss.
$(SKY): $(HERE)/image_space.mk | $(WORK)
	oiiotool --pattern fill:top=0.15,0.3,0.7:bottom=0.9,0.9,0.95 512x128 3 \
	  --pattern checker:width=16:height=16:color1=0.75,0.62,0.45:color2=0.1,0.16,0.2 512x128 3 \
	  --create 512x256 3 --swap --paste +0+128 --swap --paste +0+0 \
	  --fill:color=3,2.7,2 48x32+330+30 --blur 5x5 -d float -o $@

define picture
$(WORK)/$(1)_$(2).exr: $(DATA)/$(1).off $(SKY) $(HERE)/image_space.mk
	$(BIN)/render $$< -o $$@ --ior $(IOR) --env $(SKY) $(VIEW_$(1)) --size $(SIZE) $(ARGS_$(2))
$(WORK)/$(1)_$(2)_off.exr: $(WORK)/$(1)_$(2).exr $(WORK)/$(1)_rays.exr
	oiiotool $$< $(WORK)/$(1)_rays.exr --sub --addc 0.5 --ch R,G,B -o $$@
$(WORK)/$(1)_$(2)_rgb.exr: $(WORK)/$(1)_$(2).exr
	oiiotool $$< --ch R,G,B -o $$@
endef
$(foreach mesh,$(MESHES_SHOWN),$(foreach method,$(METHODS),$(eval $(call picture,$(mesh),$(method)))))

SHOWN := $(foreach mesh,$(MESHES_SHOWN),$(METHODS:%=$(WORK)/$(mesh)_%_rgb.exr) $(METHODS:%=$(WORK)/$(mesh)_%_off.exr))
$(OUT)/image_space.png: $(SHOWN)
	oiiotool $(SHOWN) --mosaic 5x$(words $(MESHES_SHOWN) $(MESHES_SHOWN)) --colorconvert linear sRGB -d uint8 -o $@

# A ball before a board, by layers and by rays.
$(WORK)/ball.obj: | $(WORK)
	$(BIN)/meshgen sphere --radius 0.5 --segments 512 -o $@
$(WORK)/board.obj: $(HERE)/image_space.mk | $(WORK)
	awk 'BEGIN { for (j = 0; j < 6; ++j) for (i = 0; i < 6; ++i) { if ((i + j) % 2) continue; \
	  for (k = 0; k < 4; ++k) print "v", (i + (k == 1 || k == 2)) * 0.4 - 1.2, (j + (k > 1)) * 0.4 - 1.2, -1.2; \
	  print "f -4 -3 -2 -1" } }' >$@
$(WORK)/plate_%.exr: $(WORK)/ball.obj $(WORK)/board.obj $(SKY)
	$(BIN)/render $< -o $@ --plate $(WORK)/board.obj:0.8,0.3,0.2 --ior 1.5 --env $(SKY) --eye 0.8,0.5,4 --target 0,0,-0.3 \
	  --fov 30 --size $(SIZE) --samples 4 $(ARGS_$*)
$(WORK)/plate.png: $(WORK)/plate_layers.exr $(WORK)/plate_rays.exr
	oiiotool $^ --mosaic 2x1 --ch R,G,B --colorconvert linear sRGB -d uint8 -o $@
