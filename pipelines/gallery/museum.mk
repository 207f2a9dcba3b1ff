# Caption: Five things in five volumes on one floor: each is seen through and mirrored in the others.
# Answers: 000 section 6, the museum; 004 figure 7.2
# Small: RESOLUTION=48 SIZE=120x60 SAMPLES=1
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := museum
RESOLUTION ?= 128
SIZE       ?= 480x240
include pipelines/gallery/common.mk
THINGS := block cube ring sphere gyroid
picture: $(OUT)/museum.png
.PHONY: picture
.SECONDARY:

$(MADE)/block_0.obj: ; @mkdir -p $(@D)
	$(MESHGEN) box --from=-0.55,0,-0.18 --to 0.55,0.6,0.18 --place=-4.2,1.2,-0.5 -o $@
$(MADE)/block_1.obj: ; @mkdir -p $(@D)
	$(MESHGEN) logo GLAS --height 0.24 --depth 0.14 --place=-4.2,1.36,-0.5 -o $@
$(MADE)/cube_0.obj: ; @mkdir -p $(@D)
	$(MESHGEN) implicit rounded-cube --place=-2.1,1.56,0.5:0,30,0:0.36 -o $@
$(MADE)/cube_1.obj: ; @mkdir -p $(@D)
	$(MESHGEN) sphere --radius 0.2 --place=-2.1,1.56,0.5 -o $@
$(MADE)/ring_0.obj: ; @mkdir -p $(@D)
	$(MESHGEN) implicit torus --place=0,1.62,-0.6:90,0,0:0.42 -o $@
$(MADE)/sphere_0.obj: ; @mkdir -p $(@D)
	$(MESHGEN) sphere --radius 0.42 --place=2.1,1.62,0.5 -o $@
$(MADE)/gyroid_0.obj: ; @mkdir -p $(@D)
	$(MESHGEN) implicit gyroid --cells 1.5 --place=4.2,1.62,-0.5:0,20,0:0.4 -o $@
# Each thing's stand.
STAND = $(MESHGEN) box --from=-0.42,0,-0.42 --to 0.42,1.2,0.42 --place=$(1),0,$(2) -o $@
$(MADE)/block_stand.obj: ; @mkdir -p $(@D)
	$(MESHGEN) box --from=-0.65,0,-0.42 --to 0.65,1.2,0.42 --place=-4.2,0,-0.5 -o $@
$(MADE)/cube_stand.obj: ; @mkdir -p $(@D)
	$(call STAND,-2.1,0.5)
$(MADE)/ring_stand.obj: ; @mkdir -p $(@D)
	$(call STAND,0,-0.6)
$(MADE)/sphere_stand.obj: ; @mkdir -p $(@D)
	$(call STAND,2.1,0.5)
$(MADE)/gyroid_stand.obj: ; @mkdir -p $(@D)
	$(call STAND,4.2,-0.5)

# Each domain holds the shadows of its thing and is none of another's.
BOUNDS_block  := -5.1,-0.15,-1.75,-2.82,1.9,0
BOUNDS_cube   := -2.75,-0.15,-0.75,-0.72,2.15,1
BOUNDS_ring   := -0.65,-0.15,-1.85,1.38,2.15,-0.1
BOUNDS_sphere := 1.45,-0.15,-0.75,3.48,2.15,1
BOUNDS_gyroid := 3.55,-0.15,-1.75,5.58,2.15,0
FLOOR         := --ground '0:0.5,0.46,0.42:checker 0.8'
# What each is made of, before its stand.
MATTER_block  := --ior 1.5 --ior 1.62 --absorption 0.05 --absorption 0.6,2.2,4 --absorption 0 --opacity 0 --opacity 0
MATTER_cube   := --ior 1.45 --ior 1.7 --absorption 0.5,2.2,2.8 --absorption 2.8,0.8,0.3 --absorption 0 --opacity 0 --opacity 0
MATTER_ring   := --ior 1.5 --absorption 0.3,1.6,2.4 --absorption 0 --opacity 0
MATTER_sphere := --ior 1.5 --absorption 1.6,0.5,0.2 --absorption 0 --opacity 0
MATTER_gyroid := --ior 1.55 --absorption 1.8,0.5,1.4 --absorption 0 --opacity 0
# The gyroid parts rays at every turn: fewer cells will do.
CELLS_gyroid := --photons 65536
MESHES_block  := $(MADE)/block_0.obj $(MADE)/block_1.obj
MESHES_cube   := $(MADE)/cube_0.obj $(MADE)/cube_1.obj
MESHES_ring   := $(MADE)/ring_0.obj
MESHES_sphere := $(MADE)/sphere_0.obj
MESHES_gyroid := $(MADE)/gyroid_0.obj
.SECONDEXPANSION:
$(MADE)/%.vdb: $$(MESHES_$$*) $(MADE)/%_stand.obj
	$(BIN)/mesh2vol $^ -o $@ $(MATTER_$*) --ior 1 --opacity 1 $(MESHES_$*:%=--albedo 0) --albedo 0.6,0.57,0.52 \
	  $(FLOOR) --bounds=$(BOUNDS_$*) --resolution $(RESOLUTION)
$(MADE)/%_lit.vdb: $(MADE)/%.vdb
	$(BIN)/lightsim $< -o $@ --light directional:0.45,-1,-0.35:2.6,2.5,2.3 \
	  --light directional:-0.12,-1,-0.3:0.6,0.65,0.7 --surface-detail 1 --max-depth 6 \
	  $(CELLS_$*)
$(OUT)/museum.exr $(OUT)/museum.png &: $(THINGS:%=$(MADE)/%_lit.vdb) $(ROOM)
	$(BIN)/render $(THINGS:%=$(MADE)/%_lit.vdb) -o $(OUT)/museum.exr -o $(OUT)/museum.png --eye -0.5,4.6,10 \
	  --target -0.15,0.75,0 --fov 28 --size $(SIZE) --samples $(SAMPLES) --env $(ROOM)
