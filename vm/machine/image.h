/* Owns the heap image: everything an interpreter has after its library is loaded, as words that a later process starts
   from.

   Written by a stage-0 interpreter at build time, compiled into the binary as a constant array, loaded by vs_open_vm.
   It holds what is reachable from vm->sym and vm->at. Pointers are addresses of the place where it is mapped, natives
   are numbered through the tables they come from, so the binary that loads it must register the same tables in the same
   order (checked by a sum of their names). */
#ifndef VS_VM_MACHINE_IMAGE_H
#define VS_VM_MACHINE_IMAGE_H

#include "vm/machine/vs.h"

typedef struct vs_image { const uint64_t *words; size_t count; } vs_image;

/* Hands the image to put, in pieces. False with the error set: out of memory, an object of the host is reachable, or
   put said no. */
bool vs_image_write(vs_scheme *vm, bool (*put)(void *to, const uint64_t *words, size_t count), void *to);

/* Fills vm->sym and vm->at of a fresh interpreter. False with the error set: out of memory, or the image is of another
   build. */
bool vs_image_load(vs_scheme *vm, const vs_image *image);

#endif
