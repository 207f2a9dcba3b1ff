# The demo: the Stanford bunny as amber glass on a plinth, under a directional light.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/bunny.mk                                     everything that is missing
#   make -f pipelines/bunny.mk LIGHT='directional:-0.4,-1,0:3'    lightsim and render
#   make -f pipelines/bunny.mk SIZE=1280x960                       render alone
SHELL := /bin/bash
OUT   ?= out
LIGHT ?= directional:0.5,-1,-0.3:3.2,3,2.7
SIZE  ?= 640x480
default: picture
.PHONY: default
include pipelines/bunny_scene.mk

NAME           := bunny
MESHES         := $(BUNNY) $(PLINTH)
VOLUME_OPTIONS ?= $(BUNNY_VOLUME)
SMOOTH         ?= off
LIGHT_OPTIONS  ?= --light $(LIGHT) --photons 131072
VIEW_OPTIONS   ?= $(BUNNY_VIEW) --size $(SIZE) --samples 4 --env $(STUDIO)
VIEW_FILES     := $(STUDIO)
include pipelines/chain.mk
