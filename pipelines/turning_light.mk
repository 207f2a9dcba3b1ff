# A light that swings over the bunny in 24 frames. Safe under make -j, and a run that was killed goes
# on where it stopped, since a frame's file exists only when it is whole.
# SPDX-License-Identifier: GPL-3.0-or-later
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
BIN    ?= build/bin
OUT    ?= out
FRAMES ?= 24
SIZE   ?= 320x240
PHOTONS ?= 262144
RESOLUTION ?= 96
WORK   := $(OUT)/turning_light
ALL    := $(shell seq -f %04g 1 $(FRAMES))
default: $(ALL:%=$(WORK)/frame_%.png)
.PHONY: default
# Kept for the next run; make would remove them as intermediate files.
.SECONDARY:
include pipelines/bunny_scene.mk

$(WORK)/volume.vdb: $(BUNNY) $(PLINTH)
	@mkdir -p $(@D)
	$(BIN)/mesh2vol $^ -o $@ $(BUNNY_VOLUME)

# From the left to the right: sideways part −0.8 to 0.8, power as in the still picture.
$(WORK)/light_%.vdb: $(WORK)/volume.vdb
	$(BIN)/lightsim $< -o $@ --photons $(PHOTONS) --light directional:$$(awk -v k=$* \
	  'BEGIN {print 1.6 * (k - 1) / ($(FRAMES) > 1 ? $(FRAMES) - 1 : 1) - 0.8}'),-1,-0.15:3.2,3,2.7

$(WORK)/frame_%.exr $(WORK)/frame_%.png &: $(WORK)/light_%.vdb $(STUDIO)
	$(BIN)/render $< -o $(WORK)/frame_$*.exr -o $(WORK)/frame_$*.png $(BUNNY_VIEW) --size $(SIZE) \
	  --env $(STUDIO)
