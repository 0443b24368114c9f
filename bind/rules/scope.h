/* Owns scopes, to which rules are applied. A scope is immutable and counted. It holds its parent, so that its path can
 * be read.
 *
 * Frames are right-handed: x along, y up, z out of the face. The y of a root box is the world's +Z and its z the
 * world's -Y. Therefore a root, seen from its front, shows its object from the front. Corner i, j, k of a box or
 * hexahedron is corner[i + 2 j + 4 k].
 *
 * A scope's hash is a hash of its path: the place of its root, and rule, operator, step and index on each level. Random
 * numbers come from it, so an edited rule changes no other choice. */
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

/* The flags of a scope, sorted by address. All scopes below the one that set them share them. */
typedef struct {
  uint32_t refs, count;
  const char *name[];
} vs_scope_flags;

/* The loops of scopes of a polygon, a triangle and a curve: rows of points, the outer one first and counterclockwise
 * about the frame's z, holes clockwise. A triangle has one loop of three points; a curve's loop is its sampled
 * points. */
typedef struct {
  uint32_t refs, count;
  const vs_points *points;
  uint32_t start[];
} vs_scope_loops; /* start has count + 1 */

typedef struct vs_scope vs_scope;

/* The fields of few scopes: a mark, or signals. */
typedef struct vs_scope_extra vs_scope_extra;
struct vs_scope_extra {
  uint32_t refs, count;
  size_t room;
  vs_store *store;       /* retained */
  vs_scope_extra *next;  /* links those that are being released */
  const vs_ticket *mark; /* The name and properties of scope-mark, which the heap has (rules.scm); or NULL. */
  vs_scope **from;       /* the scopes that sent signals, in order; retained */
};

struct vs_scope {
  uint32_t refs;
  uint8_t class_;
  bool closed;             /* a closed curve */
  bool backed;             /* a turtle that has set the back of its next hexahedron */
  uint32_t depth;          /* the number of rules and operators from the root */
  uint32_t index, count;   /* its number among the count scopes that the operator made */
  uint64_t hash;           /* the hash of the path */
  double left, right;      /* outer angles at both ends of a side; 0 for others */
  const char *rule;        /* the rule whose operator made it, or NULL; owned by the store */
  const char *op;          /* the operator; NULL for a root */
  const vs_origin *origin; /* the place of the operator's call */
  vs_scope *parent;        /* NULL for a root */
  vs_scope_flags *flags;   /* NULL: none */
  vs_scope_extra *extra;   /* NULL: none */
  vs_store *store;
  vs_ref object;         /* MESH, SURFACE, CURVE: the object that it was made from; otherwise node is NULL */
  vs_scope_loops *loops; /* POLYGON, TRIANGLE, CURVE; otherwise NULL */
  union {                /* last: each class allocates only its own part */
    struct {
      vs_affine frame;
      vs_vec3 size;
    } box;             /* the frame and the size; for polygons, triangles and curves of the box around them */
    vs_vec3 corner[8]; /* FFD */
    struct {
      vs_affine frame;
      double width, height;
      vs_vec3 back[4];
    } turtle; /* columns: left, up, ahead, position */
  } as;
};

extern const vs_foreign_type vs_scope_type;
/* Returns true if v may be a rule: a procedure of a scope, an object to place, or #f. */
static inline bool vs_is_rule(vs_value v) { return v == VS_FALSE || vs_is_procedure(v) || vs_bind_take_ref(v).node; }

/* Returns the scope in v, not retained, or NULL. */
static inline vs_scope *vs_bind_take_scope(vs_value v) { return (vs_scope *)vs_foreign_get(v, &vs_scope_type); }
const char *vs_scope_noun(const vs_scope *s); /* "a box scope" */

vs_scope *vs_scope_retain(vs_scope *s);
void vs_scope_release(vs_scope *s); /* iterative: a path may be a million scopes long; NULL is fine */
/* Returns a new root of a class, all else 0. Its hash is that of an empty path. NULL: out of memory. */
vs_scope *vs_scope_fresh(vs_store *store, vs_scope_class c);
/* Returns a copy of s with the same path, which the caller may change while it holds the only reference. NULL: out of
 * memory. */
vs_scope *vs_scope_copy(const vs_scope *s);
/* Copies the shape of `of` to s, new and of the same class: frame, size, corners, object, loops. */
void vs_scope_become(vs_scope *s, const vs_scope *of);
/* Copies the path of another scope to s, which is new: all but its shape. The classes may differ. */
void vs_scope_take_path(vs_scope *s, const vs_scope *of);
/* Makes a Scheme value of a scope: *out owns it. */
vs_status vs_bind_give_scope(vs_scheme *vm, vs_scope *s /* taken over; NULL: out of memory */, vs_value *out);
/* Seeds a root's hash with its place. */
void vs_scope_plant(vs_scope *s, vs_vec3 at);
uint64_t vs_scope_mix(uint64_t hash, uint64_t more);
void vs_scope_flags_release(vs_store *store, vs_scope_flags *f); /* NULL is fine */
/* Gives the mark to s, which must have no other reference. Returns false when memory is out. */
bool vs_scope_set_mark(vs_scope *s, const vs_ticket *mark);
/* Adds a signal to s; copies s's extra first if it is shared. Returns false when memory is out. */
bool vs_scope_add_signal(vs_scope *s, vs_scope *from);
bool vs_scope_flags_have(const vs_scope_flags *flags /* NULL: none */, const char *name /* owned by the store */);
bool vs_scope_has_flag(const vs_scope *s, const char *name /* owned by the store */);
/* Adds flags to those of s. Returns false when memory is out. */
bool vs_scope_add_flags(vs_scope *s, const char *const *names, size_t count);
/* Writes its path as "facade/split.0/floor/repeat.3", at most room bytes; the beginning of a long one is omitted. */
void vs_scope_path_text(const vs_scope *s, char *text, size_t room);

/* ---- place ---- */
vs_vec3 vs_scope_corner(const vs_scope *s, int i, int j, int k);
void vs_scope_corners(const vs_scope *s, vs_vec3 corner[8]);
/* Returns the sizes along x, y, z; of a hexahedron the means over its edges. */
vs_vec3 vs_scope_size(const vs_scope *s);
/* Returns the frame: columns x, y, z and the first corner. A hexahedron's x is the mean of its x edges, and y is
 * nearest its y edges. */
vs_affine vs_scope_frame(const vs_scope *s);

/* Sets s, a new box, to an edge: x along it, y nearest axis `up` of the frame, without height and depth. */
void vs_scope_lay_edge(vs_scope *s, const vs_affine *frame, int up, vs_vec3 from, vs_vec3 to);

/* Returns the loops of a polygon scope, with copied points. NULL: out of memory. */
vs_scope_loops *vs_scope_loops_new(vs_store *store, const vs_vec3 *at, const uint32_t *start, uint32_t count);
void vs_scope_loops_release(vs_store *store, vs_scope_loops *l);
/* Sets a polygon's or triangle's frame and size by its loops: x along its first edge, z along its vector area. Returns
 * false if it has no area. */
bool vs_scope_frame_loops(vs_scope *s);

#endif
