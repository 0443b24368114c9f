/* Declares the arguments of a checked call, as C data for the function that implements a procedure. Headers that only
 * pass a pointer to vs_args on do not include this header. */
#ifndef VS_BIND_CALL_CALL_H
#define VS_BIND_CALL_CALL_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* Greatest numbers of arguments and of keywords in one call. procedure.h limits the rows of the table, and contract.c
 * asserts that each row fits. */
enum { VS_CALL_ARGUMENTS = 16, VS_CALL_KEYS = 11 };

typedef struct vs_arg {
  bool given;
  vs_value value; /* the unconverted argument; the garbage collector keeps it alive, because it is an element of the
                   * native's arguments */
  union {
    double real;
    int64_t integer;
    bool boolean;
    vs_vec3 point;                             /* of a point, a gvector or three factors: the coordinates */
    struct { vs_vec3 at, direction; } line;    /* of an axis or a plane: a point, and the direction or normal */
    vs_affine matrix;
    vs_ref ref;                                /* of an object: itself; of a list of objects: their union */
    struct { vs_ref *at; size_t count; } refs; /* of a list of objects: the objects in order, including the elements of
                                                * nested lists */
    struct { vs_vec3 *at; size_t count; } points;
    /* Of a list of objects and points: the objects `at` and the points in two arrays. */
    struct { vs_ref *at; size_t count; vs_vec3 *points; size_t point_count; } things;
    struct { const vs_value *at; size_t count; } values; /* of a rest parameter: the remaining arguments, unconverted */
    struct { uint32_t *starts, *corners; size_t count; } faces; /* of a list of faces. starts[i]: index in `corners` of
                                                                 * the first corner of face i; starts has count + 1
                                                                 * elements */
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
  vs_store *store;              /* the store in which the call creates nodes */
  const struct vs_procedure *procedure;
  vs_procedure_fn *function;    /* the C function that implements the procedure */
  const char *names;            /* names of the procedure, separated by spaces; the name of an internal procedure begins
                                 * with '%' */
  int given;                    /* number of positional arguments of the call, including those of a rest parameter */
  int form, count;              /* form: index of the procedure's form that fits the arguments; count: number of
                                 * positional arguments, where all arguments of a rest parameter count as one */
  vs_arg arg[VS_CALL_ARGUMENTS], key[VS_CALL_KEYS];
  struct vs_scratch *scratch;   /* blocks of memory and nodes that are freed when the call ends */
};

#endif
