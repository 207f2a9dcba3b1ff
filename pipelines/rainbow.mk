# White light through a slit and a prism, in thin smoke and on a white wall: with dense flint above, with crown
# glass below.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/rainbow.mk               out/rainbow.png
#   make -f pipelines/rainbow.mk GLASSES=f2    another glass, by the names of docs/materials.md
#   make -f pipelines/rainbow.mk lines         where three wavelengths meet the wall, beside Snell's law
#   make -f pipelines/rainbow.mk bands         how far off fewer wavelengths are on the wall, and out/rainbow_bands.png
#
# The wall's colours are pure: WALL = 16 parts of the spectrum. Smoke blurs them, SMOKE = 8 are enough. The wall's dim
# light comes by itself: --proxy sends the other through the slit alone.
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
BIN     ?= build/bin
OUT     ?= out
GLASSES ?= sf10 bk7
WALL    ?= 16
SMOKE   ?= 8
SIZE    ?= 480x272
COUNTS  ?= 4 8 16 32 64
HERE    := pipelines/rainbow
WORK    := $(OUT)/rainbow
LIGHT   := directional:0.867765,0.496974,0:3
DIM     := directional:-0.1,-1,-0.5:0.06
VIEW    := --eye=-1.6,0.8,4.6 --target=0.2,-0.36,0 --fov 23.5 --exposure 3.6 --tone filmic --samples 4
OPAQUE  := --material none --ior none --ior 1 --opacity none --opacity 1 --albedo none --albedo 0.8 --smooth 0
DOMAIN  := --bounds=-1.3,-1.3,-0.4,1.76,0.6,0.4
# The wall's middle, a pixel a thousandth of the unit.
COLUMN  := --eye 1,-0.8,0 --target 2,-0.8,0 --ortho 0.6 --size 1x600
default: $(OUT)/rainbow.png
.PHONY: default lines bands
.SECONDARY:

$(WORK)/prism.obj:
	@mkdir -p $(@D)
	$(BIN)/meshgen prism --side 0.7 --length 0.68 -o $@

$(WORK)/stage.obj: $(HERE)/stage.awk
	@mkdir -p $(@D)
	awk -f $< >$@

# Round the way of the light before the slit.
$(WORK)/proxy.obj:
	@mkdir -p $(@D)
	$(BIN)/meshgen box --from=-1.29,-0.62,-0.24 --to=-1.25,-0.42,0.24 -o $@

# Dark, but for what the prism mirrors from behind the viewer.
$(WORK)/environment.exr: pipelines/rainbow.mk
	@mkdir -p $(@D)
	oiiotool --pattern constant:color=0,0,0 256x128 3 --fill:color=0.025,0.027,0.03 60x60+90+20 \
	  --fill:color=0.08,0.08,0.08 16x50+64+20 --fill:color=0.05,0.05,0.05 20x20+150+10 --blur 9x9 -d float -o $@

$(WORK)/%_smoke.vdb: $(WORK)/prism.obj $(WORK)/stage.obj $(WORK)/proxy.obj
	$(BIN)/mesh2vol $(WORK)/prism.obj $(WORK)/stage.obj -o - --quiet --material $* $(OPAQUE) $(DOMAIN) \
	  --resolution 224 --medium-scattering 0.7 --medium-anisotropy 0.3 >$(WORK)/$*.vdb
	$(BIN)/lightsim $(WORK)/$*.vdb -o $@ --light $(LIGHT) --outputs fluence,light_direction \
	  --wavelengths $(SMOKE) --photons 262144 --proxy $(WORK)/proxy.obj

$(WORK)/%_wall.vdb: $(WORK)/%_smoke.vdb
	$(BIN)/lightsim $(WORK)/$*.vdb -o $@ --light $(LIGHT) --outputs irradiance \
	  --wavelengths $(WALL) --proxy $(WORK)/proxy.obj

$(WORK)/%_dim.vdb: $(WORK)/%_smoke.vdb
	$(BIN)/lightsim $(WORK)/$*.vdb -o $@ --light $(DIM) --outputs irradiance --wavelengths 1

$(WORK)/%.png: $(WORK)/%_smoke.vdb $(WORK)/%_wall.vdb $(WORK)/%_dim.vdb $(WORK)/environment.exr
	$(BIN)/render $(filter %.vdb,$^) -o $@ $(VIEW) --size $(SIZE) --env $(WORK)/environment.exr

$(OUT)/rainbow.png: $(GLASSES:%=$(WORK)/%.png)
	oiiotool $^ --mosaic:pad=4 1x$(words $(GLASSES)) -o $@

# Without smoke, for what can be reckoned by hand.
GLASS := $(firstword $(GLASSES))
$(WORK)/clear.vdb: $(WORK)/prism.obj $(WORK)/stage.obj
	$(BIN)/mesh2vol $^ -o $@ --material $(GLASS) $(OPAQUE) $(DOMAIN) --resolution 256

$(WORK)/points.exr: $(WORK)/clear.vdb
	$(BIN)/render $< -o $@ $(COLUMN) --aov position,normal --quiet

$(WORK)/column_%.txt: $(WORK)/clear.vdb $(WORK)/points.exr
	$(BIN)/lightsim $< -o $(WORK)/column.exr --at $(WORK)/points.exr --light $(LIGHT) --wavelengths $*
	oiiotool $(WORK)/column.exr --ch irradiance.R,irradiance.G,irradiance.B -o $(WORK)/column_$*.exr
	oiiotool --dumpdata $(WORK)/column_$*.exr >$@

# mesh2vol tells the index and Cauchy's B.
lines: $(WORK)/column_486.1.txt $(WORK)/column_587.6.txt $(WORK)/column_656.3.txt
	@read ior dispersion < <($(BIN)/mesh2vol $(WORK)/prism.obj -o unused.vdb --material $(GLASS) --explain | \
	  sed -n 's/^material.*ior \([0-9.]*\), dispersion \([0-9.]*\)/\1 \2/p'); \
	for nm in 486.1 587.6 656.3; do \
	  awk -v nm=$$nm -v ior=$$ior -v dispersion=$$dispersion -v top=-0.5 -v pixel=0.001 -f $(HERE)/snell.awk \
	    $(WORK)/column_$$nm.txt; \
	done

bands: $(OUT)/rainbow_bands.png
	@for n in $(COUNTS); do echo "$$n wavelengths: off by" \
	  $$(awk -f $(HERE)/rms.awk $(WORK)/column_$$n.txt $(WORK)/column_64.txt); done

$(OUT)/rainbow_bands.png: $(sort $(COUNTS:%=$(WORK)/column_%.txt) $(WORK)/column_64.txt)
	oiiotool $(foreach n,$(COUNTS),$(WORK)/column_$(n).exr --cut 1x320+0+210 --resize:filter=box 92x320) \
	  --mosaic:pad=4 $(words $(COUNTS))x1 --mulc 0.7 --colorconvert linear sRGB -o $@
