/* Declares the rules of a design, which (require-that ...) of the library (visualscheme building) has tested. */
#ifndef VS_BIND_SOLIDS_DESIGN_RULES_H
#define VS_BIND_SOLIDS_DESIGN_RULES_H

#include "model/node.h"

/* A tested rule. The store owns the texts. shortfall: 0 if the rule is met; otherwise the relative distance of a value
 * from its bound, or 1 without numbers. */
typedef struct vs_design_rule {
  const char *name, *condition, *found;
  double shortfall;
  const vs_origin *origin;
} vs_design_rule;

#endif
