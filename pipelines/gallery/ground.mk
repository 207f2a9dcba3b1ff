# Caption: A ball of glass over a plane in the sun, held to POV-Ray in numbers (make -f pipelines/ball_ground.mk compare).
# Answers: 000 figure 7
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := ground
RESOLUTION ?= 160
SIZE       ?= 480x360
include pipelines/gallery/common.mk
picture: $(OUT)/ground.png
.PHONY: picture
$(OUT)/ground.png:
	$(MAKE) -f pipelines/ball_ground.mk BIN=$(BIN) OUT=$(MADE) SIZE=$(SIZE) \
	  VOLUME_OPTIONS='--ior 1.5 --resolution $(RESOLUTION) --ground="-0.52:0.8,0.75,0.65:checker 0.25"'
	cp $(MADE)/ball_ground.png $@
