/* Declares scopes, the boxes and other shapes to which rules are applied. A scope is immutable and reference-counted.
 * It refers to its parent, so that its path from the root is known. A root is a scope that no operator has created from
 * another scope.
 *
 * Frames are right-handed: x along, y up, z out of the face. The y of a root box is the world's +Z, and its z the
 * world's -Y. A root box seen from its front therefore shows its object from the front. The corner with indices i, j, k
 * (0 or 1 along x, y, z) of a box or hexahedron is corner[i + 2 j + 4 k].
 *
 * The hash of a scope is computed from its path: the place of the root, and the rule, operator, step and index of each
 * level. Random numbers are computed from this hash, so that a change of one rule does not change the random choices of
 * others. */
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

/* The flags of a scope, sorted by address. Scopes that are created from it refer to the same flags, unless they set
 * more. */
typedef struct {
  uint32_t refs, count;
  const char *name[];
} vs_scope_flags;

/* The loops of a polygon, triangle or curve scope, as lists of points. The outer loop comes first and is
 * counterclockwise about the frame's z; holes are clockwise. A triangle has one loop of three points. The loop of a
 * curve has its sampled points. */
typedef struct {
  uint32_t refs, count;
  const vs_points *points;
  uint32_t start[];
} vs_scope_loops; /* start[i]: index of the first point of loop i. start has count + 1 elements */

typedef struct vs_scope vs_scope;

/* Members that few scopes need: a mark, or signals. */
typedef struct vs_scope_extra vs_scope_extra;
struct vs_scope_extra {
  uint32_t refs, count;
  size_t room;
  vs_store *store;       /* the store that allocates this block, retained */
  vs_scope_extra *next;  /* next block in a list of blocks that must be freed */
  const vs_ticket *mark; /* Ticket of a scope-mark, which counts the references to the mark's name and properties in the
                          * Scheme heap (rules.scm). NULL: the scope has no mark. */
  vs_scope **from;       /* from: the `count` scopes that have sent signals to this scope, in order; retained */
};

struct vs_scope {
  uint32_t refs;
  uint8_t class_;
  bool closed;             /* whether a curve scope is closed */
  bool backed;             /* whether the turtle has already stored the back face of its next hexahedron */
  uint32_t depth;          /* number of levels of the path: rules and operators since the root */
  uint32_t index, count;   /* the scope is child number `index` of `count` children that the operator has created */
  uint64_t hash;           /* hash of the path */
  double left, right;      /* outer angles at the two ends of a polygon's side; 0 for other scopes */
  const char *rule;        /* name of the rule that called the operator, or NULL; owned by the store */
  const char *op;          /* name of the operator that created the scope; NULL for a root (a scope without parent) */
  const vs_origin *origin; /* origin of the operator's call in the program */
  vs_scope *parent;        /* scope from which the operator created this scope; NULL for a root */
  vs_scope_flags *flags;   /* flags of the scope, or NULL */
  vs_scope_extra *extra;   /* mark and signals, or NULL */
  vs_store *store;
  vs_ref object;         /* MESH, SURFACE, CURVE: the object from which the scope was created; for other classes its
                          * node is NULL */
  vs_scope_loops *loops; /* for POLYGON, TRIANGLE and CURVE; otherwise NULL */
  union {                /* must be the last member: each class allocates only its own part of the union */
    struct {
      vs_affine frame;
      vs_vec3 size;
    } box;             /* BOX: its frame and size; POLYGON, TRIANGLE, CURVE: frame and size of the bounding box */
    vs_vec3 corner[8]; /* FFD: the corners of the hexahedron */
    struct {
      vs_affine frame;
      double width, height;
      vs_vec3 back[4];
    } turtle; /* TURTLE: the columns of its frame are left, up, ahead, position */
  } as;
};

extern const vs_foreign_type vs_scope_type;
/* Returns true if v can be a rule: a procedure with a scope as its argument, an object to place, or #f. */
static inline bool vs_is_rule(vs_value v) { return v == VS_FALSE || vs_is_procedure(v) || vs_bind_take_ref(v).node; }

