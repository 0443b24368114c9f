/* Compiles the run loop for programs that are stepped through: run_loop.c, with a check of each instruction. */
#define VS_STEPPING 1
#include "vm/machine/run_loop.c"
