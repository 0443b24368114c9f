# VisualScheme. `make help` lists the targets; V=1 shows the commands that are run.
#
# Folders are layers (manual/internals.md); the objects of every layer but cli/ go into build/libvisualscheme.a, which `vs` links.
# BUILD=dir keeps builds apart: asan and ubsan use build/asan and build/ubsan. EXTRA adds compiler flags, OPT replaces -O2 -g.

CC       ?= cc
BUILD    ?= build
PREFIX   ?= /usr/local
LIB      ?= lib
STRIP    ?= strip
OPT      ?= -O2 -g
PIC      ?= -fPIC
VERSION   = $(shell sed -n 's/^.define VS_VERSION "\(.*\)"/\1/p' visualscheme.h)
WARN      = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror=incompatible-pointer-types -Werror=int-conversion -Werror=implicit-function-declaration
CFLAGS   += -std=c11 -D_POSIX_C_SOURCE=200809L $(OPT) $(WARN) -ffp-contract=off -fvisibility=hidden -fno-math-errno $(PIC) -I. $(EXTRA)

# Where linker and loader know it, the tables' pointers stand in the program as a bitmap: a start reads 2 KB for them and not 290.
PACKED    = -Wl,-z,pack-relative-relocs,--fatal-warnings
PACK      = $(shell p=$$(mktemp) && echo 'int main(void) { return 0; }' | $(CC) -xc - -o $$p $(PACKED) 2> /dev/null && $$p && echo '$(PACKED)'; rm -f $$p)

# A line of a few words for each command; V=1 shows the command instead.
Q         = $(if $(V),,@)
say       = $(if $(V),@:,@echo "  $(1)")

# Asked when a recipe needs them, so that this file can be read before pkg-config is installed. A package that pkg-config does not know gets its usual name.
pkg       = $(shell pkg-config --libs $(1) 2>/dev/null || echo $(2))
LDLIBS   += $(call pkg,gmp libutf8proc,-lgmp -lutf8proc) -lm -lpthread -ldl
PNG_LIBS  = $(call pkg,libpng,-lpng)
UNIT_LIBS = $(call pkg,cmocka jansson zlib,-lcmocka -ljansson -lz)

LAYERS    = languages/javascript vm model geometry kernel solids passes bind backends session
LIB_SRC   = $(foreach d,$(LAYERS),$(wildcard $(d)/*.c $(d)/*/*.c))
LIB_OBJ   = $(LIB_SRC:%.c=$(BUILD)/obj/%.o) $(BUILD)/obj/assets.o
CLI_OBJ   = $(patsubst %.c,$(BUILD)/obj/%.o,$(wildcard cli/*.c cli/*/*.c live/*.c $(filter-out languages/javascript/%,$(wildcard languages/*/*.c)))) $(BUILD)/live_assets.o
FUZZERS   = reader text program forms script import emit calls live
UNIT_SRC  = $(wildcard tests/unit/test_*.c)
UNIT_BIN  = $(UNIT_SRC:tests/unit/%.c=$(BUILD)/unit/%)
TOOL_BIN  = $(patsubst tests/tools/%.c,$(BUILD)/tools/%,$(wildcard tests/tools/*.c)) $(BUILD)/tools/fuzz $(FUZZERS:%=$(BUILD)/tools/replay_%)
OBJECTS   = $(LIB_OBJ) $(CLI_OBJ)

# Files that go into the library as they are: NAME.EXT is const char vs_asset_NAME_EXT[] up to vs_asset_NAME_EXT_end[]. They have a section of their
# own, vs_files, so that the constants that a start reads lie together. The viewer's scripts are bundled with three.js by esbuild, both from npm (scripts/install.sh). A
# release has the bundles in bundled/ (scripts/dist.sh). Without either the bundle is empty, and writing a page says so.
ASSETS    = backends/page/page.html backends/page/viewer.css $(BUILD)/viewer.js backends/autolisp/definitions.lsp
ESBUILD   = $(firstword $(wildcard node_modules/@esbuild/*/bin/esbuild))
BUNDLE    = $(ESBUILD) --bundle --minify --format=iife --target=es2022 --legal-comments=eof --log-level=warning
UNBUNDLED = if [ -f bundled/$(@F) ]; then cp bundled/$(@F) $@; else : > $@; fi