/* Returns the scope in v without retaining it, or NULL if v is no scope. */
static inline vs_scope *vs_bind_take_scope(vs_value v) { return (vs_scope *)vs_foreign_get(v, &vs_scope_type); }
const char *vs_scope_noun(const vs_scope *s); /* Returns the class of a scope for messages, such as "a box scope". */

vs_scope *vs_scope_retain(vs_scope *s);
void vs_scope_release(vs_scope *s); /* Releases a reference, without recursion: a path may have a million scopes. NULL
                                     * is permitted. */
/* Returns a new root scope of this class; all other members are 0. Its hash is that of an empty path. Returns NULL when
 * memory is out. */
vs_scope *vs_scope_fresh(vs_store *store, vs_scope_class c);
/* Returns a copy of s with the same path. The caller may change the copy as long as no one else refers to it. Returns
 * NULL when memory is out. */
vs_scope *vs_scope_copy(const vs_scope *s);
/* Copies the shape of `of` to s, a new scope of the same class: frame, size, corners, object, loops. */
void vs_scope_become(vs_scope *s, const vs_scope *of);
/* Copies all members except the shape from `of` to the new scope s, which may be of another class. */
void vs_scope_take_path(vs_scope *s, const vs_scope *of);
/* Sets *out to a Scheme object of the scope s, whose reference it takes over. If s is NULL, memory was out: sets the
 * error. */
vs_status vs_bind_give_scope(vs_scheme *vm, vs_scope *s, vs_value *out);
/* Sets the hash of a root scope from its position. */
void vs_scope_plant(vs_scope *s, vs_vec3 at);
uint64_t vs_scope_mix(uint64_t hash, uint64_t more);
void vs_scope_flags_release(vs_store *store, vs_scope_flags *f); /* Releases a reference to the flags. NULL is
                                                                  * permitted. */
/* Sets the mark of the scope s, to which there must be only one reference. Returns false when memory is out. */
bool vs_scope_set_mark(vs_scope *s, const vs_ticket *mark);
/* Adds a signal from scope `from` to s. Returns false when memory is out. */
bool vs_scope_add_signal(vs_scope *s, vs_scope *from);
/* Returns true if the flags contain the name. flags NULL means no flags. */
bool vs_scope_flags_have(const vs_scope_flags *flags, const char *name /* must be owned by the store */);
bool vs_scope_has_flag(const vs_scope *s, const char *name /* must be owned by the store */);
/* Adds `count` flags with these names to the flags of s. Returns false when memory is out. */
bool vs_scope_add_flags(vs_scope *s, const char *const *names, size_t count);
/* Writes the path of s, such as "facade/split.0/floor/repeat.3", to `text`, which has `room` bytes. The beginning of a
 * long path is omitted. */
void vs_scope_path_text(const vs_scope *s, char *text, size_t room);

/* ---- corners, sizes and frames ---- */
vs_vec3 vs_scope_corner(const vs_scope *s, int i, int j, int k);
void vs_scope_corners(const vs_scope *s, vs_vec3 corner[8]);
/* Returns the sizes of a scope along x, y and z. The sizes of a hexahedron are the mean lengths of its edges. */
vs_vec3 vs_scope_size(const vs_scope *s);
/* Returns the frame of a scope: its columns are x, y, z and the first corner. The x of a hexahedron is the mean of its
 * edges along x; its y is as close as possible to its edges along y. */
vs_affine vs_scope_frame(const vs_scope *s);

/* Makes s, a new box scope, the edge between two points, without height and depth. Its x is along the edge. Its y is as
 * close as possible to axis number `up` of the frame. */
void vs_scope_lay_edge(vs_scope *s, const vs_affine *frame, int up, vs_vec3 from, vs_vec3 to);

/* Returns new loops with copies of the points at `at`, or NULL when memory is out. start[i]: index of the first point
 * of loop i. */
vs_scope_loops *vs_scope_loops_new(vs_store *store, const vs_vec3 *at, const uint32_t *start, uint32_t count);
void vs_scope_loops_release(vs_store *store, vs_scope_loops *l);
/* Sets the frame and size of a polygon or triangle scope from its loops: x along the first edge, z along the area
 * vector. Returns false if the loops have no area. */
bool vs_scope_frame_loops(vs_scope *s);

#endif
