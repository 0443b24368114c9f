/* Owns scopes: what rules are applied to. A scope is immutable and counted; its children hold it, so that a path can
 * be read.
 *
 * Frames are right-handed: x along, y up, z out of the face. The y of a root box is the world's +Z and its z the
 * world's -Y, so that a root looks as its object does from the front. Corner i, j, k of a box or hexahedron is
 * corner[i + 2 j + 4 k].
 *
 * A scope's hash is a hash of its path: of the place of its root, and of rule, operator, step and index on each
 * level. Chance is drawn from it, so that an edited rule changes no other choice. */
#ifndef VS_BIND_RULES_SCOPE_H
#define VS_BIND_RULES_SCOPE_H

#include "bind/objects.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

typedef enum {
#define VS_SCOPE(upper, predicate, noun, printed) VS_SCOPE_##upper,
#include "bind/rules/scopes.def"
#undef VS_SCOPE
  VS_SCOPE_CLASSES
} vs_scope_class;
#define VS_SCOPE_BIT(upper) (1u << VS_SCOPE_##upper)

/* The flags that hold in a scope, sorted by address; shared by all scopes below the one that got them. */
typedef struct {
  uint32_t refs, count;
  const char *name[];
} vs_scope_flags;

/* The loops of scopes of a polygon, a triangle and a curve: rows of points, the outer one first and counter-
 * clockwise about the frame's z, holes clockwise. A triangle has one loop of three points; a curve's loop is its
 * sampled points. */
typedef struct {
  uint32_t refs, count;
  const vs_points *points;
  uint32_t start[];
} vs_scope_loops; /* start has count + 1 */

typedef struct vs_scope vs_scope;

/* The fields that few scopes have: a mark, or signals. */
typedef struct vs_scope_extra vs_scope_extra;
struct vs_scope_extra {
  uint32_t refs, count;
  size_t room;
  vs_store *store;       /* retained */
  vs_scope_extra *next;  /* of those that are being released */
  const vs_ticket *mark; /* of scope-mark's name and properties, which the heap has (rules.scm); or NULL */
  vs_scope **from;       /* the scopes that sent signals, in their order; retained */
};

struct vs_scope {
  uint32_t refs;
  uint8_t class_;
  bool closed;             /* a curve that closes */
  bool backed;             /* a turtle that has set the back of its next hexahedron */
  uint32_t depth;          /* rules and operators from the root */
  uint32_t index, count;   /* among the scopes that the operator made */
  uint64_t hash;           /* of the path */
  double left, right;      /* outer angles at both ends of a side; 0 elsewhere */
  const char *rule;        /* the rule whose operator made it, or NULL; the store's */
  const char *op;          /* the operator; NULL for a root */
  const vs_origin *origin; /* where the operator stands */
  vs_scope *parent;        /* NULL for a root */
  vs_scope_flags *flags;   /* NULL: none */
  vs_scope_extra *extra;   /* NULL: none */
  vs_store *store;
  vs_ref object;         /* MESH, SURFACE, CURVE: what it was made of; node NULL elsewhere */
  vs_scope_loops *loops; /* POLYGON, TRIANGLE, CURVE; NULL elsewhere */
  union {                /* last: a scope is allocated as large as its class is */
    struct {
      vs_affine frame;
      vs_vec3 size;
    } box;             /* polygons, triangles, curves: the frame and the size of the box around them */
    vs_vec3 corner[8]; /* FFD */
    struct {
      vs_affine frame;
      double width, height;
      vs_vec3 back[4];
    } turtle; /* columns: to the left, up, ahead, position */
  } as;
};

extern const vs_foreign_type vs_scope_type;
/* May v be a rule: a procedure of a scope, an object to place, or #f? */
static inline bool vs_is_rule(vs_value v) { return v == VS_FALSE || vs_is_procedure(v) || vs_bind_take_ref(v).node; }

/* Returns the scope that v is, or NULL. */
static inline vs_scope *vs_bind_take_scope(vs_value v) { return (vs_scope *)vs_foreign_get(v, &vs_scope_type); }
const char *vs_scope_noun(const vs_scope *s); /* "a box scope" */

vs_scope *vs_scope_retain(vs_scope *s);
void vs_scope_release(vs_scope *s); /* iterative: a path may be a million scopes long; NULL is fine */
/* A new root of a class, all else zero; its hash is that of nothing. NULL: out of memory. */
vs_scope *vs_scope_fresh(vs_store *store, vs_scope_class c);
/* A copy of s with the same path, to be changed before anyone else sees it. NULL: out of memory. */
vs_scope *vs_scope_copy(const vs_scope *s);
/* s, just made and of the same class as of, gets its shape: frame, size, corners, object, loops. */
void vs_scope_become(vs_scope *s, const vs_scope *of);
/* s, just made, gets the path of another, whose class may differ: all but its shape. */
void vs_scope_take_path(vs_scope *s, const vs_scope *of);
/* Hands a scope over to Scheme: *out owns it. */
vs_status vs_bind_give_scope(vs_scheme *vm, vs_scope *s /* taken over; NULL: out of memory */, vs_value *out);
/* Seeds a root's hash by the place where it lies. */
void vs_scope_plant(vs_scope *s, vs_vec3 at);
uint64_t vs_scope_mix(uint64_t hash, uint64_t more);
void vs_scope_flags_release(vs_store *store, vs_scope_flags *f); /* NULL is fine */
/* Gives s, which nobody else sees yet, the mark of another. */
bool vs_scope_set_mark(vs_scope *s, const vs_ticket *mark);
/* A signal for s, whose extra is its own. False: out of memory. */
bool vs_scope_add_signal(vs_scope *s, vs_scope *from);
bool vs_scope_flags_have(const vs_scope_flags *flags /* NULL: none */, const char *name /* the store's */);
bool vs_scope_has_flag(const vs_scope *s, const char *name /* the store's */);
/* s with flags besides those it has. False: out of memory. */
bool vs_scope_add_flags(vs_scope *s, const char *const *names, size_t count);
/* Its path as "facade/split.0/floor/repeat.3", at most room bytes; a long one loses its middle. */
void vs_scope_path_text(const vs_scope *s, char *text, size_t room);

/* ---- where it lies ---- */
vs_vec3 vs_scope_corner(const vs_scope *s, int i, int j, int k);
void vs_scope_corners(const vs_scope *s, vs_vec3 corner[8]);
/* Sizes along x, y, z; of a hexahedron the means of its edges'. */
vs_vec3 vs_scope_size(const vs_scope *s);
/* The frame: columns x, y, z and the first corner. Of a hexahedron: x along the mean of its x edges, y nearest its y
 * edges. */
vs_affine vs_scope_frame(const vs_scope *s);

/* s, a box just made, gets the place of an edge: x along it, y nearest that axis of the frame, no height, no depth. */
void vs_scope_lay_edge(vs_scope *s, const vs_affine *frame, int up, vs_vec3 from, vs_vec3 to);

/* Loops of a polygon scope. The points are copied. NULL: out of memory. */
vs_scope_loops *vs_scope_loops_new(vs_store *store, const vs_vec3 *at, const uint32_t *start, uint32_t count);
void vs_scope_loops_release(vs_store *store, vs_scope_loops *l);
/* Sets a polygon's or triangle's frame and size from its loops: x along its first edge, z by its vector area. False:
 * it has no area. */
bool vs_scope_frame_loops(vs_scope *s);

#endif
