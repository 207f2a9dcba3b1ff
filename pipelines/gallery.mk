# Every picture of the gallery, and a contact sheet with its caption, what it took of processors and the commands that made it.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/gallery.mk                       out/gallery/index.html
#   make -f pipelines/gallery.mk PICTURES='wine cube'  some of it
#   make -f pipelines/gallery/wine.mk                  one picture alone
SHELL := /bin/bash -o pipefail
.DELETE_ON_ERROR:
BIN  ?= build/bin
OUT  ?= out/gallery
DATA ?= data
PICTURES ?= wine amber_bunny cube logo emissive museum fresnel ground painting fluid deforming haze prism brilliant \
            crystals ring modeller
default: $(OUT)/index.html
.PHONY: default

$(OUT)/%.seconds: pipelines/gallery/%.mk pipelines/gallery/common.mk
	@mkdir -p $(@D)
	TIMEFORMAT='%U %S'; { time $(MAKE) --no-print-directory -f $< BIN=$(BIN) OUT=$(OUT) DATA=$(DATA) >$(OUT)/$*.log 2>&1; } \
	  2>$(OUT)/$*.time || { tail -3 $(OUT)/$*.log >&2; exit 1; }
	awk '{ printf "%.0f\n", $$1 + $$2 }' $(OUT)/$*.time >$@

$(OUT)/index.html: $(PICTURES:%=$(OUT)/%.seconds) pipelines/gallery/sheet.sh
	pipelines/gallery/sheet.sh $(OUT) $(PICTURES) >$@
	@echo "gallery: look at $@"
