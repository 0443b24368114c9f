/* Declares the functions of comparison.c, and the data that a session keeps for the comparison of two drawings. */
#ifndef VS_SESSION_DRAWING_COMPARISON_H
#define VS_SESSION_DRAWING_COMPARISON_H

#include "session/session.h"

void vs_session_free_comparison(vs_session *s);
/* Callback for each part that differs; the comparison stops when it returns false. */
typedef struct {
  bool (*each)(void *context, vs_part_difference what, const vs_part_info *before, const vs_part_info *after);
  void *context;
} vs_part_listener;
/* Compares two objects by their parts, as vs_drawing_compare compares two drawings. Sets *same to whether they are
 * equal. listener may be NULL. Returns false when memory is out or the host interrupts. */
bool vs_session_compare_objects(vs_session *s, const vs_ref objects[2], bool *same, const vs_part_listener *listener,
                                vs_error *e);
/* Replaces the node of *ref, which the caller owns, by a slightly larger node, so that its faces do not coincide with
 * those of unchanged parts. The parameter number is the object's index among the results of vs_drawing_compare. Does
 * not replace an unchanged part. */
bool vs_session_swell(vs_session *s, size_t number, vs_ref *ref, vs_error *e);

#endif
