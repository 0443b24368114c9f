/* Owns the data of a checked call: the kinds of arguments, a procedure's forms, and the arguments as C data. */
#ifndef VS_BIND_CALL_CALL_H
#define VS_BIND_CALL_CALL_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

typedef enum {
#define VS_CONTRACT(name, noun, condition, convert) VS_C_##name,
#include "bind/call/contracts.def"
#undef VS_CONTRACT
} vs_contract;

enum { VS_MAX_ARGUMENTS = 16, VS_MAX_FORMS = 4, VS_MAX_KEYS = 11 };

typedef enum { VS_ARG_END, VS_ARG_REQUIRED, VS_ARG_OPTIONAL, VS_ARG_REST } vs_parameter_mode;
typedef struct { char name[14]; uint8_t mode, contract; } vs_bind_param;
typedef struct { bool used; vs_bind_param at[VS_MAX_ARGUMENTS + 1]; } vs_form;

typedef struct {
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

struct vs_procedure;
struct vs_args;
typedef vs_status vs_procedure_fn(struct vs_args *f, vs_value *out);

typedef struct vs_args {
  vs_scheme *vm;
  vs_bind *bind;
  vs_store *store;              /* bind's */
  const struct vs_procedure *procedure;
  vs_procedure_fn *function;    /* its C function */
  const char *names;            /* its names, with spaces between them; '%' before that of a helper */
  int form, count;              /* which form; how many positional arguments (a rest counts as one) */
  vs_arg arg[VS_MAX_ARGUMENTS], key[VS_MAX_KEYS];
  struct vs_scratch *scratch;   /* freed when the call ends */
} vs_args;

typedef struct vs_procedure {
  vs_form form[VS_MAX_FORMS];
  vs_bind_param key[VS_MAX_KEYS + 1];
} vs_procedure;

/* Returns the first name of f's procedure, in room. A helper speaks for the procedure that it helps: the mark before
 * its name is omitted. */
static inline const char *vs_bind_own_name(const vs_args *f, char room[64]) {
  const char *names = f->names + (*f->names == '%');
  size_t n = strcspn(names, " ");
  if (n > 63) n = 63;
  memcpy(room, names, n);
  room[n] = 0;
  return room;
}

#endif
