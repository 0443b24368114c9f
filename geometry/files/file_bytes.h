/* Owns files in memory: the bytes that the readers of this room get, and those that its writers make. */
#ifndef VS_GEOMETRY_FILES_FILE_BYTES_H
#define VS_GEOMETRY_FILES_FILE_BYTES_H

#include <stddef.h>

/* All of a file, the caller's. name: for messages and for its ending, without folders; size: in bytes. */
typedef struct { const char *name; const unsigned char *at; size_t size; } vs_file_bytes;

/* All of a file that a writer has made. `room` bytes at `at` are the caller's to give back to the store; NULL: none. */
typedef struct { unsigned char *at; size_t size, room; } vs_made_bytes;

#endif
