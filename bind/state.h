/* Owns the interface of state.c: the life of what bind/ keeps besides the heap, and the rule of what a file's model
 * is. */
#ifndef VS_BIND_STATE_H
#define VS_BIND_STATE_H

#include "geometry/measure/node_measures.h"
#include "model/scene.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;
typedef struct vs_bind_parameter vs_bind_parameter;
typedef struct vs_bind_setting vs_bind_setting;
typedef struct vs_bind_back_end vs_bind_back_end;

/* The drawing and all else that an interpreter has beside its heap; vm->host points to it. */
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
  size_t mesh_triangles;           /* the limit of what an output may have, which meshes made before keep to; 0: none */
  bool bad_parameter;              /* the error under way is a -D value's fault: exit 2 */
  /* the host: shows a warning; origin NULL is nowhere */
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  void *warn_context;
};

static inline vs_bind *vs_bind_of(vs_scheme *vm) { return (vs_bind *)vm->host; }

/* Objects: what unions hold, each placement counted; any other operation is one. By class (index VS_CURVE ...); false:
 * out of memory */
typedef struct { double all, of[VS_INHERIT]; } vs_bind_counts;

bool vs_bind_open(vs_bind *b, vs_scheme *vm, vs_store *store); /* zeroed b; false: out of memory */
void vs_bind_close(vs_bind *b);
void vs_bind_restart(vs_bind *b); /* as just opened, but for the settings of parameters; the old heap is gone */
void vs_bind_clear_drawing(vs_bind *b);
/* A top-level expression's value: remembers the objects in it. False: error set. */
bool vs_bind_returned(vs_bind *b, vs_value v, bool shown);
/* Is the model what top-level expressions returned (nothing was drawn)? If not, warns of what they threw away. */
bool vs_bind_finish(vs_bind *b);
bool vs_bind_count(vs_ref ref, vs_bind_counts *out);

#endif
