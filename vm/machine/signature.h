/* Declares the parser for signatures of natives, such as "c r [start end] #:segments" (native.h explains them). */
#ifndef VS_VM_MACHINE_SIGNATURE_H
#define VS_VM_MACHINE_SIGNATURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct vs_signature { uint32_t required, optional, keywords; bool rest; } vs_signature;
typedef enum { VS_SIG_END, VS_SIG_REQUIRED, VS_SIG_OPTIONAL, VS_SIG_KEYWORD, VS_SIG_REST } vs_signature_kind;

/* Returns the kind of the next name in the signature at *at, and advances *at past it. Sets *name and *length to the
 * name. *depth is the number of open brackets; the caller sets it to 0 before the first call. */
vs_signature_kind vs_signature_next(const char **at, int *depth, const char **name, size_t *length);
vs_signature vs_signature_read(const char *text);
/* Writes the name of argument number `arg` in the signature to `name`, shortened to `size` bytes with the NUL. If the
 * signature has no such argument, writes "argument N". */
void vs_signature_parameter(const char *text, int arg, char *name, size_t size);

#endif
