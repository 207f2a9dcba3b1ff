# A light that circles a wine glass on a table in 24 frames, and how evenly its caustic moves. Safe under make
# -j, and a run that was killed goes on where it stopped.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -j2 -f pipelines/wineglass_light.mk          out/wineglass_light/frame_0001.png and so on
#   make -f pipelines/wineglass_light.mk flicker      how far neighbours in time are apart
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
BIN    ?= build/bin
OUT    ?= out
FRAMES ?= 24
SIZE   ?= 320x240
PHOTONS ?= 131072
RESOLUTION ?= 192
HERE   := pipelines/wineglass
WORK   := $(OUT)/wineglass_light
ALL    := $(shell seq -f %04g 1 $(FRAMES))
default: $(ALL:%=$(WORK)/frame_%.png)
.PHONY: default flicker
# Kept for the next run; make would remove them as intermediate files.
.SECONDARY:

$(WORK)/profile.txt: $(HERE)/profile.awk
	@mkdir -p $(@D)
	awk -f $< >$@

$(WORK)/glass.obj: $(HERE)/mesh.awk $(WORK)/profile.txt
	awk -v around=256 -f $^ >$@

$(WORK)/table.obj:
	@mkdir -p $(@D)
	$(BIN)/meshgen box --from=-90,-6,-50 --to=90,-0.5,130 -o $@

# Blurred: the glass's walls of 1 mm are about a voxel.
$(WORK)/volume.vdb: $(WORK)/glass.obj $(WORK)/table.obj
	$(BIN)/mesh2vol $^ -o - --boundary blurred --ior 1.5 --ior 1 --opacity 0 --opacity 1 \
	  --albedo 0 --albedo 0.75,0.6,0.45 --resolution $(RESOLUTION) --quiet | \
	  $(BIN)/volsmooth - -o $@

# Most of a half turn behind the glass, 35 degrees high.
$(WORK)/light_%.vdb: $(WORK)/volume.vdb
	$(BIN)/lightsim $< -o $@ --photons $(PHOTONS) --light directional:$$(awk -v k=$* 'BEGIN \
	  { a = 3.14159265 * (0.2 + 0.6 * (k - 1) / ($(FRAMES) > 1 ? $(FRAMES) - 1 : 1)); \
	    print cos(a) "," (-0.7) "," sin(a) }'):3

$(WORK)/frame_%.exr $(WORK)/frame_%.png &: $(WORK)/light_%.vdb
	$(BIN)/render $< -o $(WORK)/frame_$*.exr -o $(WORK)/frame_$*.png --eye 0,170,330 \
	  --target 0,40,20 --fov 34 --size $(SIZE) --samples 4 --background 0.2,0.22,0.26

# Root mean square of the difference of each frame from the one before.
flicker: $(ALL:%=$(WORK)/frame_%.exr)
	@before=; for frame in $^; do \
	  [ -z "$$before" ] || echo $$frame $$(idiff $$before $$frame | awk '/RMS error/ { print $$4 }'); \
	  before=$$frame; \
	done
