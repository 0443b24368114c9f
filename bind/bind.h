/* Owns bind/'s own interface: the interpreter's drawing and its objects, the checked call, and what
 * session/visualscheme.c needs of it.
 *
 * Plan. procedures.def lists every procedure with the forms of its arguments. All of them are one C native,
 * vs_bind_enter: it finds the row of the running native, picks the form, checks and converts the arguments by
 * contract.c, and calls the row's C function with plain C data. Therefore no constructor tests anything that its row
 * already says. */
#ifndef VS_BIND_BIND_H
#define VS_BIND_BIND_H

#include "vm/machine/native.h"
#include "vm/machine/activation.h"
#include "vm/machine/activation.h"

#include "geometry/measure/node_measures.h"
#include "model/scene.h"

/* ---- flat records (flat.c) ---- */
enum { VS_FLAT_POINT = 1, VS_FLAT_VECTOR, VS_FLAT_AXIS, VS_FLAT_PLANE, VS_FLAT_MATRIX, VS_FLAT_INTERVAL };
void vs_bind_flat_rules(vs_flat_rules *rules);

/* ---- the drawing and what else an interpreter has besides its heap (state.c); vm->host points to one ---- */
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
typedef struct { const char *name, *datum; bool used; } vs_bind_setting; /* -D */
/* that the program brought; texts are the store's */
typedef struct { const char *name, *suffix, *doc; bool binary, optimised; } vs_bind_back_end;

struct vs_bind {
  vs_scheme *vm;
  vs_store *store;
  vs_scene scene;
  /* top-level values: the model if nothing was drawn; each may be a list. `returned` are references of our own */
  /* shown: printed at the prompt, or drawn until another drawing took its place: so not thrown away */
  struct { vs_node *node; const vs_origin *origin; bool shown; } *returned;
  size_t returned_count, returned_room;
  bool drew;                       /* the root has a drawing: what was returned does not count */
  const vs_node *drawn_last;       /* what draw gave back last: an address to compare with, not a reference */
  const vs_node *drawn_away;       /* the same, of draw in a node whose focus has ended since */
  /* objects that bodies threw away, one a place (thrown.c); references of our own */
  struct { vs_node *node; const vs_origin *origin; } dropped[16];
  size_t dropped_count;
  uint64_t *told;                  /* warnings given: hashes of place and kind, open addressing, 0 free */
  size_t told_count, told_room;
  /* origins of call chains seen last, since that collection */
  struct { uint64_t key; const vs_origin *origin; } recent[64];
  uint64_t recent_collection;
  vs_bind_parameter *parameters;
  size_t parameter_count, parameter_room;
  vs_bind_setting *settings;
  size_t setting_count, setting_room;
  size_t refused;                  /* allocations that were refused so far: tells "no such" from "no memory" */
  uint32_t library_files;          /* files with smaller numbers are the language's own; so are those of
                                    * vs_config.shipped */
  vs_inside_cache *inside;         /* what contains? has prepared; NULL at first */
  /* users' kinds (custom.c): the ticket of each number that some node holds, and the numbers that none holds any
   * more */
  vs_ticket **tickets;
  uint32_t *gone;
  size_t ticket_count, ticket_room, gone_count;
  vs_error handed;                 /* what was wrong with a drawing function's result, with the object's place; kind
                                    * NONE: nothing */
  /* a node of the scene has the focus: the drawing is its own, and what top-level expressions return is no model */
  bool away;
  /* calls a procedure of the host's by its number, the first argument; NULL: there is no host */
  vs_native_fn *host_call;
  bool handing;                    /* a drawing function is at work: draw gives its object; nothing changes the scene */
  struct vs_derivation *growing;   /* the derivation whose rule is running; NULL: none (rules/derivation.h) */
  /* what derivations gave, with the record of each (rules/lineage.h); looked through at the limit */
  struct vs_kept_lineage *records;
  size_t record_count, record_room, record_limit;
  vs_bind_back_end *back_ends;
  size_t back_end_count, back_end_room;
  bool (*is_built_in)(const char *name); /* is it the name or the ending of one of the library's own formats? */
  bool (*is_format)(const vs_bind *b, const char *name); /* may `register-drawing-function` name it? */
  bool bad_parameter;              /* the error under way is a -D value's fault: exit 2 */
  /* the host: shows a warning; origin NULL is nowhere */
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  void *warn_context;
};

bool vs_bind_open(vs_bind *b, vs_scheme *vm, vs_store *store); /* zeroed b; false: out of memory */
void vs_bind_close(vs_bind *b);
void vs_bind_restart(vs_bind *b); /* as just opened, but for the settings of parameters; the old heap is gone */
void vs_bind_clear_drawing(vs_bind *b);
static inline vs_bind *vs_bind_of(vs_scheme *vm) { return (vs_bind *)vm->host; }

