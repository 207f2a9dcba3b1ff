# A ball of glass over a floor: its shadow, and the caustic in it.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/ball_floor.mk                              out/ball_floor.png
#   make -f pipelines/ball_floor.mk LIGHT=point:1,2,0.5:6        another light
SHELL := /bin/bash
OUT   ?= out
LIGHT ?= directional:-0.3,-1,-0.2:3
SIZE  ?= 800x600
default: picture
.PHONY: default

NAME           := ball_floor
MESHES         := $(OUT)/ball_floor/ball.obj $(OUT)/ball_floor/floor.obj
VOLUME_OPTIONS ?= --ior 1.5 --ior 1 --opacity 0 --opacity 1 --albedo 0 --albedo 0.8 --resolution 192
SMOOTH         := off
LIGHT_OPTIONS  ?= --light $(LIGHT)
VIEW_OPTIONS   ?= --eye 0,0.9,2.6 --target 0,-0.15,0 --fov 40 --size $(SIZE) --samples 4 \
  --background 0.25,0.3,0.36
include pipelines/chain.mk

$(OUT)/ball_floor/ball.obj: | $(WORK)
	$(BIN)/meshgen sphere --radius 0.5 --segments 512 -o $@

$(OUT)/ball_floor/floor.obj: | $(WORK)
	$(BIN)/meshgen box --from=-1.5,-0.85,-1.5 --to=1.5,-0.75,1.5 -o $@
