# Crystals: a rhomb of calcite before printed text, without and with a polariser; tourmaline seen across its axis and
# along it; a wedge of quartz, and a disc that is compressed, between crossed polarisers.
#   make -f pipelines/crystals.mk [BUILD=build] [OUT=out] [SAMPLES=9]
# SPDX-License-Identifier: GPL-3.0-or-later
BUILD   ?= build
BIN     ?= $(BUILD)/bin
OUT     ?= out
SAMPLES ?= 9
STRESS_SIZE    ?= 240x240
STRESS_SAMPLES ?= 2
DIR     := $(OUT)/crystals
PRISM   := awk -f pipelines/crystals/prism.awk
.DELETE_ON_ERROR:
.PHONY: all FORCE
all: $(DIR)/rhomb.png $(DIR)/tourmaline.png $(DIR)/wedge.png $(DIR)/stress.png

$(DIR):
	mkdir -p $@

# ---- Iceland spar as it cleaves: edges at 101.92°, the axis along the sum of three that meet in a blunt corner
RHOMB_AXIS := 0.44232,0.54540,0.71195
$(DIR)/rhomb.obj: pipelines/crystals/prism.awk | $(DIR)
	$(PRISM) -v base='0,0,0 1.4,0,0 1.11093,1.36982,0 -0.28907,1.36982,0' -v along=-0.14454,-0.17823,0.66132 \
	  -v size=1.5 >$@
$(DIR)/rhomb.vdb: $(DIR)/rhomb.obj
	$(BIN)/mesh2vol $< -o $@ --material calcite --axis $(RHOMB_AXIS) --resolution 128 --smooth 0
$(DIR)/page.exr: pipelines/crystals/page.awk | $(DIR)
	awk -f $< -v text='TWO RAYS FROM ONE' -v lines=8 -v dot=8 -v width=960 -v height=720 >$(DIR)/page.ppm
	oiiotool $(DIR)/page.ppm --colorconvert sRGB linear -d float -o $@
VIEW := --eye 0,0,14 --target 0,0,0 --fov 16 --size 480x360 --samples $(SAMPLES) --wavelengths 1
PAGE := --plate $(DIR)/page.exr --plate-distance 15.2
# The e-ray's E lies in the plane of the axis and the ray, at 50.96° from the picture's right.
$(DIR)/rhomb_both.exr: $(DIR)/rhomb.vdb $(DIR)/page.exr
	$(BIN)/render $< -o $@ $(VIEW) $(PAGE)
$(DIR)/rhomb_e.exr: $(DIR)/rhomb.vdb $(DIR)/page.exr
	$(BIN)/render $< -o $@ $(VIEW) $(PAGE) --polarizer 50.96
$(DIR)/rhomb_o.exr: $(DIR)/rhomb.vdb $(DIR)/page.exr
	$(BIN)/render $< -o $@ $(VIEW) $(PAGE) --polarizer 140.96
$(DIR)/rhomb.exr: $(DIR)/rhomb_both.exr $(DIR)/rhomb_o.exr $(DIR)/rhomb_e.exr
	oiiotool $(DIR)/rhomb_both.exr --ch R,G,B $(DIR)/rhomb_o.exr --ch R,G,B --mulc 2 \
	  $(DIR)/rhomb_e.exr --ch R,G,B --mulc 2 --mosaic 3x1 -d float -o $@

# ---- a six-sided prism of tourmaline: across its axis half of the light is little absorbed, along it none
HEXAGON := 1,0,0 0.5,0.86603,0 -0.5,0.86603,0 -1,0,0 -0.5,-0.86603,0 0.5,-0.86603,0
$(DIR)/standing.obj: pipelines/crystals/prism.awk | $(DIR)
	$(PRISM) -v base='1,0,0 0.5,0,-0.86603 -0.5,0,-0.86603 -1,0,0 -0.5,0,0.86603 0.5,0,0.86603' -v along=0,2.2,0 \
	  -v place=-1.35,0,0 >$@
