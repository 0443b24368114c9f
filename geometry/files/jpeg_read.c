/* Reads JPEG pictures with libjpeg, which is loaded at its first use.
 *
 * The result contains only the size and the colours of a picture, because programs that show it read the file
 * themselves. Nevertheless the whole file is decoded here, so that a truncated or broken file is refused before another
 * program shows half of it. */
#include "geometry/files/jpeg_read.h"

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include <jpeglib.h>

#include "geometry/dynamic.h"
#include "geometry/files/raster.h"

enum { SCANS_MOST = 200, CODE_MOST = 1024 /* SCANS_MOST: greatest number of scans (passes over the picture) in a file;
                                           * CODE_MOST: greatest number of pixels for each byte of the file */ };

typedef struct {
  struct jpeg_error_mgr *(*errors)(struct jpeg_error_mgr *);
  void (*create)(j_decompress_ptr, int, size_t);
  void (*source)(j_decompress_ptr, const unsigned char *, unsigned long);
  int (*header)(j_decompress_ptr, boolean);
  boolean (*start)(j_decompress_ptr);
  JDIMENSION (*lines)(j_decompress_ptr, JSAMPARRAY, JDIMENSION);
  boolean (*finish)(j_decompress_ptr);
  void (*destroy)(j_decompress_ptr);
} jpeg_functions;

static const vs_dynamic_name jpeg_names[] = {
  { "jpeg_std_error", offsetof(jpeg_functions, errors) },
  { "jpeg_CreateDecompress", offsetof(jpeg_functions, create) },
  { "jpeg_mem_src", offsetof(jpeg_functions, source) },
  { "jpeg_read_header", offsetof(jpeg_functions, header) },
  { "jpeg_start_decompress", offsetof(jpeg_functions, start) },
  { "jpeg_read_scanlines", offsetof(jpeg_functions, lines) },
  { "jpeg_finish_decompress", offsetof(jpeg_functions, finish) },
  { "jpeg_destroy_decompress", offsetof(jpeg_functions, destroy) },
};

/* The error handling that libjpeg gets: an error leaves the library by longjmp, and after a warning libjpeg
 * continues. */
typedef struct {
  struct jpeg_error_mgr errors; /* must be the first member, because libjpeg passes only a pointer to it */
  struct jpeg_progress_mgr progress;
  jmp_buf out;
  char said[JMSG_LENGTH_MAX];
} jpeg_run;

static void jpeg_fail(j_common_ptr j) {
  jpeg_run *run = (jpeg_run *)j->err;
  j->err->format_message(j, run->said);
  longjmp(run->out, 1);
}
static void jpeg_say(j_common_ptr j, int level) {
  if (level < 0) jpeg_fail(j);
}
/* Refuses a picture with too many scans (passes over the picture), in which a small file may describe a very large
 * picture. */
static void jpeg_progress(j_common_ptr j) {
  jpeg_run *run = (jpeg_run *)j->err;
  if (((j_decompress_ptr)j)->input_scan_number <= SCANS_MOST) return;
  snprintf(run->said, sizeof run->said, "the file has too many scans");
  longjmp(run->out, 1);
}

/* Memory for one line of the picture, which is read at an eighth of its size. If at is NULL, only the header is
 * read. */
typedef struct { unsigned char *at; size_t room; } jpeg_line;

/* Reads the picture after a call of setjmp. This is a separate function, because longjmp makes changed local variables
 * of the function that calls setjmp indeterminate. */
static bool jpeg_decode(const jpeg_functions *call, struct jpeg_decompress_struct *j, const vs_file_bytes *file,
                        jpeg_line line, vs_jpeg_bytes *out) {
  if (setjmp(((jpeg_run *)j->err)->out)) return false;
  call->source(j, file->at, (unsigned long)file->size);
  if (line.at == NULL) return call->header(j, TRUE) == JPEG_HEADER_OK;
  call->header(j, TRUE);
  j->scale_num = 1, j->scale_denom = 8;
  j->out_color_space = j->num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  call->start(j);
  if ((size_t)j->output_width * (size_t)j->output_components > line.room) return false;
  while (j->output_scanline < j->output_height) {
    call->lines(j, &line.at, 1);
    for (size_t i = 0; i < j->output_width; i++)
      for (int k = 0; k < 3; k++)
        out->count[k][j->output_components == 1 ? line.at[i] : line.at[3 * i + (size_t)k]]++;
  }
  return call->finish(j);
}

bool vs_jpeg_read(vs_store *store, const vs_file_bytes *file, vs_jpeg_bytes *out, vs_error *e) {
  const char *name = file->name;
  jpeg_functions call;
  jpeg_line line = { NULL, 0 };
  if (!vs_dynamic_load(VS_LIBRARY_JPEG, "JPEG pictures", jpeg_names, sizeof jpeg_names / sizeof *jpeg_names, &call, e))
    return false;
  *out = (vs_jpeg_bytes){ 0 };
  bool ok = true;
  for (int pass = 0; ok && pass < 2; pass++) { /* the first pass reads only the header, to check the picture's size; the
                                                * second pass reads the whole file */
    struct jpeg_decompress_struct j;
    jpeg_run run = { .said = "" };
    memset(&j, 0, sizeof j);
    j.err = call.errors(&run.errors);
    run.errors.error_exit = jpeg_fail, run.errors.emit_message = jpeg_say;
    run.progress.progress_monitor = jpeg_progress;
    call.create(&j, JPEG_LIB_VERSION, sizeof j);
    j.progress = &run.progress;
    j.mem->max_memory_to_use = 1L << 30;
    ok = jpeg_decode(&call, &j, file, line, out);
    if (!ok)
      vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the JPEG file is cut off or broken%s%s", name,
                   *run.said ? ": " : "", run.said);
    else if (pass == 0) {
      out->columns = j.image_width, out->rows = j.image_height;
      ok = vs_raster_size(name, out->columns, out->rows, e);
      if (ok && (uint64_t)out->columns * out->rows > (uint64_t)file->size * CODE_MOST)
        ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the JPEG file is too short for a picture of %u x %u pixels",
                          name, out->columns, out->rows);
      if (ok && j.num_components != 1 && j.num_components != 3)
        ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the JPEG picture has %d colours; 1 and 3 are shown", name,
                          j.num_components);
    }
    call.destroy(&j);
    if (ok && pass == 0) {
      line.room = 3 * ((size_t)out->columns / 8 + 2);
      line.at = vs_store_realloc(store, NULL, 0, line.room);
      ok = line.at || vs_error_memory(e, NULL);
    }
  }
  if (line.at) vs_store_realloc(store, line.at, line.room, 0);
  return ok;
}
