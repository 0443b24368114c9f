/* Owns what a session keeps of the comparison of two drawings. */
#ifndef VS_SESSION_COMPARISON_H
#define VS_SESSION_COMPARISON_H

#include "session/session.h"

void vs_session_free_comparison(vs_session *s);
/* Each part that differs goes to `each` until it returns false. */
typedef struct {
  bool (*each)(void *context, vs_part_difference what, const vs_part_info *before, const vs_part_info *after);
  void *context;
} vs_part_listener;
/* Compares two objects as vs_drawing_compare does two drawings. listener: may be NULL. False: out of memory, or
 * interrupted. */
bool vs_session_compare_objects(vs_session *s, const vs_ref objects[2], bool *same, const vs_part_listener *listener,
                                vs_error *e);
/* Puts in the place of *ref, the number-th of what vs_drawing_compare found to be shown, whose node the caller owns,
 * one that reaches a little further out where it would share walls with what is unchanged. */
bool vs_session_swell(vs_session *s, size_t number, vs_ref *ref, vs_error *e);

#endif
