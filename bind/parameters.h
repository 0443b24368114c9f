/* Declares define-parameter and report, implemented in parameters.c. */
#ifndef VS_BIND_PARAMETERS_H
#define VS_BIND_PARAMETERS_H

#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* The types of parameters. They must be the same as in visualscheme.h. */
typedef enum { VS_P_BOOLEAN, VS_P_INTEGER, VS_P_REAL, VS_P_STRING, VS_P_DATUM } vs_bind_parameter_type;
typedef struct vs_bind_parameter {
  const char *name, *label, *group, *unit; /* texts of the definition, owned by the store */
  vs_bind_parameter_type type;
  const char *value, *default_value; /* current value and default value, in the notation of a program, but strings
                                      * without quotes */
  bool has_range;
  bool least, most;     /* least: whether the definition has #:min; most: whether it has #:max. A value outside these
                         * limits is refused */
  double min, max, step;
  const char **choices; /* array of choice_count permitted values, in the notation of `value`; owned by the parameter */
  size_t choice_count;
  vs_pos at;
} vs_bind_parameter;
/* A setting of a parameter by an option -D of the command line. used: whether a define-parameter has read it. */
typedef struct vs_bind_setting { const char *name, *datum; bool used; } vs_bind_setting;

/* A number that the program has passed to (report name value). The store owns the name. */
typedef struct vs_bind_report { const char *name; double value; } vs_bind_report;

/* Stores a setting for a define-parameter that runs later; datum NULL deletes the setting. Returns false when memory is
 * out. */
bool vs_bind_set_parameter(vs_bind *b, const char *name, const char *datum);

struct vs_design_rule;
/* Keeps a copy of the rule for the host. Returns false when memory is out. */
bool vs_bind_keep_rule(struct vs_bind *b, const struct vs_design_rule *rule);

#endif
