/* Declares the arguments of a checked call, as C data for the function that implements a procedure. Headers that only
 * pass vs_args on declare the type themselves. */
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
    vs_vec3 point;                             /* value of a point, a gvector or three factors */
    struct { vs_vec3 at, direction; } line;    /* value of an axis, or of a plane by a point and its normal */
    vs_affine matrix;
    vs_ref ref;                                /* value of an object, or for a list of objects of their union */
    struct { vs_ref *at; size_t count; } refs; /* value of a list of objects: the objects in order, with the elements of
                                                * nested lists */
    struct { vs_vec3 *at; size_t count; } points;
    /* Value of a list of objects and points, sorted into two arrays. */
    struct { vs_ref *at; size_t count; vs_vec3 *points; size_t point_count; } things;
    struct { const vs_value *at; size_t count; } values; /* value of a rest parameter: the remaining arguments,
                                                          * unconverted */
    struct { uint32_t *starts, *corners; size_t count; } faces; /* value of a list of faces. starts[i]: index in
                                                                 * `corners` of the first corner of face i; starts has
                                                                 * count + 1 elements */
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
  vs_store *store;              /* the store of `bind`, in which nodes are created */
  const struct vs_procedure *procedure;
  vs_procedure_fn *function;    /* the C function of the procedure */
  const char *names;            /* names of the procedure, separated by spaces; the name of an internal procedure begins
                                 * with '%' */
  int given;                    /* number of positional arguments of the call, including those of a rest parameter */
  int form, count;              /* form: index of the form that fits the arguments; count: number of positional
                                 * arguments, where all arguments of a rest parameter count as one */
  vs_arg arg[VS_CALL_ARGUMENTS], key[VS_CALL_KEYS];
  struct vs_scratch *scratch;   /* blocks of memory and nodes that are freed when the call ends */
};

#endif
