/* Declares the heap image: the state of an interpreter after its library was loaded, from which a later process starts.
 *
 * During the build of vs, an interpreter writes the image; the program vs contains it as a constant array, and
 * vs_open_vm loads it. It contains all objects reachable from vm->sym and vm->at. Its pointers are valid if it is
 * mapped at its intended address. Natives are numbered in the order of their tables, so the program must register the
 * same tables in the same order. A checksum of their names verifies this. */
#ifndef VS_VM_MACHINE_IMAGE_H
#define VS_VM_MACHINE_IMAGE_H

#include "vm/machine/vs.h"

typedef struct vs_image { const uint64_t *words; size_t count; } vs_image;

/* Passes the image to the function `put`, in pieces. Returns false with the error set if memory is out, an object of
 * the host is reachable, or `put` returned false. */
bool vs_image_write(vs_scheme *vm, bool (*put)(void *to, const uint64_t *words, size_t count), void *to);

/* Sets vm->sym and vm->at of a new interpreter from the image. Returns false with the error set if memory is out, or
 * another build wrote the image. */
bool vs_image_load(vs_scheme *vm, const vs_image *image);

#endif