# A recipe that fails, as on a full disk, leaves no target that the next make takes for finished.
.DELETE_ON_ERROR:

all: $(BUILD)/libvisualscheme.a $(BUILD)/vs ## build the library and the program, build/vs

# FreeType's headers have a folder of their own. The library itself is loaded when the first text is made.
$(BUILD)/obj/geometry/text/font.o: CFLAGS += $(shell pkg-config --cflags freetype2 2>/dev/null || echo -I/usr/include/freetype2)

# OpenEXR's headers have one, too; its library is loaded with the first EXR picture.
$(BUILD)/obj/geometry/files/exr.o $(BUILD)/obj/geometry/files/exr_read.o $(BUILD)/obj/geometry/files/exr_library.o: CFLAGS += $(shell pkg-config --cflags-only-I OpenEXR 2>/dev/null || echo -I/usr/include/OpenEXR)

$(BUILD)/obj/%.o: %.c
	@mkdir -p $(@D)
	$(call say,cc    $<)
	$(Q)$(CC) $(CFLAGS) -MMD -MP -c $< -o $@

# A twentieth of the time of large models, and half of that of kept expressions; elsewhere -O3 gains nothing.
$(BUILD)/obj/geometry/functions/%.o $(BUILD)/obj/kernel/%.o $(BUILD)/obj/solids/%.o: OPT := $(OPT:-O2=-O3)

# gcc would make the ends of all instructions one: a jump to a jump, and one guess where to go next instead of one each.
# Values that gcse shares over the whole function fill the registers, and the frame's address is left without one.
$(BUILD)/obj/vm/machine/run_loop.o: CFLAGS += $(if $(findstring clang,$(shell $(CC) --version)),,-fno-crossjumping -fno-gcse -fno-tree-pre -fno-ivopts --param max-goto-duplication-insns=20 --param max-grow-copy-bb-insns=50)

LIVE_ASSETS = backends/page/live/live.html $(BUILD)/live.css $(BUILD)/live.js cli/sweep/parallel_coordinates.js cli/sweep/scatter.js

