# What matter may be: frosted glass, a metal ring and its caustic, coats, four things side by side.
#   make -f pipelines/matter.mk [BIN=build/bin] [OUT=out] [SAMPLES=16]
# SPDX-License-Identifier: GPL-3.0-or-later
BIN     ?= build/bin
OUT     ?= out
SAMPLES ?= 16
DIR     := $(OUT)/matter
MESHGEN := $(BIN)/meshgen
SUN     := --light directional:0.5,-1,-0.35:3
.DELETE_ON_ERROR:
.PHONY: all
all: $(DIR)/rough.png $(DIR)/ring.png $(DIR)/museum.png $(DIR)/coats.png

$(DIR):
	mkdir -p $@
$(DIR)/env.exr: | $(DIR)
	oiiotool --pattern fill:top=0.9,1.05,1.3:bottom=0.35,0.33,0.3 512x256 3 -d float -o $@

# ---- frosted glass: GGX's alpha 0, 0.1, 0.3
$(DIR)/table.obj: | $(DIR)
	$(MESHGEN) box --from=-2.6,-0.2,-1.2 --to=2.6,0,1.2 -o $@
$(DIR)/ball%.obj: | $(DIR)
	$(MESHGEN) sphere --radius 0.6 --segments 96 --place $$((17 * ($* - 2)))e-1,0.61,0 -o $@
$(DIR)/rough.vdb: $(DIR)/table.obj $(DIR)/ball1.obj $(DIR)/ball2.obj $(DIR)/ball3.obj
	$(BIN)/mesh2vol $^ -o $@ --resolution 256 --ior 1 --ior 1.5 --ior 1.5 --ior 1.5 --roughness 0 --roughness 0 \
	  --roughness 0.1 --roughness 0.3 --opacity 1 --opacity 0 --opacity 0 --opacity 0 \
	  --albedo 0.65,0.6,0.5 --albedo 0 --albedo 0 --albedo 0
$(DIR)/rough.exr: $(DIR)/rough.vdb $(DIR)/env.exr
	$(BIN)/lightsim $< -o $(DIR)/rough_lit.vdb $(SUN) --surface-detail 2
	$(BIN)/render $(DIR)/rough_lit.vdb -o $@ --eye 0,2.1,5.2 --target 0,0.35,0 --fov 30 --size 640x320 \
	  --env $(DIR)/env.exr --samples $(SAMPLES)

# ---- a ring of gold, whose inside makes a caustic with a cusp
$(DIR)/board.obj: | $(DIR)
	$(MESHGEN) box --from=-1.7,-0.2,-1.5 --to=1.7,0,1.5 -o $@
$(DIR)/ring.obj: | $(DIR)
	printf '%s\n' 0.9,0 1.04,0 1.04,0.42 0.9,0.42 0.9,0 | $(MESHGEN) revolve - -o $@
$(DIR)/ring.vdb: $(DIR)/board.obj $(DIR)/ring.obj
	$(BIN)/mesh2vol $^ -o $@ --resolution 288 --metal none --metal gold --ior 1 --ior none --opacity 1 --albedo 0.7
$(DIR)/ring.exr: $(DIR)/ring.vdb $(DIR)/env.exr
	$(BIN)/lightsim $< -o $(DIR)/ring_lit.vdb --light directional:0.8,-0.75,-0.2:3:0.53
	$(BIN)/render $(DIR)/ring_lit.vdb -o $@ --eye -0.6,2.6,3.1 --target 0.05,0.05,0 --fov 34 --size 640x480 \
	  --env $(DIR)/env.exr --samples 4

# ---- one paint under no coat, and coats of 1.33, 1.5 and 2.4, on an endless ground
$(DIR)/boxes.exr: | $(DIR)
	oiiotool --pattern fill:top=0.25,0.3,0.38:bottom=0.12,0.11,0.1 512x256 3 --fill:color=6,5.7,5.2 90x60+290+25 \
	  --fill:color=1.5,1.8,2.2 40x80+140+70 --blur 5x5 -d float -o $@
