/* Declares the statistics of an interpreter, which statistics.c computes. */
#ifndef VS_SESSION_STATISTICS_H
#define VS_SESSION_STATISTICS_H

#include "session/session.h"

bool vs_session_output_begin(vs_session *s, const char *path, const char *format);
bool vs_session_output_nodes(vs_session *s, const vs_scene *scene, unsigned passes, vs_error *e);
void vs_session_output_end(vs_session *s, bool done);
void vs_session_free_outputs(vs_session *s);

#endif