/* A setting that define-parameter will take; datum NULL: forgets it. False: out of memory. */
bool vs_bind_set_parameter(vs_bind *b, const char *name, const char *datum);

extern const vs_native_table vs_bind_table, vs_bind_reserved_table, vs_bind_data_table;

/* A top-level expression's value: remembers the objects in it. False: error set. */
bool vs_bind_returned(vs_bind *b, vs_value v, bool shown);
/* Is the model what top-level expressions returned (nothing was drawn)? If not, warns of what they threw away. */
bool vs_bind_finish(vs_bind *b);

/* ---- what was thrown away (thrown.c) ---- */
void vs_bind_dropped(vs_scheme *vm, vs_value v); /* a body's expression before its last gave v: for vs_config */
void vs_bind_tell_dropped(vs_bind *b);    /* warns of those that did not become part of the model, and forgets them */
void vs_bind_forget_dropped(vs_bind *b);
void vs_bind_warn_thrown(vs_bind *b, const vs_node *node, const vs_origin *origin, bool in_body);

/* ---- objects (objects.c) ---- */
/* a shape owns a reference to a node, with its origin; a paint wraps an interned vs_material */
extern const vs_foreign_type vs_shape_type, vs_paint_type;
/* Returns the reference that a Scheme object holds, not retained; its node is NULL if v is no object. */
static inline vs_ref vs_bind_ref(vs_value v) {
  vs_node *node = (vs_node *)vs_foreign_get(v, &vs_shape_type);
  return (vs_ref){ node, node ? (const vs_origin *)vs_as_foreign(v)->with : NULL };
}

/* Where the running native was called from, and its callers. NULL: not known (or out of memory: then nothing worse
 * happens). */
const vs_origin *vs_bind_origin(vs_bind *b);
vs_status vs_bind_wrap_ref(vs_bind *b, vs_ref ref /* retained */, vs_value *out); /* with the place where it was made */
vs_status vs_bind_wrap(vs_bind *b, vs_node *node /* taken over; NULL: out of memory */, vs_value *out);
/* A position's file as text of the store; NULL: nowhere, or one of the language's own sources: places in those are not
 * the user's business. */
