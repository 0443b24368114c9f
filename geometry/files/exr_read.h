/* Declares the reading of EXR pictures with OpenEXR's C library. */
#ifndef VS_GEOMETRY_FILES_EXR_READ_H
#define VS_GEOMETRY_FILES_EXR_READ_H

#include "geometry/files/exr.h"
#include "geometry/files/file_bytes.h"

/* Reads an EXR file that is in memory. wanted: names of the channels to read, with NULL at the end; a missing channel
 * is no error. If wanted is NULL, reads all channels. out needs no initialisation, and is empty after a failure. */
bool vs_exr_read(vs_store *store, const vs_file_bytes *file, const char *const *wanted, vs_exr *out, vs_error *e);

/* A rectangle of a picture, in pixels from the upper left corner. */
typedef struct { uint32_t left, top, columns, rows; } vs_exr_part;
typedef struct {
  uint32_t columns, rows; /* expected size of the file's picture */
  vs_exr_part part;       /* the rectangle of the file's picture to read */
  uint32_t left, top;     /* where the rectangle's upper left corner goes in the receiving picture, in pixels from that
                           * picture's upper left corner */
} vs_exr_cut;
/* Reads the rectangle `cut` of a file's picture into the picture `into`, with all channels that `into` has. Returns
 * false if the file is damaged, its picture has another size or lacks a channel, or the rectangle does not fit. */
bool vs_exr_read_cut(const vs_file_bytes *file, const vs_exr_cut *cut, vs_exr *into, vs_error *e);

/* ---- declarations for the files that read other channels of EXR files ---- */

/* Where a channel's numbers go. If sum is not NULL, each number times `share` is added to sum's element for the pixel.
 * Otherwise the number is stored in plane. */
typedef struct { const char *name; double share; double *sum; float *plane; } vs_exr_target;
typedef struct { const char *name; vs_exr_type type; } vs_exr_seen;
typedef struct {
  uint64_t columns, rows; /* size of the picture as the file states it; the caller must check it */
  vs_exr_seen channels[VS_EXR_CHANNELS];
  size_t count;
  bool more;              /* true if the file has more than VS_EXR_CHANNELS channels; only the first VS_EXR_CHANNELS are
                           * then listed */
  struct { const char *at; size_t length; } texts[VS_EXR_TEXTS]; /* at: contents of the text, or NULL if the file lacks
                                                                  * this text */
} vs_exr_view;
/* A callback: gets the header of a file, allocates memory, and sets the destination of each channel to read. *used:
 * number of destinations. Returns false and sets e on failure. */
typedef bool vs_exr_choose(void *context, const vs_exr_view *view, vs_exr_target *targets, size_t *used, vs_error *e);
/* The rectangle of the picture to decode. stride: distance, in numbers, between the starts of two rows in a
 * destination. */
typedef struct { vs_exr_part part; size_t stride; } vs_exr_window;
/* Decodes a picture. The callback `choose` sets the arrays that receive the channels. window: rectangle to decode;
 * NULL: the whole picture. Returns false and sets e on failure. */
bool vs_exr_decode(vs_store *store, const vs_file_bytes *file, const vs_exr_window *window, vs_exr_choose *choose,
                   void *context, vs_error *e);

#endif
