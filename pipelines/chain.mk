# One picture from meshes, with files as dependencies: only what a change touches runs again.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Set these, then include this file:
#   NAME            of the picture: $(OUT)/$(NAME).exr and .png
#   MESHES          mesh files
#   VOLUME_OPTIONS  mesh2vol's: materials, resolution       (a change runs everything again)
#   SMOOTH          off: without volsmooth, which sharp boundaries don't need
#   SMOOTH_OPTIONS  volsmooth's                             (volsmooth, lightsim, render)
#   LIGHT_OPTIONS   lightsim's: lights, photons             (lightsim, render)
#   VIEW_OPTIONS    render's: camera, background, exposure  (render alone)
#   VIEW_FILES      files that render's options name
# Options may also be given on make's command line. Each is kept in a file that is rewritten only
# when the text changes, so that a new option counts like a new input.
SHELL := /bin/bash
.DELETE_ON_ERROR:
BIN  ?= build/bin
OUT  ?= out
WORK := $(OUT)/$(NAME)
SMOOTH ?= on
UNLIT := $(WORK)/$(if $(filter off,$(SMOOTH)),volume,smooth).vdb

.PHONY: picture FORCE
picture: $(OUT)/$(NAME).exr $(OUT)/$(NAME).png

$(WORK):
	@mkdir -p $@

$(WORK)/%.options: FORCE | $(WORK)
	@printf '%s\n' '$(subst ','\'',$($(*)))' >$@.new; \
	if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

$(WORK)/volume.vdb: $(MESHES) $(WORK)/VOLUME_OPTIONS.options
	$(BIN)/mesh2vol $(MESHES) -o $@ $(VOLUME_OPTIONS) --stats $(@:.vdb=.json)

$(WORK)/smooth.vdb: $(WORK)/volume.vdb $(WORK)/SMOOTH_OPTIONS.options
	$(BIN)/volsmooth $< -o $@ $(SMOOTH_OPTIONS) --stats $(@:.vdb=.json)

$(WORK)/light.vdb: $(UNLIT) $(WORK)/LIGHT_OPTIONS.options
	$(BIN)/lightsim $< -o $@ $(LIGHT_OPTIONS) --stats $(@:.vdb=.json)

# One run makes both pictures.
$(OUT)/$(NAME).exr $(OUT)/$(NAME).png &: $(WORK)/light.vdb $(VIEW_FILES) $(WORK)/VIEW_OPTIONS.options
	$(BIN)/render $< -o $(OUT)/$(NAME).exr -o $(OUT)/$(NAME).png $(VIEW_OPTIONS) \
	  --stats $(WORK)/view.json
