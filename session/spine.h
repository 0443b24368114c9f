/* Owns the interface of spine.c: a session's drawing is written to an output, or summed up. Both go through the stages
 * of stages.def. */
#ifndef VS_SESSION_SPINE_H
#define VS_SESSION_SPINE_H

#include "backends/export.h"
#include "session/session.h"

/* Receives an output's bytes if it has no path. write returns false to stop. */
typedef struct { bool (*write)(void *context, const void *bytes, size_t count); void *context; } vs_byte_sink;

/* Writes the drawing as a format to path, or to the sink if path is NULL. Reports a failure to the host and returns its
 * kind. */
vs_outcome vs_session_write(vs_session *s, const char *path, const vs_format *format, const vs_output_options *options,
                            vs_byte_sink *to);
/* Sets *out to the counts and the bounds of the drawing. Reports a failure to the host and returns its kind. */
vs_outcome vs_session_summary(vs_session *s, vs_summary *out);

/* Sets the width and height of pictures, in pixels, from these options. */
void vs_session_size(const vs_output_options *o, vs_export_options *e);
/* Sets the scene's camera and sun by the options, which override the program. */
void vs_session_aim(const vs_output_options *o, vs_scene *scene);

/* Returns the drawing, without sugar and resolved, as references that the caller owns: nodes retained; the array, of
 * *count + 1 elements, from the store. Reports a failure to the host and returns its kind. */
vs_outcome vs_session_take(vs_session *s, vs_ref **out, size_t *count);

#endif
