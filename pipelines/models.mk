# Scanned and modelled meshes of Debian's CGAL demos, for the table of methods in image space.
# SPDX-License-Identifier: GPL-3.0-or-later
#
#   make -f pipelines/models.mk         data/armadillo.off and others
SHELL  := /bin/bash -o pipefail
.DELETE_ON_ERROR:
DATA   ?= data
MODELS := armadillo bunny00 refined_elephant bear man camel
default: $(MODELS:%=$(DATA)/%.off)
.PHONY: default

# Slim images drop /usr/share/doc on installation, so the package itself is unpacked.
$(MODELS:%=$(DATA)/%.off) &:
	@mkdir -p $(DATA)/models.new
	cd $(DATA)/models.new && chmod a+rwx . && apt-get download -qq libcgal-demo && \
	  dpkg-deb --fsys-tarfile libcgal-demo_*.deb | tar -xO ./usr/share/doc/libcgal-dev/data.tar.gz \
	  | tar -xz --strip-components=2 $(MODELS:%=data/meshes/%.off)
	mv $(MODELS:%=$(DATA)/models.new/%.off) $(DATA)/
	rm -r $(DATA)/models.new
