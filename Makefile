# VisualScheme. `make help` lists the targets.
# Folders are layers (see manual/internals.md); objects of every layer but cli/ go into build/libvisualscheme.a.

CC       ?= cc
BUILD    ?= build
OPT      ?= -O2 -g
WARN      = -Wall -Wextra -Wpedantic -Wshadow -Wconversion
CFLAGS   += -std=c11 -D_POSIX_C_SOURCE=200809L $(OPT) $(WARN) -ffp-contract=off -fvisibility=hidden -fno-math-errno -I. $(EXTRA)
LDLIBS   += -lgmp -lm -lpthread -ldl

LAYERS    = vm model geometry kernel bind backends
LIB_SRC   = $(wildcard visualscheme.c) $(foreach d,$(LAYERS),$(wildcard $(d)/*.c $(d)/*/*.c))
LIB_OBJ   = $(LIB_SRC:%.c=$(BUILD)/obj/%.o)
UNIT_SRC  = $(wildcard tests/unit/test_*.c)
UNIT_BIN  = $(UNIT_SRC:tests/unit/%.c=$(BUILD)/unit/%)

all: $(BUILD)/libvisualscheme.a

$(BUILD)/obj/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -MMD -MP -c $< -o $@

$(BUILD)/libvisualscheme.a: $(LIB_OBJ)
	@mkdir -p $(@D); rm -f $@
	ar rcs $@ $^

$(BUILD)/unit/%: tests/unit/%.c $(BUILD)/libvisualscheme.a
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -MMD -MP $< -o $@ $(BUILD)/libvisualscheme.a -lcmocka $(LDLIBS)

unit: $(UNIT_BIN)
	@for t in $(UNIT_BIN); do $$t || exit 1; done

# what every commit must pass in a minute
quick: all unit

clean:
	rm -rf $(BUILD)

.PHONY: all unit quick clean
-include $(LIB_OBJ:.o=.d) $(UNIT_BIN:=.d)
