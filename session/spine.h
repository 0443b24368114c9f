/* Declares the functions of spine.c, which write or measure a session's drawing through the stages of stages.def. */
#ifndef VS_SESSION_SPINE_H
#define VS_SESSION_SPINE_H

#include "backends/export.h"
#include "session/session.h"

/* A receiver of the bytes of an output without a path. Writing stops when `write` returns false. */
typedef struct { bool (*write)(void *context, const void *bytes, size_t count); void *context; } vs_byte_sink;

/* Writes the drawing in a format to path, or to the sink if path is NULL. Reports a failure to the host, and returns
 * the outcome. */
vs_outcome vs_session_write(vs_session *s, const char *path, const vs_format *format, const vs_output_options *options,
                            vs_byte_sink *to);
/* Sets *out to the counts and the bounds of the drawing. Reports a failure to the host, and returns the outcome. */
vs_outcome vs_session_summary(vs_session *s, vs_summary *out);

/* Sets names[] to the names of the drawing's parts, at most `room`, and *count to their number. The store owns the
 * names. Reports a failure to the host, and returns the outcome. */
vs_outcome vs_session_parts(vs_session *s, const char **names, size_t room, size_t *count);

/* Sets the width and height of pictures in e, in pixels, from the options o. */
void vs_session_size(const vs_output_options *o, vs_export_options *e);
/* Sets the scene's camera and sun from the options, which override the program. */
void vs_session_aim(const vs_output_options *o, vs_scene *scene);

/* Sets *out to the references of the drawing after all stages before writing. The caller owns them: the nodes are
 * retained, and the store allocated the array of *count + 1 elements. Reports a failure to the host, and returns the
 * outcome. */
vs_outcome vs_session_take(vs_session *s, vs_ref **out, size_t *count);
/* Frees references from vs_session_take. */
void vs_session_give_back(vs_session *s, vs_ref *refs, size_t count);

#endif
