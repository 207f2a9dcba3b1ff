# A ball of glass over an endless checkered ground in the sun.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/ball_ground.mk                                        out/ball_ground.png
#   make -f pipelines/ball_ground.mk GROUND='-0.52:0.8,0.5,0.3:checker 0.5' another ground
#   make -f pipelines/ball_ground.mk compare                                beside POV-Ray, and how far off
#
# What compares needs POV-Ray (Debian: povray) and OpenImageIO's oiiotool and idiff.
SHELL := /bin/bash
OUT    ?= out
GROUND ?= -0.52:0.8,0.75,0.65:checker 0.25
SUN    ?= directional:0.7,-0.8,0.3:3:0.53
SIZE   ?= 480x360
HERE   := pipelines
default: picture
.PHONY: default compare

NAME           := ball_ground
MESHES         := $(OUT)/$(NAME)/ball.obj
VOLUME_OPTIONS ?= --ior 1.5 --resolution 192 --ground='$(GROUND)'
SMOOTH         := off
LIGHT_OPTIONS  ?= --light $(SUN)
VIEW_OPTIONS   ?= --eye 0.4,0.45,2.3 --target 0,-0.12,0 --fov 38 --size $(SIZE) --samples 16 \
  --background 0.3,0.4,0.55
include pipelines/chain.mk

$(MESHES): | $(WORK)
	$(BIN)/meshgen sphere --radius 0.5 --segments 512 -o $@

# The scene as it is by default, by POV-Ray with photons.
$(WORK)/povray.exr: $(HERE)/povray/ball_ground.pov | $(WORK)
	@command -v povray >/dev/null || { echo "ball_ground.mk: POV-Ray is missing (Debian: povray)" >&2; exit 69; }
	cd $(WORK) && povray +I$(CURDIR)/$< +Opovray.exr +FE +W480 +H360 -D +A0.0 +AM1 +R4 2>povray.log \
	  || { tail povray.log >&2; exit 70; }

# Windows of both pictures, as oiiotool has them: the ground beside the ball, through it, and mirrored in it before
# the sky that is seen through its lower half.
compare: $(OUT)/$(NAME).exr $(WORK)/povray.exr
	@oiiotool $(OUT)/$(NAME).exr --ch R,G,B -o $(WORK)/rgb.exr
	@for window in beside=100x180+10+150 through=120x80+180+90 mirrored=80x40+165+200; do \
	  for which in rgb povray; do \
	    oiiotool $(WORK)/$$which.exr --cut $${window#*=} -o $(WORK)/$$which.$${window%=*}.exr; done; \
	  printf '%-9s mean %s, ' $${window%=*} "$$(oiiotool --stats $(WORK)/povray.$${window%=*}.exr | awk '/Stats Avg/ {print $$3}')"; \
	  idiff -a $(WORK)/rgb.$${window%=*}.exr $(WORK)/povray.$${window%=*}.exr | grep 'Mean error'; done; true
	@oiiotool $(WORK)/rgb.exr $(WORK)/povray.exr --sub --abs --mulc 10 -o $(WORK)/difference.exr
	@oiiotool $(WORK)/rgb.exr $(WORK)/povray.exr $(WORK)/difference.exr --mosaic:pad=4 3x1 \
	  --colorconvert linear sRGB -o $(WORK)/both.png
