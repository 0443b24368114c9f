/* Owns the interface of report.c: what a host is told when something is wrong. */
#ifndef VS_SESSION_REPORT_H
#define VS_SESSION_REPORT_H

#include "session/session.h"

/* Copies the line into room; NULL: the source is not kept or has no such line. */
const char *vs_session_source_line(const vs_session *s, const char *file, uint32_t line, char *room, size_t size);
vs_outcome vs_session_report_condition(vs_session *s, vs_value condition,
                                       bool usage /* its own fault is the caller's: exit 2 */);
bool vs_session_span(vs_session *s, vs_pos place, vs_span *out); /* false: nowhere in the user sources */
/* The condition's place; inside the library the first call of the user's own. False: nowhere in the user sources. */
bool vs_session_condition_place(vs_session *s, const vs_condition *c, vs_span *out);
vs_outcome vs_session_report_error(vs_session *s, const vs_error *e);
void vs_session_report(vs_session *s, vs_severity severity, vs_outcome outcome, const vs_origin *origin,
                       const char *message);
/* The same at a place of a file; `at` empty: nowhere. */
void vs_session_report_at(vs_session *s, vs_severity severity, vs_outcome outcome, vs_span at, const char *message);
void vs_session_warn(void *session, const vs_origin *origin, const char *message); /* vs_bind.warn */
/* Reports to the host that memory has run out. Returns VS_OUTCOME_MACHINE. */
vs_outcome vs_session_out_of_memory(vs_session *s);

#endif
