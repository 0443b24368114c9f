/* Declares define-parameter and report, implemented in parameters.c. */
#ifndef VS_BIND_PARAMETERS_H
#define VS_BIND_PARAMETERS_H

#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* The types of parameters; the same as in visualscheme.h. */
typedef enum { VS_P_BOOLEAN, VS_P_INTEGER, VS_P_REAL, VS_P_STRING, VS_P_DATUM } vs_bind_parameter_type;
typedef struct vs_bind_parameter {
  const char *name, *label, *group, *unit; /* texts of the definition, owned by the store */
  vs_bind_parameter_type type;
  const char *value, *default_value; /* current value and default value, as written in a program; strings without
                                      * quotes */
  bool has_range;
  bool least, most;     /* least: the definition has #:min; most: it has #:max; a value beyond these limits is
                         * refused */
  double min, max, step;
  const char **choices; /* list of choice_count permitted values, in the notation of `value`; the array belongs to this
                         * parameter */
  size_t choice_count;
  vs_pos at;
} vs_bind_parameter;
/* A value for a parameter, from an option -D of the command line. used: whether a define-parameter has used it. */
typedef struct vs_bind_setting { const char *name, *datum; bool used; } vs_bind_setting;

/* A number of the model from (report name value). The store owns the name. */
typedef struct vs_bind_report { const char *name; double value; } vs_bind_report;

/* Stores a setting for a later define-parameter; datum NULL deletes it. Returns false when memory is out. */
bool vs_bind_set_parameter(vs_bind *b, const char *name, const char *datum);

#endif
