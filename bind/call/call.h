/* Owns the arguments of a checked call, as C data for the body of a procedure. Headers that only pass vs_args on
 * declare the type without this header. */
#ifndef VS_BIND_CALL_CALL_H
#define VS_BIND_CALL_CALL_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* The room for the arguments of one call. procedure.h bounds the length of a row; contract.c asserts that each row
 * fits. */
enum { VS_CALL_ARGUMENTS = 16, VS_CALL_KEYS = 11 };

typedef struct vs_arg {
  bool given;
  vs_value value; /* unconverted; it lies in the native's arguments, which root it */
  union {
    double real;
    int64_t integer;
    bool boolean;
    vs_vec3 point;                             /* points, gvectors, factors */
    struct { vs_vec3 at, direction; } line;    /* an axis; a plane by a point and its normal */
    vs_affine matrix;
    vs_ref ref;                                /* one object; for a list its union */
    struct { vs_ref *at; size_t count; } refs; /* a flattened list of objects */
    struct { vs_vec3 *at; size_t count; } points;
    /* objects, and points between them */
    struct { vs_ref *at; size_t count; vs_vec3 *points; size_t point_count; } things;
    struct { const vs_value *at; size_t count; } values; /* the remaining arguments, unconverted */
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
  vs_store *store;              /* the store of bind */
  const struct vs_procedure *procedure;
  vs_procedure_fn *function;    /* the procedure's C function */
  const char *names;            /* the procedure's names, with spaces between them; a helper's begins with '%' */
  int form, count;              /* the number of the chosen form; the number of positional arguments (a rest counts as
                                 * one) */
  vs_arg arg[VS_CALL_ARGUMENTS], key[VS_CALL_KEYS];
  struct vs_scratch *scratch;   /* freed when the call ends */
};

#endif
