# Caption: A scene modelled in Blender, by three commands and no number typed.
# Answers: no figure: the way scenes come to these tools
# SPDX-License-Identifier: GPL-3.0-or-later
NAME       := modeller
RESOLUTION ?= 176
SIZE       ?= 480x360
include pipelines/gallery/common.mk
picture: $(OUT)/modeller.png
.PHONY: picture
$(OUT)/modeller.png:
	$(MAKE) -f pipelines/gltf_scene.mk BIN=$(BIN) OUT=$(MADE) SIZE=$(SIZE) RESOLUTION=$(RESOLUTION) SAMPLES=$(SAMPLES)
	cp $(MADE)/gltf_scene/scene.png $@
