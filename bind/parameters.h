/* Owns the interface of parameters.c: define-parameter. */
#ifndef VS_BIND_PARAMETERS_H
#define VS_BIND_PARAMETERS_H

#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* as the public header's */
typedef enum { VS_P_BOOLEAN, VS_P_INTEGER, VS_P_REAL, VS_P_STRING, VS_P_DATUM } vs_bind_parameter_type;
typedef struct vs_bind_parameter {
  const char *name, *label, *group, *unit; /* texts are the store's */
  vs_bind_parameter_type type;
  const char *value, *default_value; /* written data; strings bare */
  bool has_range;
  bool least, most;     /* min, max: the definition gave it, so that values are held to it */
  double min, max, step;
  const char **choices; /* written as value is; choice_count of them, ours */
  size_t choice_count;
  vs_pos at;
} vs_bind_parameter;
typedef struct vs_bind_setting { const char *name, *datum; bool used; } vs_bind_setting; /* -D */

/* A setting that define-parameter will take; datum NULL: forgets it. False: out of memory. */
bool vs_bind_set_parameter(vs_bind *b, const char *name, const char *datum);

#endif
