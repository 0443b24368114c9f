/* Owns the state of settling a rounded mesh (settle.c), shared with the search for what meets what then (met.c). */
#ifndef VS_KERNEL_SETTLING_H
#define VS_KERNEL_SETTLING_H

#include "kernel/memory.h"
#include "kernel/settle.h"

enum { VS_NEAR_THIN = 1, VS_NEAR_MET = 2 };

typedef struct { uint32_t first, count; } vs_fan;

typedef struct {
  vs_kernel *k;
  vs_mesh *m;
  vs_numbers numbers;      /* SOUP is SINGLE here */
  double coarsest;         /* two units where the mesh reaches furthest */
  VS_LIST(vs_fan) fans;    /* of a vertex: its triangles that are not gone, into around */
  VS_LIST(uint32_t) around;
  VS_LIST(uint32_t) look;  /* in order: triangles that may be thin, or have an edge that is too short: all that are, and what has changed since */
  VS_LIST(uint8_t) busy;   /* of a vertex: something near it has changed in this round */
  VS_LIST(uint8_t) gone;   /* of a triangle: 1; numbers stay until the end */
  VS_LIST(uint8_t) listed; /* of a triangle: 1: in look; 2: counted among those met */
  VS_LIST(uint8_t) suspect; /* of a vertex: NEAR_THIN: a triangle here was thin, or is bent by rounding; NEAR_MET: near here something meets something */
} vs_settling;

vs_vec3 vs_settling_corner(const vs_settling *s, uint32_t v); /* rounded */
/* Marks what is thin now, then counts triangles that, rounded, meet others near a suspect corner: of each, once. */
bool vs_settling_count_met(vs_settling *s, vs_settled *out);
/* Adds those of different shells, wherever. */
bool vs_settling_count_between(vs_settling *s, vs_settled *out);

/* Is it lower than rounding may move its corners by, and turned by that more than two or three degrees? */
bool vs_settling_is_noise(const vs_settling *s, uint32_t t);

#endif
