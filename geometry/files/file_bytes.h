/* Declares files in memory: the input of this room's readers, and the output of its writers. */
#ifndef VS_GEOMETRY_FILES_FILE_BYTES_H
#define VS_GEOMETRY_FILES_FILE_BYTES_H

#include <stddef.h>

/* A whole file; the caller owns the bytes. name: without folders, for messages and for its ending; size: in bytes. */
typedef struct { const char *name; const unsigned char *at; size_t size; } vs_file_bytes;

/* A whole file that a writer has made. The caller returns the `room` bytes at `at` to the store; NULL: none. */
typedef struct { unsigned char *at; size_t size, room; } vs_made_bytes;

#endif
