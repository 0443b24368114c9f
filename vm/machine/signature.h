/* Owns the parser of native signatures: "c r [start end] #:segments" (native.h gives their meaning). */
#ifndef VS_VM_MACHINE_SIGNATURE_H
#define VS_VM_MACHINE_SIGNATURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct vs_signature { uint32_t required, optional, keywords; bool rest; } vs_signature;
typedef enum { VS_SIG_END, VS_SIG_REQUIRED, VS_SIG_OPTIONAL, VS_SIG_KEYWORD, VS_SIG_REST } vs_signature_kind;

/* Returns the kind of the next name of the signature at *at; *depth is the number of open brackets, 0 at first. The
 * name is *length bytes at *name. */
vs_signature_kind vs_signature_next(const char **at, int *depth, const char **name, size_t *length);
vs_signature vs_signature_read(const char *text);
/* Writes the name of the arg-th argument, by its index in a[], cut to size; "argument N" beyond the end. size includes
 * the zero byte. */
void vs_signature_parameter(const char *text, int arg, char *name, size_t size);

#endif
