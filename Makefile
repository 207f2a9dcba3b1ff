# The front door: make, make demo, make test, make test-all, make bench, make accuracy, make scale,
# make gallery, make effects, make instructions, make fuzz, make docs, make format, make bundle.
SHELL := /bin/bash
.DELETE_ON_ERROR:
.DEFAULT_GOAL := all

BUILD  ?= build
OUT    ?= out
PREFIX ?= /usr/local
JOBS   ?= $(shell nproc)
TOOLS  := meshgen mesh2vol sim2vol volpaint volsmooth lightsim render

.PHONY: all stages packages configure demo animation gallery test test-all bench accuracy scale effects \
        instructions fuzz docs golden format install bundle clean

all: configure
	cmake --build $(BUILD) -j $(JOBS)

# The tools alone, as pipelines want them.
stages: configure
	cmake --build $(BUILD) -j $(JOBS) --target stages

configure:
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Release >$(BUILD).log 2>&1 \
	  || { cat $(BUILD).log; exit 1; }; mkdir -p $(BUILD); mv $(BUILD).log $(BUILD)/configure.log

# Installs what packages.txt lists and this machine lacks; names it where there is no apt.
packages:
	@pipelines/install_packages.sh packages.txt

# A real scanned mesh, lit and seen: out/bunny.exr and out/bunny.png.
demo: packages
	$(MAKE) stages
	$(MAKE) -f pipelines/bunny.mk BIN=$(BUILD)/bin OUT=$(OUT)
	@echo "demo: look at $(OUT)/bunny.png ($(OUT)/bunny.exr has the radiance)"

# Bodies that deform, in image space beside the same frames through volumes: out/animation/contact.png,
# and a film where ffmpeg is.
animation: packages
	$(MAKE) stages
	$(MAKE) -j $(JOBS) -f pipelines/animation.mk BIN=$(BUILD)/bin OUT=$(OUT)

# The sources' own scenes and others, with what each took: out/gallery/index.html.
gallery: packages
	$(MAKE) stages
	$(MAKE) -j $(JOBS) -f pipelines/gallery.mk BIN=$(BUILD)/bin OUT=$(OUT)/gallery

# In two minutes what a change most likely breaks; test-all takes some more for the long suites.
CTEST := ctest --output-on-failure -j $(JOBS)

test: packages
	$(MAKE) all
	cd $(BUILD) && $(CTEST) -LE long

test-all: packages
	$(MAKE) all
	cmake --build $(BUILD) -j $(JOBS) --target bench accuracy effects
	cd $(BUILD) && $(CTEST)

# Every fuzzing target of tests/fuzz for so many seconds, built with clang's sanitizers.
SECONDS ?= 60
fuzz: packages
	@command -v clang++ >/dev/null || { echo "make fuzz: needs clang (Debian: clang)"; exit 69; }
	cmake -S . -B build-fuzz -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
	  -DEIKONAL_FUZZ=ON >/dev/null
	cmake --build build-fuzz -j $(JOBS)
	pipelines/fuzz.sh build-fuzz $(SECONDS) $(OUT)/fuzz

# Ratios within one run, in a table and in out/bench.json.
bench: packages
	$(MAKE) all
	cmake --build $(BUILD) -j $(JOBS) --target bench
	$(MAKE) -f pipelines/bunny.mk OUT=$(OUT) data/bunny.off
	$(MAKE) -f pipelines/models.mk
	$(BUILD)/tests/bench --json $(OUT)/bench.json --bin $(BUILD)/bin --work $(OUT)/bench \
	  --bunny data/bunny.off --meshes data
	jq -r '.images[] | [.polygons, ."dir device [fps]", ."isr device [fps]", ."sir device [fps]"] | @csv' \
	  $(OUT)/bench.json >$(OUT)/image_space.csv
	gnuplot -e "rows='$(OUT)/image_space.csv'; page='docs/image_space_rates.svg'" pipelines/image_space.gp

# What every knob that trades accuracy for time costs and gives: docs/accuracy.md and its plots.
# ACCURACY=quick takes minutes, full most of an hour; stopped, it goes on where it was.
ACCURACY ?= full
accuracy: packages
	$(MAKE) all
	cmake --build $(BUILD) -j $(JOBS) --target accuracy
	mkdir -p docs/accuracy
	$(BUILD)/tests/accuracy --work $(OUT)/accuracy --json $(OUT)/accuracy.json --effort $(ACCURACY) \
	  --page docs/accuracy.md
	gnuplot -e "work='$(OUT)/accuracy'; docs='docs/accuracy'" pipelines/accuracy.gp

# What more voxels, pixels, photons, lights, objects, triangles cost: docs/scale.md. SCALE="lights objects"
# makes those tables anew and takes the others from the last run.
scale: packages
	$(MAKE) all
	$(MAKE) -f pipelines/bunny.mk OUT=$(OUT) data/bunny.off
	pipelines/scale.sh $(BUILD)/bin data/bunny.off $(OUT)/scale docs/scale.md '$(SCALE)'
	gnuplot -e "work='$(OUT)/scale'; page='docs/scale.svg'" pipelines/scale.gp

# What each effect costs, and what kernels without it leave out: docs/effects.md, out/effects.json.
effects: packages
	$(MAKE) all
	cmake --build $(BUILD) -j $(JOBS) --target effects
	mkdir -p $(OUT)
	$(BUILD)/tests/effects --json $(OUT)/effects.json --page docs/effects.md --work $(OUT)/effects

# The counts that test_effects holds kernels to, anew; look at what changed before committing.
instructions: packages
	$(MAKE) all
	cmake --build $(BUILD) -j $(JOBS) --target effects
	$(BUILD)/tests/effects --instructions tests/effects/instructions.txt --work $(OUT)/effects

# docs/tools/*.md from --help, the tables of shaders/README.md from the shared headers.
docs: all
	@pipelines/tool_docs.sh $(BUILD)/bin docs/tools $(TOOLS)
	@pipelines/shader_docs.sh shaders

# The test suite's golden pictures anew; look at them before committing.
golden: all
	bash tests/pipeline/update_golden.sh $(BUILD)

format:
	git ls-files '*.cpp' '*.h' | xargs clang-format -i

install: all
	cmake --install $(BUILD) --prefix $(PREFIX)

# The tools with every library they need but the driver's own, to run on another machine.
bundle: all
	pipelines/bundle.sh $(BUILD) $(OUT)/eikonal-bundle

clean:
	rm -rf $(BUILD)
