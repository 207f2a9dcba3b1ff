# Caption: Hot air over a street: a photograph seen through a simulation's temperature, and how far it turns each ray.
# Answers: 003 figure 1 (media that mix), and what schlieren and background-oriented pictures are made of
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := haze
RESOLUTION ?= 224
SIZE       ?= 480x320
WARMER     ?= 350
include pipelines/gallery/common.mk
VIEW := --eye 0,0.7,30 --target 0,0.7,0 --fov 2.6 --size $(SIZE)
picture: $(OUT)/haze.png
.PHONY: picture
.SECONDARY:

# It stands in for a simulation: pockets of warm air, fewer further up; its grid is 1 within and 0 outside.
$(MADE)/low.obj $(MADE)/high.obj: $(MADE)/%.obj: $(MADE)/%_box.obj
	$(MESHGEN) flecks $< --count $(if $(findstring low,$*),420,150) --radius 0.11 --flat 0.4 --seed 5 -o $@
$(MADE)/low_box.obj:
	@mkdir -p $(@D)
	$(MESHGEN) box --from=-1.2,-0.05,-1 --to 1.2,0.6,1 -o $@
$(MADE)/high_box.obj:
	@mkdir -p $(@D)
	$(MESHGEN) box --from=-1.2,0.55,-1 --to 1.2,1.4,1 -o $@
$(MADE)/simulation.vdb: $(MADE)/low.obj $(MADE)/high.obj
	$(BIN)/mesh2vol $^ -o - --ior 1 --opacity 1 --boundary blurred --resolution $(RESOLUTION) --smooth 0 | \
	  $(BIN)/volsmooth - -o $@ --grids opacity --sigma 4
$(MADE)/air.vdb: $(MADE)/simulation.vdb
	$(BIN)/sim2vol $< -o $@ --ior-from opacity:air --kelvin $(WARMER):293.15 --opacity-from opacity:0

# A part of the city, as a long lens takes it.
$(MADE)/photo.exr: $(DATA)/city.exr
	@mkdir -p $(@D)
	oiiotool $< --cut 330x220+620+130 -o $@
$(OUT)/haze.exr $(OUT)/haze.png &: $(MADE)/air.vdb $(MADE)/photo.exr
	$(BIN)/render $< -o $(OUT)/haze.exr -o $(OUT)/haze.png $(VIEW) --samples $(SAMPLES) \
	  --plate $(MADE)/photo.exr --plate-distance 130 --aov deflection --exposure=-0.3
