/* Declares the reports of errors and warnings to a host, implemented in report.c. */
#ifndef VS_SESSION_REPORT_H
#define VS_SESSION_REPORT_H

#include "session/session.h"

/* Copies line number `line` of a source to `room`, and returns `room`. Returns NULL if the source was not kept or has
 * no such line. */
const char *vs_session_source_line(const vs_session *s, const char *file, uint32_t line, char *room, size_t size);
vs_outcome vs_session_report_condition(vs_session *s, vs_value condition,
                                       bool usage /* usage: whether the error is the caller's fault, so that the exit
                                                   * status is 2 */);
bool vs_session_span(vs_session *s, vs_pos place, vs_span *out); /* Sets *out to the file, line and column of the place.
                                                                  * Returns false if the place lies outside the user's
                                                                  * sources. */
/* Sets *out to the place of the error c. For an error inside the library, this is the place of the innermost call in
 * the user's own text. Returns false if there is no such call. */
bool vs_session_condition_place(vs_session *s, const vs_condition *c, vs_span *out);
vs_outcome vs_session_report_error(vs_session *s, const vs_error *e);
void vs_session_report(vs_session *s, vs_severity severity, vs_outcome outcome, const vs_origin *origin,
                       const char *message);
/* Reports an error or warning, with its outcome, at a place in a file. If `at` contains no file, the report has no
 * place. */
void vs_session_report_at(vs_session *s, vs_severity severity, vs_outcome outcome, vs_span at, const char *message);
void vs_session_warn(void *session, const vs_origin *origin, const char *message); /* The function vs_bind.warn: reports
                                                                                    * a warning. */
/* Reports to the host that memory has run out. Returns VS_OUTCOME_MACHINE. */
vs_outcome vs_session_out_of_memory(vs_session *s);

#endif
