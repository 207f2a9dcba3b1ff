# Hot air as a schlieren system shows it: how far rays are turned to the left or right by a plume 300 K
# warmer than the room, whose index differs by 1.4e-4.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/plume.mk                     out/plume.png
#   make -f pipelines/plume.mk WARMER=3 GAIN=80000    breath: a contrast of 2.7e-6
#   make -f pipelines/plume.mk SIMULATION=smoke.vdb GRID=temperature RISE=300:293.15
#
# The plume stands in for a simulation: a winding tube, softened, whose grid `opacity` is 0 outside and 1 within.
SHELL := /bin/bash
.DELETE_ON_ERROR:
BIN        ?= build/bin
OUT        ?= out
WARMER     ?= 300
GAIN       ?= 800
RESOLUTION ?= 160
WORK       := $(OUT)/plume
SIMULATION ?= $(WORK)/simulation.vdb
GRID       ?= opacity
RISE       ?= $(WARMER):293.15
VIEW       ?= --eye 0,1,9 --target 0,1,0 --ortho 2.2 --size 360x480
default: $(OUT)/plume.png
	@echo "plume: look at $<"
.PHONY: default

# A tube of 48 sides about a winding axis, which widens upward and is closed by fans.
$(WORK)/tube.obj: pipelines/plume.mk
	@mkdir -p $(@D)
	awk 'BEGIN { rings = 96; sides = 48; turn = 2 * 3.14159265358979 / sides; \
	  for (j = 0; j <= rings; ++j) { y = 0.1 + 1.9 * j / rings; r = 0.08 + 0.11 * y + 0.03 * sin(9 * y); \
	    for (i = 0; i < sides; ++i) print "v", 0.09 * y * sin(5 * y) + r * cos(i * turn), y, \
	      0.07 * y * cos(4 * y) + r * sin(i * turn) } \
	  for (j = 0; j < rings; ++j) for (i = 0; i < sides; ++i) { \
	    a = j * sides + i + 1; b = j * sides + (i + 1) % sides + 1; \
	    print "f", a, a + sides, b + sides, b } \
	  for (i = 1; i + 1 < sides; ++i) { print "f", 1, 1 + i, 2 + i; t = rings * sides + 1; \
	    print "f", t, t + i + 1, t + i } }' >$@

$(WORK)/simulation.vdb: $(WORK)/tube.obj
	$(BIN)/mesh2vol $< -o - --ior 1 --opacity 1 --boundary blurred --resolution $(RESOLUTION) --padding 16 --quiet | \
	  $(BIN)/volsmooth - -o $@ --grids opacity --sigma 5

# Air at its temperature; what stood for that is opaque no more. Made anew each time, since WARMER may differ.
$(WORK)/air.vdb: $(SIMULATION) FORCE
	@mkdir -p $(@D)
	$(BIN)/sim2vol $< -o $@ --ior-from $(GRID):air --kelvin $(RISE) --opacity-from $(GRID):0
.PHONY: FORCE

# A knife edge across X: grey where a ray goes straight on.
$(OUT)/plume.png: $(WORK)/air.vdb
	$(BIN)/render $< -o $(WORK)/rays.exr --aov deflection $(VIEW)
	oiiotool $(WORK)/rays.exr --ch deflection.X --mulc $(GAIN) --addc 0.5 --clamp:min=0:max=1 -d uint8 -o $@
