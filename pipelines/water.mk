# Water with waves in a pool: the net of light on its floor. The faces of the domain cut the water open, and
# do not refract; so the view is within them.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/water.mk                                   out/water.png
SHELL := /bin/bash
OUT   ?= out
LIGHT ?= directional:-0.25,-1,0.15:3
SIZE  ?= 800x600
default: picture
.PHONY: default

NAME           := water
MESHES         := $(OUT)/water/water.obj $(OUT)/water/floor.obj
VOLUME_OPTIONS ?= --ior 1.33 --ior 1 --opacity 0 --opacity 1 --albedo 0 --albedo 0.75,0.85,0.9 \
  --absorption 0.6,0.15,0.08 --absorption 0 --resolution 192 \
  --bounds=-1,-0.5,-1,1,0.1,1 --fill-below yes --fill-below no
SMOOTH         := off
LIGHT_OPTIONS  ?= --light $(LIGHT)
VIEW_OPTIONS   ?= --eye 0.4,1.5,2.3 --target 0,-0.3,0 --fov 19 --size $(SIZE) --samples 4 \
  --background 0.5,0.6,0.7
include pipelines/chain.mk

$(OUT)/water/water.obj: | $(WORK)
	$(BIN)/meshgen wave -o $@

# The water fills the domain below its surface; where the floor is, the later object, it gives way.
$(OUT)/water/floor.obj: | $(WORK)
	$(BIN)/meshgen box --from=-1.2,-0.5,-1.2 --to=1.2,-0.38,1.2 -o $@
