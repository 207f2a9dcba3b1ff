# Caption: A glass of red wine casts a coloured caustic on the table.
# Answers: 000 figure 1, left
# Small: RESOLUTION=112 SIZE=96x72 SAMPLES=1 'LIGHT_OPTIONS=--light directional:0.5,-0.86,0.44:2.6,2.5,2.3 --surface-detail 1 --max-depth 3 --photons 65536'
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := wine
RESOLUTION ?= 224
SIZE       ?= 480x360
include pipelines/gallery/common.mk

# In mm. The glass's wall is of 2 mm; the wine reaches 0.5 mm into it, where the glass rules.
MESHES         := $(MADE)/glass.obj $(MADE)/wine.obj
VOLUME_OPTIONS  = --ior 1.5 --ior 1.345 --priority 1 --priority 0 --absorption 0 --absorption 0.006,0.12,0.1 \
                  --resolution $(RESOLUTION) --ground '0:0.75,0.62,0.5' --bounds=-50,-6,-50,110,126,104
SMOOTH         := off
LIGHT_OPTIONS  ?= --light directional:0.5,-0.86,0.44:2.6,2.5,2.3 --surface-detail 1 --max-depth 7
VIEW_OPTIONS    = --eye 60,190,330 --target 14,42,10 --fov 27 --size $(SIZE) --samples $(SAMPLES) --env $(ROOM)
VIEW_FILES      = $(ROOM)
include pipelines/chain.mk

$(MADE)/profile.txt: pipelines/wineglass/profile.awk | $(WORK)
	awk -v wall=2 -f $< >$@
$(MADE)/glass.obj: pipelines/wineglass/mesh.awk $(MADE)/profile.txt
	awk -v around=256 -v along=1 -f $^ >$@
$(MADE)/wine.csv: $(HERE)/wine.awk $(MADE)/profile.txt
	awk -v level=86 -v into=0.5 -f $^ >$@
$(MADE)/wine.obj: $(MADE)/wine.csv
	$(MESHGEN) revolve $< -o $@
