# A wavefront through a wine glass, cut along its axis: after every step of time where the front is, and how
# bright.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/fronts.mk                            out/fronts.png
#   make -f pipelines/fronts.mk LIGHT=directional:1,-1,0   another light
#
# Needs gnuplot.
SHELL := /bin/bash
.DELETE_ON_ERROR:
BIN   ?= build/bin
OUT   ?= out
LIGHT ?= directional:1,-0.15,0
RESOLUTION ?= 112
HERE  := pipelines/wineglass
WORK  := $(OUT)/fronts
default: $(OUT)/fronts.png
.PHONY: default

$(WORK)/profile.txt: $(HERE)/profile.awk
	@mkdir -p $(@D)
	awk -f $< >$@

$(WORK)/glass.obj: $(HERE)/mesh.awk $(WORK)/profile.txt
	awk -f $^ >$@

$(WORK)/glass.vdb: $(WORK)/glass.obj
	$(BIN)/mesh2vol $< -o - --ior 1.5 --boundary blurred --resolution $(RESOLUTION) --quiet | \
	  $(BIN)/volsmooth - -o $@

$(WORK)/lit.vdb: $(WORK)/glass.vdb
	rm -rf $(WORK)/front
	$(BIN)/lightsim $< -o $@ --method wavefront --outputs fluence --light $(LIGHT) --step 3 \
	  --dump-fronts $(WORK)/front

# Of each quad its corners, then its face's record, whose last four bytes are the irradiance.
$(WORK)/cut.txt: $(WORK)/lit.vdb pipelines/fronts.awk
	voxel=$$(vdb_print -l $(WORK)/glass.vdb | awk '/voxel size:/ { print $$3; exit }'); \
	for file in $(WORK)/front/*.ply; do \
	  corners=$$(head -c 200 $$file | LC_ALL=C awk '/^element vertex/ { print $$3; exit }'); \
	  begin=$$(($$(LC_ALL=C grep -abom1 end_header $$file | cut -d: -f1) + 11)); \
	  paste <(tail -c +$$((begin + 1)) $$file | head -c $$((12 * corners)) | od -An -v -t f4 -w48) \
	        <(tail -c +$$((begin + 1 + 12 * corners)) $$file | od -An -v -t u1 -w25); \
	done | awk -v near=$$voxel -f pipelines/fronts.awk >$@

$(OUT)/fronts.png: pipelines/fronts.gp $(WORK)/cut.txt
	gnuplot -e "cut='$(WORK)/cut.txt'; picture='$@'" $<
