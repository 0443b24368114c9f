/* Declares files in memory: the input of the readers in geometry/files/, and the output of its writers. */
#ifndef VS_GEOMETRY_FILES_FILE_BYTES_H
#define VS_GEOMETRY_FILES_FILE_BYTES_H

#include <stddef.h>

/* A whole file of `size` bytes, which the caller owns. name: file name without folders; it appears in messages, and its
 * ending may determine the format. */
typedef struct { const char *name; const unsigned char *at; size_t size; } vs_file_bytes;

/* A whole file of `size` bytes that a writer has made. The caller returns the `room` bytes of memory at `at` to the
 * store. at may be NULL. */
typedef struct { unsigned char *at; size_t size, room; } vs_made_bytes;

#endif
