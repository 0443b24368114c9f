/* Owns the arguments of a checked call, as the C data that the body of a procedure gets. Headers that only pass vs_args
 * on announce it. */
#ifndef VS_BIND_CALL_CALL_H
#define VS_BIND_CALL_CALL_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* The room for the arguments of one call. procedure.h says how long a row of the table may be; contract.c holds that to
 * it. */
enum { VS_CALL_ARGUMENTS = 16, VS_CALL_KEYS = 11 };

typedef struct vs_arg {
  bool given;
  vs_value value; /* as it came; lives in the native's arguments: rooted there, not here */
  union {
    double real;
    int64_t integer;
    bool boolean;
    vs_vec3 point;                             /* points, gvectors, factors */
    struct { vs_vec3 at, direction; } line;    /* axes; planes: a point and the normal */
    vs_affine matrix;
    vs_ref ref;                                /* one object; a list's union */
    struct { vs_ref *at; size_t count; } refs; /* flattened lists of objects */
    struct { vs_vec3 *at; size_t count; } points;
    /* objects, and points among them */
    struct { vs_ref *at; size_t count; vs_vec3 *points; size_t point_count; } things;
    struct { const vs_value *at; size_t count; } values; /* the rest as it came */
    struct { uint32_t *starts, *corners; size_t count; } faces; /* starts has count + 1 */
    const vs_material *material;
    struct vs_scope *scope;
    struct { const char *at; size_t length; } text;
  };
} vs_arg;

typedef struct vs_args vs_args;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

struct vs_args {
  vs_scheme *vm;
  vs_bind *bind;
  vs_store *store;              /* bind's */
  const struct vs_procedure *procedure;
  vs_procedure_fn *function;    /* its C function */
  const char *names;            /* its names, with spaces between them; '%' before that of a helper */
  int form, count;              /* which form; how many positional arguments (a rest counts as one) */
  vs_arg arg[VS_CALL_ARGUMENTS], key[VS_CALL_KEYS];
  struct vs_scratch *scratch;   /* freed when the call ends */
};

#endif
