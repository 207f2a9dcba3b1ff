# Caption: A ring of gold on a board: its inside casts a caustic with a cusp.
# Answers: 003 section 6 (caustics), of a mirror
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := ring
RESOLUTION ?= 224
SIZE       ?= 480x360
include pipelines/gallery/common.mk

MESHES         := $(MADE)/board.obj $(MADE)/ring.obj
VOLUME_OPTIONS  = --metal none --metal gold --ior 1 --ior none --opacity 1 --albedo 0.7 --resolution $(RESOLUTION)
SMOOTH         := off
LIGHT_OPTIONS  ?= --light directional:0.8,-0.75,-0.2:3
VIEW_OPTIONS    = --eye=-0.6,2.6,3.1 --target 0.05,0.05,0 --fov 34 --size $(SIZE) --samples $(SAMPLES) --env $(ROOM)
VIEW_FILES      = $(ROOM)
include pipelines/chain.mk

$(MADE)/board.obj: | $(WORK)
	$(MESHGEN) box --from=-1.7,-0.2,-1.5 --to 1.7,0,1.5 -o $@
# A band with rounded edges, by its section.
$(MADE)/ring.csv: | $(WORK)
	awk 'BEGIN { pi = atan2(0, -1); for (k = 0; k < 32; ++k) { a = 2 * pi * k / 32; c = cos(a); s = sin(a); \
	  print 0.83 + 0.07 * (c < 0 ? -1 : 1) * (c < 0 ? -c : c) ^ 0.5, 0.22 + 0.21 * (s < 0 ? -1 : 1) * (s < 0 ? -s : s) ^ 0.5 } \
	  print 0.83 + 0.07, 0.22 }' >$@
$(MADE)/ring.obj: $(MADE)/ring.csv
	$(MESHGEN) revolve $< -o $@
