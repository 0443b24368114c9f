/* Owns the interface of report.c: the reports to a host. */
#ifndef VS_SESSION_REPORT_H
#define VS_SESSION_REPORT_H

#include "session/session.h"

/* Copies the line into room; returns NULL if the source is not kept or has no such line. */
const char *vs_session_source_line(const vs_session *s, const char *file, uint32_t line, char *room, size_t size);
vs_outcome vs_session_report_condition(vs_session *s, vs_value condition,
                                       bool usage /* the condition is the caller's fault: exit 2 */);
bool vs_session_span(vs_session *s, vs_pos place, vs_span *out); /* returns false for a place outside of the user's
                                                                  * sources */
/* Sets *out to the condition's place; inside the library, to the innermost call of the user's own. Returns false if
 * there is none in the user's sources. */
bool vs_session_condition_place(vs_session *s, const vs_condition *c, vs_span *out);
vs_outcome vs_session_report_error(vs_session *s, const vs_error *e);
void vs_session_report(vs_session *s, vs_severity severity, vs_outcome outcome, const vs_origin *origin,
                       const char *message);
/* Reports an error with its outcome at a place of a file; an empty `at`: no place. */
void vs_session_report_at(vs_session *s, vs_severity severity, vs_outcome outcome, vs_span at, const char *message);
void vs_session_warn(void *session, const vs_origin *origin, const char *message); /* for vs_bind.warn */
/* Reports to the host that memory has run out. Returns VS_OUTCOME_MACHINE. */
vs_outcome vs_session_out_of_memory(vs_session *s);

#endif