$(DIR)/lying.obj: pipelines/crystals/prism.awk | $(DIR)
	$(PRISM) -v base='$(HEXAGON)' -v along=0,0,2.2 -v place=1.35,0,0 >$@
$(DIR)/tourmaline.vdb: $(DIR)/standing.obj $(DIR)/lying.obj
	$(BIN)/mesh2vol $^ -o $@ --material tourmaline --axis 0,1,0 --axis 0,0,1 --resolution 160 --smooth 0 \
	  --absorption 1.5,1.1,1.9 --absorption-extraordinary 0.45,0.06,0.3
$(DIR)/env.exr: | $(DIR)
	oiiotool --pattern fill:top=1.1,1.15,1.2:bottom=0.45,0.42,0.4 512x256 3 -d float -o $@
$(DIR)/tourmaline.exr: $(DIR)/tourmaline.vdb $(DIR)/env.exr
	$(BIN)/render $< -o $@ --eye 0.9,1.3,9 --target 0,0,0 --fov 22 --size 640x400 --env $(DIR)/env.exr \
	  --samples $(SAMPLES) --wavelengths 1

# ---- 0.04 to 0.25 mm of quartz: two modes that are up to 2.3 µm apart, four orders of Newton's colours
$(DIR)/wedge.obj: pipelines/crystals/prism.awk | $(DIR)
	$(PRISM) -v base='-2,0,0.075 2,0,0.5 2,0,-0.5 -2,0,-0.075' -v along=0,1.2,0 >$@
$(DIR)/wedge.vdb: $(DIR)/wedge.obj
	$(BIN)/mesh2vol $< -o $@ --material quartz --axis 0.70711,0.70711,0 --resolution 224 --smooth 0
$(DIR)/wedge.exr: $(DIR)/wedge.vdb
	$(BIN)/render $< -o $@ --eye 0,0,9 --target 0,0,0 --ortho 1.8 --size 640x256 --background 1 --unit 2.5e-4 \
	  --polarizer 0 --back-polarizer 90 --wavelengths 8 --samples 4

# ---- a disc of epoxy, 40 mm across and 4 mm thick, that two forces compress until the middle is of the order 2.5 in
# yellow, with the polarisers along the forces and at 45° to them
$(DIR)/disc.obj: | $(DIR)
	printf '2 0\n2 0.4\n' | $(BIN)/meshgen revolve - -o $@
$(DIR)/disc.vdb: $(DIR)/disc.obj
	$(BIN)/mesh2vol $< -o $@ --ior 1.58 --resolution 128 --smooth 0
$(BUILD)/tests/stressed_disc: FORCE
	@cmake --build $(BUILD) --target stressed_disc >/dev/null
$(DIR)/stressed.vdb: $(DIR)/disc.vdb | $(BUILD)/tests/stressed_disc
	$(BUILD)/tests/stressed_disc $< $@ 2 3.68e-4
ABOVE := --eye 0,9,0 --target 0,0,0 --up 0,0,1 --ortho 4.2 --size $(STRESS_SIZE) --background 1 --unit 1e-2 \
         --samples $(STRESS_SAMPLES)
$(DIR)/stress_0.exr: $(DIR)/stressed.vdb
	$(BIN)/render $< -o $@ $(ABOVE) --polarizer 0 --back-polarizer 90 --wavelengths 16
$(DIR)/stress_45.exr: $(DIR)/stressed.vdb
	$(BIN)/render $< -o $@ $(ABOVE) --polarizer 45 --back-polarizer 135 --wavelengths 16
$(DIR)/stress.exr: $(DIR)/stress_0.exr $(DIR)/stress_45.exr
	oiiotool $(DIR)/stress_0.exr --ch R,G,B $(DIR)/stress_45.exr --ch R,G,B --mosaic 2x1 --mulc 2 -d float -o $@

$(DIR)/%.png: $(DIR)/%.exr
	oiiotool $< --ch R,G,B --colorconvert linear sRGB -d uint8 -o $@
