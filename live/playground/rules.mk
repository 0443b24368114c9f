# The playground: the program compiled to WebAssembly by Debian's emscripten, and its page. `make playground`.
#
# $(WASM) is a build of its own: the rules of the Makefile with emcc as the compiler, and beside it the libraries of
# scripts/wasm_libraries.sh. Headers of libraries that are not linked come from this machine. OPT is in the environment,
# so that the rules for single files may still raise it.

WASM      = $(BUILD)/wasm
WASM_LIBS = $(WASM)/libraries
# Debian's emscripten needs the node packages that Debian keeps here; another node does not look there.
WASM_ENV  = NODE_PATH="/usr/share/nodejs$(if $(NODE_PATH),:$(NODE_PATH))"
WASM_MAKE = $(WASM_ENV) OPT=-O2 $(MAKE) BUILD=$(WASM) CC=emcc PIC= WARN=-w LDFLAGS="-L$(WASM_LIBS)/lib" \
  EXTRA="-I$(WASM_LIBS)/include -fwasm-exceptions -sSUPPORT_LONGJMP=wasm -idirafter /usr/include -idirafter /usr/include/$(shell $(or $(HOST_CC),cc) -print-multiarch 2>/dev/null)"
WASM_LINKED = -lgeos -lryu -lfreetype -lpng -lexpat -ljansson -lz

playground: ## install emscripten, compile the program to WebAssembly and make build/playground: the program in a web page
	BUILD=$(BUILD) sh scripts/install.sh build playground
	$(WASM_ENV) sh scripts/wasm_libraries.sh $(WASM_LIBS)
	$(WASM_MAKE) $(WASM)/engine.js $(WASM)/playground.js $(WASM)/live.css
	sh scripts/playground.sh $(BUILD)

ifneq ($(findstring emcc,$(CC)),)
# Names that the sources ask a library for, and that a linked archive defines.
$(BUILD)/libraries/include/linked.def: $(wildcard $(BUILD)/libraries/lib/*.a) live/playground/linked_libraries.c live/http.def
	@{ emnm --defined-only $(foreach l,geos freetype png expat jansson z,$(BUILD)/libraries/lib/lib$(l).a) 2>/dev/null | awk '$$2 == "T" { print $$3 }'; \
	   sed -n 's/^HTTP(\(.*\))/MHD_\1/p' live/http.def; } > $(BUILD)/defined; \
	 cat geometry/*/*.c geometry/*.[ch] bind/*.[ch] bind/*/*.[ch] backends/*/*.[ch] cli/*.[ch] live/*.c | grep -oE '[A-Za-z_][A-Za-z_0-9]*' > $(BUILD)/asked; \
	 sed -n 's/^HTTP(\(.*\))/MHD_\1/p' live/http.def >> $(BUILD)/asked; \
	 LC_ALL=C sort -u $(BUILD)/asked -o $(BUILD)/asked; LC_ALL=C sort -u $(BUILD)/defined -o $(BUILD)/defined; \
	 LC_ALL=C comm -12 $(BUILD)/defined $(BUILD)/asked | sed 's/.*/LINKED(&)/' > $@

# stage0 runs in node, which gives it this machine's files.
$(BUILD)/stage0.js: $(STAGE0)
	$(call say,link  $@)
	$(Q)$(CC) $(CFLAGS) -o $@ $(STAGE0) $(LDFLAGS) $(LDLIBS) -sNODERAWFS=1 -sENVIRONMENT=node -sALLOW_MEMORY_GROWTH=1 -sEXIT_RUNTIME=1 --pre-js live/playground/no_fetch.js

$(BUILD)/live_assets.s: Makefile
PAGE_OBJ  = $(patsubst live/playground/%.c,$(BUILD)/obj/live/playground/%.o,$(wildcard live/playground/*.c))
$(BUILD)/obj/live/playground/linked_libraries.o: $(BUILD)/libraries/include/linked.def
PAGE_PARTS = $(filter-out $(BUILD)/obj/cli/main.o $(BUILD)/obj/cli/limits.o $(BUILD)/obj/cli/packages/%,$(CLI_OBJ))
$(BUILD)/libcommand.a: $(PAGE_PARTS)
	$(call say,ar    $@)
	$(Q)rm -f $@; emar rcs $@ $^

$(BUILD)/engine.js: $(PAGE_OBJ) $(WHOLE_OBJ) $(BUILD)/libcommand.a $(TEXTS)
	$(call say,link  $@)
	$(Q)$(CC) $(CFLAGS) -o $@ $(PAGE_OBJ) $(WHOLE_OBJ) $(BUILD)/libcommand.a $(TEXTS) $(LDFLAGS) $(WASM_LINKED) $(LDLIBS) \
	  -lc++ -sMODULARIZE=1 -sEXPORT_NAME=VisualScheme -sENVIRONMENT=worker,node -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB \
	  -sNODEJS_CATCH_EXIT=0 -sNODEJS_CATCH_REJECTION=0 -sFORCE_FILESYSTEM=1 -sEXPORTED_RUNTIME_METHODS=FS,ccall,cwrap -sTOTAL_STACK=8MB -sINITIAL_MEMORY=64MB

$(BUILD)/playground.js: $(wildcard live/playground/page/*.js backends/page/*.js backends/page/live/*.js) package.json NOTICE
	$(Q)$(BUNDLE) --footer:js="/*! $$(awk '/^[^ ]/ { on = /^Embedded/ } on' NOTICE) */" live/playground/page/playground.js --outfile=$@
endif
