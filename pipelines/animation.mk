# Bodies of glass that deform: frames by refraction in image space, beside the same through a volume. Safe
# under make -j, and a run that was killed goes on where it stopped.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/animation.mk                  out/animation/contact.png; with ffmpeg animation.mp4, too
#   make -f pipelines/animation.mk FRAMES=24 SIZE=320x320
#
# A bunny of jelly jumps and twists; a figure, sketched by its bones, jumps with its skin. For each subject the
# upper row is `render --method dir`, which takes all frames in one run, and the lower one mesh2vol and render.
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
BIN        ?= build/bin
OUT        ?= out
FRAMES     ?= 8
SIZE       ?= 192x192
RESOLUTION ?= 96
METHOD     ?= dir
FPS        ?= 12
HERE   := pipelines/animation
WORK   := $(OUT)/animation
NUMBERS := $(shell seq -f %04g 1 $(FRAMES))
default: $(WORK)/contact.png $(WORK)/animation.mp4
.PHONY: default $(WORK)/animation.mp4
# Kept for the next run; make would remove them as intermediate files.
.SECONDARY:
include pipelines/bunny_scene.mk

ROOM  := $(WORK)/room.exr
GLASS := --ior 1.45 --absorption 0.3,0.12,0.2
BUNNY_CAMERA  := --eye 0.7,0.35,2.9 --target 0,0.14,0 --fov 36
FIGURE_CAMERA := --eye 1.0,1.35,4.6 --target 0,1.28,0 --fov 42

# A sky, lamps in three colours, and large tiles on the ground.
$(ROOM):
	@mkdir -p $(@D)
	oiiotool --pattern fill:top=0.25,0.45,0.9:bottom=0.9,0.9,0.85 512x128 3 \
	  --pattern checker:width=32:height=16:color1=0.12,0.1,0.08:color2=0.5,0.46,0.4 512x128 3 --mosaic 1x2 \
	  --fill:color=6,5.5,5 60x40+130+30 --fill:color=3,1.2,0.5 24x60+330+60 --fill:color=0.4,1.4,3 24x60+30+60 \
	  -d float -o $(@D)/.room.exr
	mv $(@D)/.room.exr $@

# The share of the way that a frame has come, of a jump that ends as it begins.
PHASE = $$(awk 'BEGIN { print ($(1) - 1) / $(FRAMES) }')

$(WORK)/bunny_%.obj: $(HERE)/jump.awk $(BUNNY)
	@mkdir -p $(@D)
	awk -v phase=$(call PHASE,$*) -f $^ >$@

$(WORK)/rest.off: $(HERE)/skeleton.awk $(HERE)/body.awk
	@mkdir -p $(@D)
	awk -v cell=0.025 $(addprefix -f ,$^) >$@

$(WORK)/figure_%.obj: $(HERE)/skeleton.awk $(HERE)/pose.awk $(WORK)/rest.off
	awk -v phase=$(call PHASE,$*) -f $(HERE)/skeleton.awk -f $(HERE)/pose.awk $(WORK)/rest.off >$@

# All frames of a subject from its meshes, in one run.
$(WORK)/bunny.done: $(NUMBERS:%=$(WORK)/bunny_%.obj) $(ROOM) $(HERE).mk
	$(BIN)/render '$(WORK)/bunny_####.obj' --frames 1-$(FRAMES) --method $(METHOD) $(GLASS) $(BUNNY_CAMERA) \
	  --size $(SIZE) --env $(ROOM) --samples 4 -o '$(WORK)/bunny_mesh_####.png' --stats $(WORK)/bunny.json
	@touch $@
$(WORK)/figure.done: $(NUMBERS:%=$(WORK)/figure_%.obj) $(ROOM) $(HERE).mk
	$(BIN)/render '$(WORK)/figure_####.obj' --frames 1-$(FRAMES) --method $(METHOD) $(GLASS) $(FIGURE_CAMERA) \
	  --size $(SIZE) --env $(ROOM) --samples 4 -o '$(WORK)/figure_mesh_####.png' --stats $(WORK)/figure.json
	@touch $@

# The same frames one by one through a volume.
$(WORK)/%.vdb: $(WORK)/%.obj
	$(BIN)/mesh2vol $< -o $@ $(GLASS) --resolution $(RESOLUTION) --quiet
$(WORK)/bunny_volume_%.png: $(WORK)/bunny_%.vdb $(ROOM) $(HERE).mk
	$(BIN)/render $< -o $@ $(BUNNY_CAMERA) --size $(SIZE) --env $(ROOM) --samples 4 --quiet
$(WORK)/figure_volume_%.png: $(WORK)/figure_%.vdb $(ROOM) $(HERE).mk
	$(BIN)/render $< -o $@ $(FIGURE_CAMERA) --size $(SIZE) --env $(ROOM) --samples 4 --quiet

VOLUMES := $(foreach subject,bunny figure,$(NUMBERS:%=$(WORK)/$(subject)_volume_%.png))
ROWS    := $(foreach subject,bunny figure,$(foreach way,mesh volume,$(NUMBERS:%=$(WORK)/$(subject)_$(way)_%.png)))
$(WORK)/contact.png: $(WORK)/bunny.done $(WORK)/figure.done $(VOLUMES) $(HERE).mk
	oiiotool $(ROWS) --mosaic $(FRAMES)x4 -o $(WORK)/.contact.png
	mv $(WORK)/.contact.png $@

# Four pictures side by side, the jump three times over.
$(WORK)/animation.mp4: $(WORK)/contact.png
	@if ! command -v ffmpeg >/dev/null; then \
	  echo "animation: no ffmpeg here, so look at $(WORK)/contact.png"; \
	else \
	  ffmpeg -loglevel error -y $(foreach part,bunny_mesh bunny_volume figure_mesh figure_volume,-framerate \
	    $(FPS) -stream_loop 2 -start_number 1 -i $(WORK)/$(part)_%04d.png) -filter_complex hstack=inputs=4 \
	    -pix_fmt yuv420p $@; \
	fi
