/* Owns the interface of parameters.c: define-parameter. */
#ifndef VS_BIND_PARAMETERS_H
#define VS_BIND_PARAMETERS_H

#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* the same as in the public header */
typedef enum { VS_P_BOOLEAN, VS_P_INTEGER, VS_P_REAL, VS_P_STRING, VS_P_DATUM } vs_bind_parameter_type;
typedef struct vs_bind_parameter {
  const char *name, *label, *group, *unit; /* these texts are the store's */
  vs_bind_parameter_type type;
  const char *value, *default_value; /* as written data, strings without quotes */
  bool has_range;
  bool least, most;     /* the definition gave min, max: values outside are refused */
  double min, max, step;
  const char **choices; /* written as value is; choice_count of them; owned by this table */
  size_t choice_count;
  vs_pos at;
} vs_bind_parameter;
typedef struct vs_bind_setting { const char *name, *datum; bool used; } vs_bind_setting; /* one -D of the command
                                                                                          * line */

/* Stores a setting for a later define-parameter; a NULL datum deletes it. Returns false when memory is out. */
bool vs_bind_set_parameter(vs_bind *b, const char *name, const char *datum);

#endif
