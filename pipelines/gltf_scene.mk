# A scene modelled in Blender, by three commands and no number of its matter, lights or camera.
#   make -f pipelines/gltf_scene.mk [SCENE=scene.glb] [RESOLUTION=176] [SIZE=320x240] [SAMPLES=4] [BIN=build/bin] [OUT=out]
# pipelines/gltf_scene/scene.py made scene.glb.
# SPDX-License-Identifier: GPL-3.0-or-later
BIN        ?= build/bin
OUT        ?= out
SCENE      ?= pipelines/gltf_scene/scene.glb
RESOLUTION ?= 176
SIZE       ?= 320x240
SAMPLES    ?= 4
DIR        := $(OUT)/gltf_scene
.DELETE_ON_ERROR:
.PHONY: all
all: $(DIR)/scene.png
	@echo "gltf_scene: look at $<"

$(DIR):
	mkdir -p $@
# A dim room, for what glass and metal mirror.
$(DIR)/room.exr: | $(DIR)
	oiiotool --pattern fill:top=0.45,0.52,0.65:bottom=0.05,0.045,0.04 256x128 3 -d float -o $@
$(DIR)/scene.vdb: $(SCENE) | $(DIR)
	$(BIN)/mesh2vol $< -o $@ --resolution $(RESOLUTION)
$(DIR)/lit.vdb: $(DIR)/scene.vdb $(SCENE)
	$(BIN)/lightsim $< -o $@ --lights $(SCENE)
$(DIR)/scene.png: $(DIR)/lit.vdb $(SCENE) $(DIR)/room.exr
	$(BIN)/render $< -o $@ --camera $(SCENE) --env $(DIR)/room.exr --size $(SIZE) --samples $(SAMPLES)