$(DIR)/paint%.obj: | $(DIR)
	$(MESHGEN) sphere --radius 0.42 --segments 96 --place $$((10 * $* - 25))e-1,0.43,0 -o $@
$(DIR)/coats.vdb: $(DIR)/paint1.obj $(DIR)/paint2.obj $(DIR)/paint3.obj $(DIR)/paint4.obj
	$(BIN)/mesh2vol $^ -o $@ --resolution 288 --ior 1 --ior 1.33 --ior 1.5 --ior 2.4 --opacity 1 --albedo 0.55,0.04,0.03 \
	  --ground='0:0.75,0.72,0.66:checker 0.35'
$(DIR)/coats.exr: $(DIR)/coats.vdb $(DIR)/boxes.exr
	$(BIN)/lightsim $< -o $(DIR)/coats_lit.vdb $(SUN):0.53
	$(BIN)/render $(DIR)/coats_lit.vdb -o $@ --eye 0.6,1.5,5.4 --target 0,0.3,0 --fov 26 --size 640x320 \
	  --env $(DIR)/boxes.exr --samples $(SAMPLES)

# ---- four stands, each a volume of its own, side by side
THINGS := glass gold frosted lacquer
$(DIR)/tile.obj: | $(DIR)
	$(MESHGEN) box --from=-0.75,-0.1,-0.75 --to=0.75,0,0.75 -o $@
$(DIR)/stand.obj: | $(DIR)
	$(MESHGEN) box --from=-0.275,0,-0.275 --to=0.275,0.5,0.275 -o $@
$(DIR)/thing.obj: | $(DIR)
	$(MESHGEN) sphere --radius 0.32 --segments 96 --place 0,0.83,0 -o $@
MADE = $(BIN)/mesh2vol $(DIR)/tile.obj $(DIR)/stand.obj $(1) -o $@ --resolution 160 --ior 1 --ior 1 \
       --opacity 1 --opacity 1 --albedo 0.55,0.5,0.45 --albedo 0.75
PARTS := $(DIR)/tile.obj $(DIR)/stand.obj $(DIR)/thing.obj
$(DIR)/glass.vdb: $(PARTS)
	$(call MADE,$(DIR)/thing.obj) --ior 1.5 --opacity 0 --albedo 0 --absorption 0 --absorption 0 --absorption 2,0.3,0.6
$(DIR)/gold.vdb: $(PARTS)
	$(call MADE,$(DIR)/thing.obj) --ior none --opacity none --albedo 0 --metal none --metal none --metal gold
$(DIR)/frosted.vdb: $(PARTS)
	$(call MADE,$(DIR)/thing.obj) --ior 1.5 --opacity 0 --albedo 0 --roughness 0 --roughness 0 --roughness 0.2
$(DIR)/lacquer.vdb: $(PARTS)
	$(call MADE,$(DIR)/thing.obj) --ior 1.5 --opacity 1 --albedo 0.6,0.05,0.04
$(DIR)/%_lit.vdb: $(DIR)/%.vdb
	$(BIN)/lightsim $< -o $@ $(SUN)
$(DIR)/museum.exr: $(THINGS:%=$(DIR)/%_lit.vdb) $(DIR)/env.exr
	$(BIN)/render $< --place $(DIR)/glass_lit.vdb:-2.55,0,0 --place $(DIR)/gold_lit.vdb:-0.85,0,0 \
	  --place $(DIR)/frosted_lit.vdb:0.85,0,0 --place $(DIR)/lacquer_lit.vdb:2.55,0,0 \
	  -o $@ --eye 0,2.1,6.4 --target 0,0.4,0 --fov 23 --size 720x260 --env $(DIR)/env.exr --samples 4

$(DIR)/%.png: $(DIR)/%.exr
	oiiotool $< --ch R,G,B --mulc 0.8 --colorconvert linear sRGB -d uint8 -o $@
