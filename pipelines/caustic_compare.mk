# Lit floors against exact pictures of them: a ball of glass by render and by POV-Ray with photons,
# and water with waves by render. What each takes, and how far it is off.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/caustic_compare.mk ball      the table of both; out/caustic/ball.png
#   make -f pipelines/caustic_compare.mk water     the table of water; out/caustic/water.png
#   make -f pipelines/caustic_compare.mk           both
#
# Times are wall times, ours of mesh2vol, lightsim and render: let nothing else run. Needs
# OpenImageIO's oiiotool; POV-Ray (Debian: povray) is left out where it is missing.
SHELL := /bin/bash
.DELETE_ON_ERROR:
.DEFAULT_GOAL := all
BUILD ?= build
BIN   ?= $(BUILD)/bin
OUT   ?= out
HERE  := pipelines/caustic
WORK  := $(OUT)/caustic
SIZE  ?= 800x600
# resolution:surface detail:log2 of photons:samples a pixel
BALL_SETTINGS  ?= 96:8:18:1 96:8:20:1 128:8:20:1 192:8:20:1 192:8:20:4 192:8:22:4
WATER_SETTINGS ?= 128:4:18:1 128:4:20:1 192:4:20:1 192:8:20:1 192:8:20:4
# spacing of photons:samples a pixel, 1 or 4
POV_SETTINGS   ?= 0.01:1 0.004:1 0.002:1 0.001:1 0.004:4 0.002:4 0.001:4
BALL_VIEW  := --eye 0,0.9,2.6 --target 0,-0.15,0 --fov 40 --size $(SIZE)
WATER_VIEW := --eye 0.4,1.5,2.3 --target 0,-0.35,0 --fov 24 --size $(SIZE)

.PHONY: all ball water
all: ball water

.PHONY: FORCE
$(BUILD)/tests/caustic: FORCE
	@cmake --build $(BUILD) --target caustic >/dev/null

$(WORK):
	@mkdir -p $@

$(WORK)/ball.obj: | $(WORK)
	$(BIN)/meshgen sphere --radius 0.5 --segments 192 -o $@

# It reaches beyond the domain, whose faces cut it at 3.
$(WORK)/ball_floor.obj: | $(WORK)
	$(BIN)/meshgen box --from=-3.5,-1,-3.5 --to=3.5,-0.75,3.5 -o $@

# Its sides are so far off that what goes through them does not come to what is seen.
$(WORK)/water.obj: | $(WORK)
	$(BIN)/meshgen wave --half 2 --bottom=-0.42 --squares 128 -o $@

$(WORK)/water_floor.obj: | $(WORK)
	$(BIN)/meshgen box --from=-2.1,-0.5,-2.1 --to=2.1,-0.4,2.1 -o $@

$(WORK)/box.obj: | $(WORK)
	$(BIN)/meshgen box --from=-0.5,0.2,-0.3 --to=-0.1,0.3,0.1 -o $@

$(WORK)/ball_exact.exr: | $(BUILD)/tests/caustic $(WORK)
	$(BUILD)/tests/caustic exact ball -o $@ $(BALL_VIEW) --irradiance 3

$(WORK)/water_exact.exr: | $(BUILD)/tests/caustic $(WORK)
	$(BUILD)/tests/caustic exact water -o $@ $(WATER_VIEW) --irradiance 3

ball: $(WORK)/ball_exact.exr $(WORK)/ball.obj $(WORK)/ball_floor.obj
	@BIN=$(BIN) WORK=$(WORK) CAUSTIC=$(BUILD)/tests/caustic bash $(HERE)/compare.sh ball \
	  '$(BALL_SETTINGS)' --ior 1.5 --ior 1 --opacity 0 --opacity 1 --albedo 0 --albedo 0.8 \
	  --bounds=-3,-0.85,-3,3,0.6,3 -- $(WORK)/ball.obj $(WORK)/ball_floor.obj -- \
	  --light directional:-0.3,-1,-0.2:3 -- $(BALL_VIEW) --background 0,0,0
	@command -v povray >/dev/null || { echo "without POV-Ray (Debian: povray)"; exit 0; }; \
	WORK=$(WORK) CAUSTIC=$(BUILD)/tests/caustic bash $(HERE)/compare_povray.sh \
	  $(HERE)/ball_floor.pov $(SIZE) '$(POV_SETTINGS)'

water: $(WORK)/water_exact.exr $(WORK)/water.obj $(WORK)/water_floor.obj $(WORK)/box.obj
	@BIN=$(BIN) WORK=$(WORK) CAUSTIC=$(BUILD)/tests/caustic bash $(HERE)/compare.sh water \
	  '$(WATER_SETTINGS)' --ior 1.33 --ior 1 --ior 1 --opacity 0 --opacity 1 --opacity 1 \
	  --albedo 0 --albedo 0.8 --albedo 0 -- \
	  $(WORK)/water.obj $(WORK)/water_floor.obj $(WORK)/box.obj -- \
	  --light directional:-0.25,-1,0.15:3 -- $(WATER_VIEW) --background 0,0,0