$(BUILD)/viewer.js: backends/page/page.js $(wildcard backends/page/*.js) package.json $(wildcard node_modules/.package-lock.json)
	@mkdir -p $(@D)
	@if [ -n "$(ESBUILD)" ]; then $(BUNDLE) $< --outfile=$@; else $(UNBUNDLED); fi

# three.js and fflate name themselves in comments that esbuild keeps; what else is bundled stands in NOTICE.
$(BUILD)/live.js: backends/page/live/served.js $(wildcard backends/page/*.js backends/page/live/*.js) package.json NOTICE $(wildcard node_modules/.package-lock.json)
	@mkdir -p $(@D)
	@if [ -n "$(ESBUILD)" ]; then $(BUNDLE) --footer:js="/*! $$(awk '/^[^ ]/ { on = /^Embedded/ } on' NOTICE) */" $< --outfile=$@; else $(UNBUNDLED); fi

$(BUILD)/live.css: backends/page/live/live.css backends/page/viewer.css
	@mkdir -p $(@D)
	@{ cat backends/page/viewer.css; sed '/^@import/d' backends/page/live/live.css; } > $@

# An assembler file with the bytes of files: of each its name, then the file.
EMBED     = sh scripts/embed.sh $(if $(findstring emcc,$(CC)),wasm,elf)
named     = $(foreach f,$(1),vs_asset_$(subst -,_,$(subst .,_,$(notdir $(f)))) $(f))

$(BUILD)/assets.s: $(ASSETS) scripts/embed.sh
	@$(EMBED) 1 $(call named,$(ASSETS)) > $@

# The playground serves no page: there these files are absent, and so empty.
$(BUILD)/live_assets.s: $(LIVE_ASSETS) scripts/embed.sh
	@$(EMBED) 1 $(call named,$(addprefix $(if $(findstring emcc,$(CC)),absent/),$(LIVE_ASSETS))) > $@

$(BUILD)/live_assets.o: $(BUILD)/live_assets.s
	$(call say,as    $<)
	$(Q)$(CC) -c $< -o $@

# The heap image: a stage-0 interpreter, made of the same objects, loads the language's own sources and writes down what it then holds.
LIBRARY = prelude.scm library/srfi.scm bind/geometry.scm bind/primitives.scm bind/data.scm bind/back_ends.scm bind/rules/rules.scm bind/functions/functions.scm bind/shapes/shapes.scm bind/shapes/maps.scm bind/shapes/implicits.scm bind/shapes/panels.scm bind/shapes/prefabs.scm bind/shapes/nets.scm bind/shapes/probes.scm bind/shapes/engraving.scm bind/shapes/flattening.scm bind/solids/whole_solids.scm bind/solids/edges.scm bind/solids/fillets.scm bind/solids/hollow.scm bind/workshop/workshop.scm bind/workshop/tables.scm bind/workshop/cutting_sheets.scm bind/workshop/frames.scm bind/incoming/load_outline.scm bind/incoming/load_dxf.scm bind/incoming/load_svg.scm bind/incoming/load_model.scm bind/incoming/load_glb.scm bind/incoming/load_3mf.scm bind/incoming/load_x3d.scm bind/scene/properties.scm bind/scene/nodes.scm bind/scene/actions.scm bind/scene/contexts.scm bind/scene/interaction.scm
STAGE0    = $(filter-out $(BUILD)/obj/session/%.o,$(LIB_OBJ)) $(BUILD)/obj/scripts/stage0.o

$(BUILD)/stage0: $(STAGE0)
	$(call say,link  $@)
	$(Q)$(CC) $(CFLAGS) -o $@ $(STAGE0) $(LDFLAGS) $(LDLIBS)

# What runs on this machine: the program itself, or in node what emcc compiled.
STAGE0_RUN = $(if $(findstring emcc,$(CC)),$(BUILD)/stage0.js,$(BUILD)/stage0)
$(BUILD)/library.img: $(STAGE0_RUN) $(LIBRARY)
	$(call say,image $@)
	$(Q)$(if $(findstring emcc,$(CC)),node )$(STAGE0_RUN) $@ $(LIBRARY)

$(BUILD)/library_image.c: $(BUILD)/library.img
	@printf '#include "vm/machine/image.h"\nextern const uint64_t vs_library_words[] __attribute__((visibility("hidden")));\nextern const vs_image vs_library_image;\nconst vs_image vs_library_image = { vs_library_words, %d };\n' $$(($$(wc -c < $<) / 8)) > $@

$(BUILD)/library_words.s: $(BUILD)/library.img scripts/embed.sh
	@$(EMBED) 4096 vs_library_words $< > $@

$(BUILD)/obj/library_image.o: $(BUILD)/library_image.c
	@mkdir -p $(@D)
	$(call say,cc    $<)
	$(Q)$(CC) $(CFLAGS) -c $< -o $@

# The libraries in Scheme that come with the language: their texts, each under its name below library/, read when something imports them.
SHIPPED   = $(sort $(filter-out library/srfi.scm,$(wildcard library/*.s[lc]* library/*/*.s[lc]* library/*/*/*.s[lc]* library/prefabs/*.vs)))

$(BUILD)/shipped.c: $(SHIPPED) Makefile
	@mkdir -p $(@D)
	@{ echo '#include "vm/front/source.h"'; i=0; for f in $(SHIPPED); do i=$$((i + 1)); \
	  echo "extern const char vs_shipped_$$i[] __attribute__((visibility(\"hidden\"))), vs_shipped_$${i}_end[] __attribute__((visibility(\"hidden\")));"; done; \
	  echo 'extern const vs_shipped vs_shipped_library[];'; echo 'const vs_shipped vs_shipped_library[] = {'; i=0; \
	  for f in $(SHIPPED); do i=$$((i + 1)); printf '  { "%s", vs_shipped_%d, vs_shipped_%d_end },\n' $${f#library/} $$i $$i; done; echo '  { 0 }'; echo '};'; } > $@

$(BUILD)/shipped_texts.s: $(SHIPPED) Makefile scripts/embed.sh
	@mkdir -p $(@D)
	@i=0; $(EMBED) 1 $$(for f in $(SHIPPED); do i=$$((i + 1)); echo vs_shipped_$$i $$f; done) > $@

$(BUILD)/obj/shipped.o: $(BUILD)/shipped.c
	@mkdir -p $(@D)
	$(call say,cc    $<)
	$(Q)$(CC) $(CFLAGS) -c $< -o $@

$(BUILD)/obj/library_words.o $(BUILD)/obj/shipped_texts.o $(BUILD)/obj/assets.o: $(BUILD)/obj/%.o: $(BUILD)/%.s
	@mkdir -p $(@D)
	$(call say,as    $<)
	$(Q)$(CC) -c $< -o $@

# The library's objects, with the files that it contains.
WHOLE_OBJ = $(LIB_OBJ) $(addprefix $(BUILD)/obj/,library_image.o library_words.o shipped.o shipped_texts.o)
$(BUILD)/libvisualscheme.a: $(WHOLE_OBJ)
	@mkdir -p $(@D); rm -f $@
	$(call say,ar    $@)
	$(Q)ar rcs $@ $^

# The shared library exports what the header declares.
$(BUILD)/visualscheme.map: visualscheme.h
	@mkdir -p $(@D)
	@{ echo 'VISUALSCHEME_0 { global:'; sed -n 's/^VS_API .*[ *]\(vs_[a-z_]*\)(.*/\1;/p' $<; echo 'local: *; };'; } > $@

$(BUILD)/libvisualscheme.so: $(WHOLE_OBJ) $(BUILD)/visualscheme.map
	$(call say,link  $@)
	$(Q)$(CC) $(CFLAGS) -shared -Wl,-soname,libvisualscheme.so.0 -Wl,--version-script=$(BUILD)/visualscheme.map -Wl,--no-undefined -o $@ $(WHOLE_OBJ) $(LDFLAGS) $(LDLIBS)

# The manual's pages as one text, for `vs help`: a line of byte 1 and the path before each.
MANUAL    = $(wildcard manual/*.md manual/language/*.md manual/primitives/*.md manual/rules/*.md)

$(BUILD)/manual.txt: $(MANUAL)
	@mkdir -p $(@D)
	@for f in $(sort $(filter-out manual/internals.md,$(MANUAL))); do printf '\001%s\n' $$f; cat $$f; echo; done > $@

# Our licence and what comes from others, for `vs --licenses`.
$(BUILD)/licenses.txt: LICENSE NOTICE
	@mkdir -p $(@D)
	@{ cat LICENSE; echo; cat NOTICE; } > $@

$(BUILD)/obj/%_text.o: $(BUILD)/%.txt scripts/embed.sh
	@mkdir -p $(@D)
	@$(EMBED) 1 vs_$*_text $< > $(BUILD)/$*.s
	$(Q)$(CC) -c $(BUILD)/$*.s -o $@

TEXTS     = $(BUILD)/obj/manual_text.o $(BUILD)/obj/licenses_text.o
$(BUILD)/vs: $(CLI_OBJ) $(TEXTS) $(BUILD)/libvisualscheme.a
	$(call say,link  $@)
	$(Q)$(CC) $(CFLAGS) -o $@ $(CLI_OBJ) $(TEXTS) $(BUILD)/libvisualscheme.a $(PACK) $(LDFLAGS) $(LDLIBS)

$(BUILD)/unit/%: tests/unit/%.c $(BUILD)/libvisualscheme.a
	@mkdir -p $(@D)
	$(call say,unit  $<)
	$(Q)$(CC) $(CFLAGS) -MMD -MP $< -o $@ $(BUILD)/libvisualscheme.a $(LDFLAGS) $(UNIT_LIBS) $(LDLIBS)

$(BUILD)/unit/test_forms: UNIT_LIBS += -Wl,--wrap=vs_bind_call

$(BUILD)/tools/%: tests/tools/%.c $(wildcard tests/tools/*.h)
	@mkdir -p $(@D)
	$(call say,tool  $<)
	$(Q)$(CC) $(CFLAGS) $< -o $@ $(LDFLAGS) $(PNG_LIBS) $(call pkg,gmp,-lgmp) -lm

$(BUILD)/tools/zipped: tests/tools/zipped.c
	@mkdir -p $(@D)
	$(call say,tool  $<)
	$(Q)$(CC) $(CFLAGS) $< -o $@ $(LDFLAGS) $(call pkg,libzip,-lzip)

$(BUILD)/tools/crossings: tests/tools/crossings.c tests/tools/written_mesh.h tests/tools/crossings.h tests/tools/stl.h
	@mkdir -p $(@D)
	$(call say,tool  $<)
	$(Q)$(CC) $(CFLAGS) $< -o $@ $(LDFLAGS) $(call pkg,gmp jansson,-lgmp -ljansson) -lm

$(BUILD)/tools/fuzz: tests/oracle/fuzz.c tests/oracle/sx.c tests/tools/crossings.h $(BUILD)/libvisualscheme.a
	@mkdir -p $(@D)
	$(call say,tool  $<)
	$(Q)$(CC) $(CFLAGS) tests/oracle/fuzz.c tests/oracle/sx.c -o $@ $(BUILD)/libvisualscheme.a $(LDFLAGS) $(LDLIBS)

# Tools that ask the library.
$(BUILD)/tools/names $(BUILD)/tools/reread $(BUILD)/tools/exrdiff $(BUILD)/tools/cutdiff $(BUILD)/tools/exrmake $(BUILD)/tools/badcalls $(BUILD)/tools/gaps: $(BUILD)/tools/%: tests/tools/%.c visualscheme.h $(BUILD)/libvisualscheme.a
	@mkdir -p $(@D)
	$(call say,tool  $<)
	$(Q)$(CC) $(CFLAGS) $< -o $@ $(BUILD)/libvisualscheme.a $(LDFLAGS) $(LDLIBS)

# ---- fuzzing: clang's libFuzzer under the address sanitizer, in a build of its own; and the same inputs without it, as tests ----

T       ?= 60
fuzz: ## install clang's libFuzzer and let each fuzzer of tests/fuzz run T seconds (60); FUZZ="reader emit": only these
	BUILD=$(BUILD) sh scripts/install.sh build fuzz
	$(MAKE) BUILD=$(BUILD)/fuzz CC=clang OPT="-O1 -g -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined" LDFLAGS="-Wl,--no-as-needed -lstdc++" fuzzers
	$(MAKE) $(FUZZERS:%=$(BUILD)/tools/replay_%)
	sh tests/fuzz.sh $(BUILD)/fuzz $(T) $(BUILD)

fuzzers: $(FUZZERS:%=$(BUILD)/fuzz_%)

# The server is no part of the library.
LIVE_FUZZED = $(patsubst %,$(BUILD)/obj/live/%.o,serve access waiting published chunks live_text live_options model_files http) $(BUILD)/live_assets.o
$(BUILD)/fuzz_live $(BUILD)/tools/replay_live: $(LIVE_FUZZED)

$(BUILD)/fuzz_%: tests/fuzz/fuzz_%.c tests/fuzz/fuzz.h $(BUILD)/libvisualscheme.a
	$(CC) $(CFLAGS) -fsanitize=fuzzer $(filter-out %.h %.a,$^) -o $@ $(filter %.a,$^) $(LDFLAGS) $(LDLIBS)

$(BUILD)/tools/replay_%: tests/fuzz/fuzz_%.c tests/fuzz/replay.c tests/fuzz/fuzz.h $(BUILD)/libvisualscheme.a
	@mkdir -p $(@D)
	$(call say,tool  $<)
	$(Q)$(CC) $(CFLAGS) $(filter-out %.h %.a,$^) -o $@ $(filter %.a,$^) $(LDFLAGS) $(LDLIBS)

coverage: ## which lines the tests reach: gcov over vm, model, kernel and bind
	$(MAKE) BUILD=$(BUILD)/coverage OPT="-O1 -g --coverage" LDFLAGS=--coverage SUITES="unit lang cli manual bad limits" tested
	sh scripts/coverage.sh $(BUILD)/coverage vm model kernel bind geometry backends

# ---- what a fresh machine needs: scripts/packages.list, installed by the two commands below and by nothing else ----

demo: ## install what is missing, build, and make a picture, a web page, a program and a mesh of a station under out/
	BUILD=$(BUILD) sh scripts/install.sh build workers
	$(MAKE) -j$(shell nproc) all
	sh scripts/demo.sh $(BUILD)/vs

test: ## install what the tests need, build, run them: of long ones a sample
	BUILD=$(BUILD) sh scripts/install.sh build workers tests
	$(MAKE) -j$(shell nproc) BUILD=$(BUILD)/tested EXTRA="$(EXTRA) -Werror -DVS_DEBUG=1" all units tools
	$(MAKE) $(TESTED) tested

check: ## as test, and the long ones whole: every shape in every variant; SEEDS=FROM-TO: the kernel's random trees of these seeds, in place of 1-3000
	BUILD=$(BUILD) sh scripts/install.sh build workers tests check
	-$(MAKE) playground
	PLAYGROUND=$(abspath $(BUILD))/playground $(MAKE) $(TESTED) LONG=1 tested
	$(MAKE) sanitized

fresh: ## the two commands on a bare Debian bookworm made by debootstrap (root): what a stranger's machine needs, in seconds and MB
	sh scripts/install.sh fresh
	BUILD=$(BUILD) sh scripts/fresh.sh

# ---- tests without installing anything ----

units: $(UNIT_BIN)

tools: $(TOOL_BIN) # the programs that tests run beside vs

# The tests run what is built with the asserts of model/assert.h, in a folder of its own: the program that is installed has none.
TESTED    = BUILD=$(BUILD)/tested EXTRA="$(EXTRA) -DVS_DEBUG=1"

tests: ## run the tests with what is installed; LONG=1: the long ones whole
	$(MAKE) $(TESTED) tested

tested: all units tools # as BUILD, OPT and EXTRA say
	LONG=$(LONG) sh tests/run.sh $(BUILD)

quick: all units # what every commit must pass in a minute
	@for t in $(UNIT_BIN); do $$t || exit 1; done

SANITIZE  = OPT="-O1 -g -fno-omit-frame-pointer -fsanitize=$(1) -DVS_DEBUG=1" BUILD=$(BUILD)/$(2) SUITES="$(or $(SUITES),unit lang cli)" UNIT_SECONDS=1800 tested
asan: ## the tests under the address and leak sanitizer
	$(MAKE) $(call SANITIZE,address,asan) LDFLAGS="-Wl,--no-as-needed -lstdc++" # GEOS comes later and throws: the sanitizer must know of C++ from the start
ubsan: ## the tests under the undefined-behaviour sanitizer
	UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 $(MAKE) $(call SANITIZE,undefined -fno-sanitize-recover=all,ubsan)

# The programs with threads: interpreters side by side, the kernel's tasks, the live view's server. scripts/tsan.supp says what is not ours.
TSAN_UNITS = test_threads test_kernel test_crowds
tsan: ## what runs in threads under the thread sanitizer: interpreters side by side, the kernel, the live view's server
	$(MAKE) OPT="-O1 -g -fsanitize=thread -DVS_DEBUG=1" BUILD=$(BUILD)/tsan $(BUILD)/tsan/vs $(TSAN_UNITS:%=$(BUILD)/tsan/unit/%)
	for t in $(TSAN_UNITS); do TSAN_OPTIONS="suppressions=$(CURDIR)/scripts/tsan.supp" $(BUILD)/tsan/unit/$$t || exit 1; done
	rm -f $(BUILD)/tsan/race.* && mkdir -p $(BUILD)/tsan/live
	TSAN_OPTIONS="suppressions=$(CURDIR)/scripts/tsan.supp log_path=$(CURDIR)/$(BUILD)/tsan/race" node tests/page/live.mjs $(CURDIR)/$(BUILD)/tsan/vs $(BUILD)/tsan/live
	! cat $(BUILD)/tsan/race.* 2>/dev/null

static: ## what cppcheck, clang's analyzer and gcc -fanalyzer find where strangers' input is met, and nobody has judged yet
	BUILD=$(BUILD) sh scripts/install.sh build static
	sh scripts/static.sh

# The kernel alone, under both: its units, a sample of its random trees, and files as the program writes them.
KERNEL_UNITS = test_random_solids test_kernel test_kernel_numbers test_crowds test_kernel_refusals test_inspect test_progress
KERNEL_TESTS = $(KERNEL_UNITS:%=unit/%) vs tools/crossings tools/fuzz
sanitized: ## the kernel's tests under the address, leak and undefined-behaviour sanitizers
	$(MAKE) OPT="-O1 -g -fno-omit-frame-pointer -fsanitize=address -DVS_DEBUG=1" BUILD=$(BUILD)/asan LDFLAGS="-Wl,--no-as-needed -lstdc++" $(KERNEL_TESTS:%=$(BUILD)/asan/%)
	$(MAKE) OPT="-O1 -g -fsanitize=undefined -fno-sanitize-recover=all -DVS_DEBUG=1" BUILD=$(BUILD)/ubsan $(KERNEL_TESTS:%=$(BUILD)/ubsan/%)
	for t in $(KERNEL_UNITS); do SEEDS= LONG= $(BUILD)/asan/unit/$$t && SEEDS= LONG= UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 $(BUILD)/ubsan/unit/$$t || exit 1; done
	LONG= SUITES=solids sh tests/run.sh $(BUILD)/asan
	LONG= UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 SUITES=solids sh tests/run.sh $(BUILD)/ubsan

stress: ## the tests with a collection at every allocation and the heap checked again and again: minutes
	$(MAKE) BUILD=$(BUILD)/stress EXTRA="-DVS_DEBUG=1 -DVS_DEBUG_STRESS=1 -DVS_DEBUG_SMALL=1" SUITES="$(or $(SUITES),unit lang cli manual)" UNIT_SECONDS=1800 tested

layers: ## check that includes follow the layers' arrows and that no object that is built has mutable globals
	sh scripts/layers.sh $(BUILD)

objects: $(LIB_OBJ) $(CLI_OBJ)

bless: all ## rewrite the expected results of tests/cli and tests/cross from what the program does now; read the diff
	BLESS=1 SUITES="cli cross" sh tests/run.sh $(BUILD)

$(BUILD)/measure: bench/measure.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $< -o $@

bench: ## install Guile, Lua and Chez Scheme, and measure beside them: programs, start-up, passes, growth; the kernel beside Manifold and OpenSCAD: half an hour
	BUILD=$(BUILD) sh scripts/install.sh build bench
	$(MAKE) all $(BUILD)/measure
	sh bench/startup.sh $(BUILD)/vs
	sh bench/pauses.sh $(BUILD)/vs
	sh bench/run.sh $(BUILD)/vs $(BUILD)/measure
	sh bench/memory.sh $(BUILD)/vs
	sh bench/passes.sh $(BUILD)/vs $(BUILD)/measure
	sh bench/growth.sh $(BUILD)/vs $(BUILD)/measure
	sh bench/incremental.sh $(BUILD)/vs
	sh bench/sampling.sh $(BUILD)/vs $(BUILD)/measure
	sh bench/contours/run.sh $(BUILD)/vs $(BUILD)/measure
	sh bench/kernel/run.sh $(BUILD)/vs $(BUILD)/measure

manual: all ## make build/manual: the manual as web pages, with a picture of every kind of object (POV-Ray)
	sh scripts/manual.sh $(BUILD)

gallery: all ## make build/gallery: a page with a picture of every example (POV-Ray); QUALITY=draft, SIZE=320x240: quicker
	sh scripts/gallery.sh $(BUILD)

# ---- installing ----

PLACE     = PREFIX="$(PREFIX)" DESTDIR="$(DESTDIR)" LIB="$(LIB)" STRIP="$(STRIP)" sh scripts/packaging/place.sh

install: all $(BUILD)/libvisualscheme.so ## install program, library, manual, examples, completions and desktop files below PREFIX (default /usr/local)
	@$(PLACE) install "$(BUILD)" "$(VERSION)"

uninstall: ## remove what make install has placed below PREFIX
	@$(PLACE) uninstall

dist: ## make a release, build/visualscheme-VERSION.tar.gz, which builds without npm and node
	BUILD=$(BUILD) sh scripts/install.sh build
	sh scripts/dist.sh $(BUILD) $(VERSION)

vscode: ## pack the extension for Visual Studio Code, build/visualscheme-VERSION.vsix
	@sh scripts/vscode.sh $(BUILD) $(VERSION)

deb: dist ## make packages of Debian from the release, below build/deb
	BUILD=$(BUILD) sh scripts/install.sh build deb
	sh scripts/deb.sh $(BUILD) $(VERSION)

clean: ## remove what was built
	rm -rf build

help: ## list the targets
	@awk -F ':.*## ' '/^help:.*## / { first = sprintf("make %-9s %s\n", $$1, $$2) } /^[a-z]+:.*## / && !/^help:/ { rest = rest sprintf("make %-9s %s\n", $$1, $$2) } END { printf "%s%s", first, rest }' Makefile

include live/playground/rules.mk

.PHONY: playground all objects demo test check fresh units tools tests tested quick asan ubsan tsan static sanitized fuzz fuzzers coverage stress layers bless bench manual gallery install uninstall dist deb vscode clean help
-include $(OBJECTS:.o=.d) $(BUILD)/obj/scripts/stage0.d $(UNIT_BIN:=.d)