const char *vs_bind_file_name(vs_bind *b, vs_pos place);
bool vs_bind_is_library(vs_bind *b, uint32_t file); /* is the file of this number one of those sources? */
uint32_t vs_bind_file_count(vs_scheme *vm); /* files that have a number */
/* Was such a warning given for this place before? It counts as given from now on. */
bool vs_bind_warned(vs_bind *b, const vs_origin *o, const char *kind);
/* once a place and `kind` (any constant text); nothing when it could not be formatted */
void vs_bind_warn(vs_bind *b, const char *kind, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* UTF-8 with NUL from vs_mem; *bytes to give back */
bool vs_bind_text(vs_scheme *vm, vs_value string_or_symbol, char **out, size_t *bytes);

void vs_bind_ticket_gone(void *bind, uint32_t number); /* custom.c */

/* ---- printing (print.c) ---- */
bool vs_bind_print_node(const vs_node *n, bool (*put)(void *to, const char *s, size_t n), void *to);
void vs_bind_number_text(char out[32], double d); /* shortest that reads back; integers without a point */

/* ---- the checked call (contract.c) ---- */
typedef enum {
#define VS_CONTRACT(name, noun, condition) VS_C_##name,
#include "bind/contracts.def"
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
typedef struct vs_args {
  vs_scheme *vm;
  vs_bind *bind;
  const struct vs_procedure *procedure;
  int form, count;              /* which form; how many positional arguments (a rest counts as one) */
  vs_arg arg[VS_MAX_ARGUMENTS], key[VS_MAX_KEYS];
  struct vs_scratch *scratch;   /* freed when the call ends */
} vs_args;

typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);
typedef struct vs_procedure {
  vs_form form[VS_MAX_FORMS];
  vs_bind_param key[VS_MAX_KEYS + 1];
} vs_procedure;

vs_native_fn vs_bind_enter;
extern const vs_procedure vs_bind_procedures[];
/* The function of each row. Apart from the rows: 320 KB without an address in them are not written, nor read, when the
 * program is loaded. */
extern vs_procedure_fn *const vs_bind_functions[];
static inline vs_procedure_fn *vs_bind_function(const vs_args *f) {
  return vs_bind_functions[f->procedure - vs_bind_procedures];
}
extern const vs_native_def vs_bind_defs[];

void vs_bind_scratch_free(vs_args *f);
void *vs_bind_scratch(vs_args *f, size_t bytes);  /* NULL: out of memory, error set */
bool vs_bind_keep(vs_args *f, vs_node *node);     /* releases it when the call ends; NULL gives the memory error */
bool vs_bind_number(vs_scheme *vm, vs_value v, double *out);      /* any real number; false: not one */
/* false: *bad is no object, or error set and *bad absent */
bool vs_bind_refs(vs_args *f, vs_value list, vs_ref **out, size_t *count, vs_value *bad);

/* For what works long in the layers below: polls; false: the condition is set. context is the vs_scheme */
bool vs_bind_keep_going(void *vm, double done);
/* "NAME: PARAM must be EXPECTED, got VALUE" */
vs_status vs_bind_error(vs_args *f, const vs_error *e); /* what a layer below said */
/* Objects: what unions hold, each placement counted; any other operation is one. By class (index VS_CURVE ...); false:
 * out of memory */
typedef struct { double all, of[VS_INHERIT]; } vs_bind_counts;
bool vs_bind_count(vs_ref ref, vs_bind_counts *out);
int32_t vs_bind_segments(vs_bind *b);                   /* (current-segments), 0: by tolerance */
double vs_bind_tolerance(vs_bind *b);                   /* (current-tolerance), 0: by the drawing size */
/* argument i, an object, has an end; else the error says what to do */
vs_status vs_bind_finite(vs_args *f, int i);
/* The call of p, under this name, that was meant where numbers stand for points, gvectors or factors, into text;
 * false: there is none (regroup.c). */
bool vs_bind_grouped(vs_scheme *vm, const vs_procedure *p, const char *name, const vs_value *a, int n, char *text,
    size_t room);
/* "takes (make-plane point normal) or (make-plane p q r)": the ways to call it. */
void vs_bind_forms(const vs_procedure *procedure, const char *name, char *text, size_t room);
#define VS_BIND_NO_VALUE "one expression gave no value" /* in messages about lists of objects */
vs_status vs_bind_refuse(vs_args *f, const char *param, const char *expected, vs_value got);

/* Objects as drawing functions want them for a format of these names (NULL at the end): in place, new references for
 * old. False: the condition is set. Needs one registered. */
bool vs_bind_hands_on(const vs_bind *b); /* was a drawing function registered? */
bool vs_bind_hand_on(vs_bind *b, vs_ref *refs, size_t count, const char *const *names);

/* ---- back_ends.c ---- */
/* The program's back-end of this name, or of this ending of a path; NULL: it brought none such. */
const vs_bind_back_end *vs_bind_back_end_find(const vs_bind *b, const char *text);
/* Calls its procedure with these objects: *text holds *bytes bytes and room for one more, from vs_mem, the caller's to
 * free. False: the condition is set. */
bool vs_bind_back_end_write(vs_bind *b, const char *name, const vs_ref *refs, size_t count, char **text, size_t *bytes);

/* ---- building, for the functions of procedures.def (build.c) ---- */
vs_status vs_bind_make(vs_args *f, vs_kind kind, const void *data, const vs_ref *children, size_t n, vs_value *out);
/* For argument 0 that is several curves or surfaces (geometry/parts.h): the union of what one makes of each. */
vs_status vs_bind_each_part(vs_args *f, vs_procedure_fn *one, vs_value *out);
/* the empty object, with a warning once a place */
vs_status vs_bind_empty(vs_args *f, const char *why, vs_value *out);
/* sections, shadows and edges in argument i become what they are in space */
vs_status vs_bind_resolve(vs_args *f, int i);
vs_status vs_bind_node(vs_args *f, vs_node *node, vs_value *out);    /* takes the reference over */
/* a closed curve that crosses itself is refused; what: what it is */
vs_status vs_bind_uncrossed(vs_args *f, vs_ref ref, const char *what);
/* where all are regions and closed curves of one plane, the curves become regions */
vs_status vs_bind_fill(vs_args *f, vs_ref *ref, size_t n);
/* The figure *out, drawn as in the plane XY, stands in the plane instead (#:plane): about its place where the form
 * takes one point, else as the plane's own coordinates say. */
vs_status vs_bind_stand(vs_args *f, const vs_arg *plane, vs_value *out);
vs_status vs_bind_point(vs_args *f, vs_vec3 p, vs_value *out);
vs_status vs_bind_vector(vs_args *f, vs_vec3 p, vs_value *out);
vs_status vs_bind_real(vs_args *f, double d, vs_value *out);
vs_status vs_bind_matrix(vs_args *f, const vs_affine *m, vs_value *out);
vs_affine vs_bind_affine(const double *sixteen); /* the upper three rows */
static inline bool vs_bind_is_empty(const vs_node *n) { return n->kind == VS_EMPTY; }

/* every C function that procedures.def names */
#define PROC(id, name, fn, doc, forms, keys) vs_procedure_fn fn;
#define PROCS(id, name, signature, fn, doc, forms, keys) vs_procedure_fn fn;
#include "bind/procedures.def"
#undef PROC
#undef PROCS

#endif
