/* Owns the two ways in which a session's drawing is used: written to an output, or summed up. Both go through the
 * stages of stages.def. */
#ifndef VS_SESSION_SPINE_H
#define VS_SESSION_SPINE_H

#include "backends/export.h"
#include "session/session.h"

/* Where an output's bytes go when it has no path: write returns false to stop. */
typedef struct { bool (*write)(void *context, const void *bytes, size_t count); void *context; } vs_byte_sink;

/* Writes the drawing as a format to path, or to the sink where path is NULL. Reports a failure to the host and returns
 * its kind. */
vs_outcome vs_session_write(vs_session *s, const char *path, const vs_format *format, const vs_output_options *options,
                            vs_byte_sink *to);
/* Counts what is drawn and bounds it, in *out. Reports a failure to the host and returns its kind. */
vs_outcome vs_session_summary(vs_session *s, vs_summary *out);

/* Sets the width and height of pictures, in pixels, from these options. */
void vs_session_size(const vs_output_options *o, vs_export_options *e);
/* Makes the scene look as the options say, over what the program said: camera and sun. */
void vs_session_aim(const vs_output_options *o, vs_scene *scene);

/* The drawing, without sugar and resolved, as references that the caller owns: nodes retained, the array of so many
 * (and one more) from the store. Reports a failure to the host and returns its kind. */
vs_outcome vs_session_take(vs_session *s, vs_ref **out, size_t *count);

#endif
