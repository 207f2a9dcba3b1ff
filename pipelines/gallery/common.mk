# What the gallery's pictures share. Set NAME before.
# SPDX-License-Identifier: GPL-3.0-or-later
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
BIN     ?= build/bin
OUT     ?= out/gallery
DATA    ?= data
SAMPLES ?= 3
HERE    := pipelines/gallery
MADE    := $(OUT)/$(NAME)
MESHGEN := $(BIN)/meshgen
default: picture
.PHONY: default

# A dark room: a soft box above to the left, a window to the right, a bright wall behind what is looked at.
ROOM := $(OUT)/room.exr
$(ROOM):
	@mkdir -p $(@D)
	oiiotool --pattern fill:top=0.05,0.06,0.08:bottom=0.03,0.025,0.02 256x128 3 \
	  --fill:color=0.55,0.6,0.66 75x38+3+30 --fill:color=0.55,0.6,0.66 75x38+181+30 --blur 23x23 --resize 1024x512 \
	  --fill:color=7,6.7,6.2 150x90+560+40 --fill:color=2.5,3,3.8 70x130+280+120 \
	  --fill:color=1.2,1.2,1.2 240x60+60+20 --blur 5x5 -d float -o $(@D)/.room.$(NAME).exr
	mv $(@D)/.room.$(NAME).exr $@

# Captured surroundings: Greg Zaal's courtyard and city, CC0, of Debian's Blender.
$(DATA)/courtyard.exr $(DATA)/city.exr &:
	@mkdir -p $(DATA)/blender
	cd $(DATA)/blender && chmod a+rwx . && { ls blender-data_*.deb >/dev/null 2>&1 || apt-get download -qq blender-data; }
	for name in courtyard city; do \
	  dpkg-deb --fsys-tarfile $(DATA)/blender/blender-data_*.deb \
	    | tar -xO ./usr/share/blender/datafiles/studiolights/world/$$name.exr >$(DATA)/.$$name.exr && \
	  mv $(DATA)/.$$name.exr $(DATA)/$$name.exr || exit 1; done
	rm -r $(DATA)/blender
