/* Owns the interface of comparison.c: the data that a session keeps of the comparison of two drawings. */
#ifndef VS_SESSION_COMPARISON_H
#define VS_SESSION_COMPARISON_H

#include "session/session.h"

void vs_session_free_comparison(vs_session *s);
/* `each` gets each part that differs, until it returns false. */
typedef struct {
  bool (*each)(void *context, vs_part_difference what, const vs_part_info *before, const vs_part_info *after);
  void *context;
} vs_part_listener;
/* Compares two objects as vs_drawing_compare compares two drawings. listener: may be NULL. Returns false when memory is
 * out or the host interrupts. */
bool vs_session_compare_objects(vs_session *s, const vs_ref objects[2], bool *same, const vs_part_listener *listener,
                                vs_error *e);
/* Replaces the node of *ref, which the caller owns, by a slightly larger one, so that it shares no walls with unchanged
 * parts. number: its index among the results of vs_drawing_compare. Unchanged parts stay. */
bool vs_session_swell(vs_session *s, size_t number, vs_ref *ref, vs_error *e);

#endif
