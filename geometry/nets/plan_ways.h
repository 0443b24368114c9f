/* Declares shortest ways and views in plans: rooms with walls around them and obstacles in them, which doors
 * connect. */
#ifndef VS_GEOMETRY_NETS_PLAN_WAYS_H
#define VS_GEOMETRY_NETS_PLAN_WAYS_H

#include <stddef.h>
#include <stdint.h>

#include "geometry/plane/ear_clipping.h"
#include "model/long_work.h"

typedef struct {
  const vs_vec2 *at; /* corners of the loops, one loop after another */
  size_t count;
  const size_t *size; /* size[i]: number of corners of loop i, at least 3 */
  const size_t *room; /* room[i]: number of the room to which loop i belongs; a room is the area inside an odd number of
                       * its loops */
  size_t loops, rooms;
} vs_plan;

/* A place of a plan at which shortest ways turn or end: a corner that juts into a room, a door or an exit. */
typedef struct {
  vs_vec2 at;
  double far;    /* length of the shortest way from this place to an exit; INFINITY if no way leads to an exit */
  uint32_t next; /* index of the next place on this place's shortest way to an exit; VS_NO_PLACE for an exit */
} vs_plan_place;
#define VS_NO_PLACE UINT32_MAX

typedef enum { VS_PLAN_DONE, VS_PLAN_STOPPED, VS_PLAN_MEMORY } vs_plan_outcome;

/* Sets *out to all places of the plan (exits, then doors, then corners) with their shortest ways to an exit, and *count
 * to their number. The caller frees *out. */
vs_plan_outcome vs_plan_ways(const vs_plan *p, const vs_vec2 *exits, size_t exit_count, const vs_vec2 *doors,
                             size_t door_count, vs_long_work work, vs_plan_place **out, size_t *count);

/* Returns true if the point is in a room or on its border. */
bool vs_plan_contains(const vs_plan *p, vs_vec2 at);
/* Sets *far to the length of the shortest way from a point to an exit, and *first to the index of the first place on
 * this way. If there is no way, sets them to INFINITY and VS_NO_PLACE. Returns false when memory is out. */
bool vs_plan_way(const vs_plan *p, const vs_plan_place *places, size_t count, vs_vec2 from, double *far,
                 uint32_t *first);
/* Sets *out to the corners of the area that is visible from the point `from`; the caller frees *out. *count: number of
 * corners; 0 if the point is in no room. Returns false when memory is out. */
bool vs_plan_view(const vs_plan *p, vs_vec2 from, vs_vec2 **out, size_t *count);

#endif
