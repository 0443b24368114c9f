/* Declares the five orders of characters and strings, with and without upper and lower case: char<? ... string-ci>?. */
#ifndef VS_VM_LIBRARY_TEXT_ORDER_H
#define VS_VM_LIBRARY_TEXT_ORDER_H

#include <stdbool.h>

typedef enum { VS_LESS, VS_LESS_EQUAL, VS_EQUAL, VS_GREATER_EQUAL, VS_GREATER } vs_text_order;

/* Expands to O(name, order, fold) for each procedure; fold: whether upper and lower case count as equal. */
#define VS_ORDERS(O) \
  O(lt, VS_LESS, false) O(le, VS_LESS_EQUAL, false) O(eq, VS_EQUAL, false) O(ge, VS_GREATER_EQUAL, false) \
  O(gt, VS_GREATER, false) \
  O(ci_lt, VS_LESS, true) O(ci_le, VS_LESS_EQUAL, true) O(ci_eq, VS_EQUAL, true) O(ci_ge, VS_GREATER_EQUAL, true) \
  O(ci_gt, VS_GREATER, true)

/* Returns true if two texts are in the given order. sign: result of comparing them, below 0 if the first text is less
 * than the second. */
static inline bool vs_order_holds(vs_text_order order, int sign) {
  switch (order) {
  case VS_LESS: return sign < 0;
  case VS_LESS_EQUAL: return sign <= 0;
  case VS_EQUAL: return sign == 0;
  case VS_GREATER_EQUAL: return sign >= 0;
  case VS_GREATER: return sign > 0;
  }
  return false;
}

#endif
