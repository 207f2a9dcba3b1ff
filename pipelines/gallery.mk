# Every picture of the gallery, and a contact sheet with its caption, how long it took and the commands that made it.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/gallery.mk                       out/gallery/index.html
#   make -f pipelines/gallery.mk PICTURES='wine cube'  some of it
#   make -f pipelines/gallery/wine.mk                  one picture alone
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
.NOTPARALLEL: # so that what each takes is its own
BIN  ?= build/bin
OUT  ?= out/gallery
DATA ?= data
PICTURES ?= wine amber_bunny cube logo emissive museum fresnel ground painting fluid deforming haze prism brilliant \
            ring modeller
default: $(OUT)/index.html
.PHONY: default
.SECONDARY:

$(OUT)/%.seconds: pipelines/gallery/%.mk pipelines/gallery/common.mk
	@mkdir -p $(@D)
	began=$$(date +%s); $(MAKE) --no-print-directory -f $< BIN=$(BIN) OUT=$(OUT) DATA=$(DATA) | tee $(OUT)/$*.log && \
	  echo $$(( $$(date +%s) - began )) >$@

$(OUT)/index.html: $(PICTURES:%=$(OUT)/%.seconds) pipelines/gallery/sheet.sh
	pipelines/gallery/sheet.sh $(OUT) $(PICTURES) >$@
	@echo "gallery: look at $@"
