/* Implements the natives of unroll and unfold, which flattening.scm calls with checked arguments. They flatten meshes,
 * and return regions and lists of points. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bind/build.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/scratch.h"
#include "bind/constructors/operations.h"
#include "bind/measures.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/measure/node_measures.h"
#include "geometry/nets/unfolding.h"
#include "geometry/parts.h"
#include "geometry/shapes/simple_nodes.h"
#include "geometry/tessellate.h"
#include "model/store/array.h"

/* Data for flattening a mesh: its net (the mesh laid into the plane, in pieces), and data of a walk along the borders
 * of a piece. */
typedef struct {
  vs_args *f;
  vs_mesh mesh;
  vs_flat_net net;
  const vs_glue_tab **tab; /* tab[e]: the tab for glue at cut edge e, or NULL if the edge has no tab; `tab` is NULL if
                            * there are no tabs */
  vs_polyline loop;        /* the border loop that is being walked */
  vs_outline outline;      /* the completed loops of the piece */
  size_t room;
  vs_vec2 (*chain)[2];     /* the border edges of the piece, each by its two end points */
  size_t chain_count, chain_room;
  double shift;            /* distance by which the piece is moved along +X */
} sheet;

static void sheet_free(sheet *s) {
  vs_flat_net_free(&s->net);
  vs_mesh_free(&s->mesh);
  vs_polyline_free(&s->loop);
  vs_outline_free(&s->outline);
  free(s->chain), free(s->tab);
}

static bool add_corner(vs_polyline *p, double x, double y) {
  if (!VS_GROW(p->at, p->room, p->count + 1)) return false;
  p->at[p->count++] = vs_v3(x, y, 0);
  return true;
}

static bool add_border(void *context, uint32_t t, uint32_t e, const vs_vec2 ends[2]) {
  sheet *s = context;
  const vs_glue_tab *tab = s->tab ? s->tab[e] : NULL;
  if (!add_corner(&s->loop, ends[0].x + s->shift, ends[0].y)) return false;
  for (int k = 0; tab && tab->triangle == t && k < 2; k++)
    if (!add_corner(&s->loop, tab->at[k].x + s->shift, tab->at[k].y)) return false;
  return true;
}

/* Ends a border loop: adds its edges to the chain, and removes corners on a straight line between their neighbours. */
static bool end_loop(void *context) {
  sheet *s = context;
  vs_polyline *p = &s->loop;
  size_t kept = 0, n = p->count;
  if (!VS_GROW(s->chain, s->chain_room, s->chain_count + n)) return false;
  for (size_t i = 0; i < n; i++, s->chain_count++) {
    vs_vec3 from = p->at[i], to = p->at[i + 1 < n ? i + 1 : 0];
    s->chain[s->chain_count][0] = (vs_vec2){ from.x, from.y }, s->chain[s->chain_count][1] = (vs_vec2){ to.x, to.y };
  }
  for (size_t i = 0; i < n; i++) {
    vs_vec3 at = p->at[i], before = kept ? p->at[kept - 1] : p->at[n - 1], after = p->at[i + 1 < n ? i + 1 : 0];
    vs_vec3 u = vs_v3_sub(at, before), w = vs_v3_sub(after, before);
    double l = vs_v3_length(w), along = vs_v3_dot(u, w);
    bool straight = l > 0 && along > 0 && along < l * l && fabs(u.x * w.y - u.y * w.x) / l < s->net.slack * .1;
    if (!straight) p->at[kept++] = at;
  }
  p->count = kept, p->closed = true;
  if (!VS_GROW(s->outline.loops, s->room, s->outline.count + 1)) return false;
  s->outline.loops[s->outline.count++] = *p;
  *p = (vs_polyline){ 0 };
  return true;
}

/* Computes the triangles of argument 0, as fine as those for its area, and their net. */
static bool begin(sheet *s, vs_args *f) {
  vs_scheme *vm = vs_call_vm(f);
  vs_error e = { 0 };
  vs_bounds b;
  bool several;
  *s = (sheet){ .f = f };
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return false;
  vs_ref ref = vs_arg_ref(f, 0), *parts;
  size_t count;
  if (ref.node->class_ == VS_SOLID) {
    if (!vs_bend_triangles(vm, ref, &s->mesh)) return false;
  } else {
    vs_fineness facets = { .tolerance = vs_bind_tolerance(vm), .segments = vs_bind_segments(vm) };
    if (!vs_node_bounds(ref.node, &b, &e)) return vs_bind_error(vm, &e);
    if (!(facets.tolerance > 0)) facets.tolerance = fmax(vs_bounds_diagonal(&b) / 65536, 1e-300);
    if (!vs_several_parts(ref, &parts, &count)) return vs_fail_memory(vm);
    bool ok = true;
    for (size_t i = 0; ok && i < count; i++) ok = vs_tessellate(parts[i].node, &facets, &s->mesh, &e);
    vs_several_free(parts, count);
    if (!ok) return vs_bind_error(vm, &e);
  }
  if (vs_flat_net_make(&s->net, &s->mesh, &several)) return true;
  return several ? vs_fail(vm, vm->sym.range, "more than two faces meet along an edge; give each part by itself")
                 : vs_fail_memory(vm);
}

/* Sets the shift of the piece so that it begins at x = `from`, and returns the x of its right side. */
static double beside(sheet *s, uint32_t piece, double from) {
  double low = INFINITY, high = -INFINITY;
  for (uint32_t t = 0; t < s->mesh.triangle_count; t++)
    for (int k = 0; s->net.piece[t] == piece && k < 3; k++)
      low = fmin(low, s->net.at[t][k].x), high = fmax(high, s->net.at[t][k].x);
  s->shift = isnan(from) ? 0 : from - low;
  return high + s->shift;
}

static vs_status list_of(vs_args *f, vs_value *items, size_t n, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  for (size_t i = n; i-- > 0;)
    if (!vs_cons(vm, items[i], r[0], &r[0])) return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

/* (%unroll s): returns a list: the flat region, whether the surface is doubly curved, its curvature, gap and twist
 * (flat_net.h). The region is #f if its pieces overlap in the plane or the surface is doubly curved. */
vs_status vs_p_unroll(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  sheet s;
  vs_flatness flat;
  vs_error e = { 0 };
  VS_ROOTS(vm, r, 5);
  if (!begin(&s, f)) return sheet_free(&s), VS_ERROR;
  bool ok = vs_flat_net_unroll(&s.net, &flat) || vs_fail_memory(vm);
  bool curved = ok && flat.worst > 1e-6;
  double right = NAN;
  vs_area whole = { 0 };
  for (uint32_t p = 0; ok && !curved && p < s.net.pieces; p++) {
    right = beside(&s, p, right) + .05 * s.net.size;
    s.chain_count = 0;
    ok = vs_flat_net_borders(&s.net, p, add_border, end_loop, &s) || vs_fail_memory(vm);
    double sum = 0, covered = 0;
    for (uint32_t t = 0; ok && t < s.mesh.triangle_count; t++) {
      const vs_vec2 *c = s.net.at[t];
      if (s.net.piece[t] == p)
        sum += fabs((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x)) / 2;
    }
    ok = ok && (vs_area_of_chain((const vs_vec2(*)[2])s.chain, s.chain_count, "unroll", &whole, &e) ||
                vs_bind_error(vm, &e));
    for (size_t l = 0, first = 0; ok && l < whole.loop_count; first += whole.size[l++])
      for (size_t i = 0; i < whole.size[l]; i++) {
        vs_vec2 a = whole.at[first + i], b = whole.at[first + (i + 1) % whole.size[l]];
        covered += (a.x * b.y - a.y * b.x) / 2;
      }
    vs_area_free(&whole), whole = (vs_area){ 0 };
    if (ok && fabs(sum - covered) > 1e-6 * sum) /* the sum of the pieces' areas exceeds the area that they cover: they
                                                 * overlap in the plane */
      ok = vs_fail(vm, vm->sym.range,
                   "the surface overlaps itself when it is laid flat; cut it into shorter parts with do-slice");
  }
  r[0] = VS_FALSE;
  if (ok && !curved) ok = vs_bind_give_node(f, vs_node_of_outline(vs_call_store(f), &s.outline, NULL), &r[0]);
  r[1] = curved ? VS_TRUE : VS_FALSE;
  r[2] = vs_flonum(flat.curvature), r[3] = vs_flonum(flat.gap), r[4] = vs_flonum(flat.twist);
  sheet_free(&s);
  return ok ? list_of(f, r, 5, out) : VS_ERROR;
}

/* Sets *out to the list of the piece's folds, each as two points. mountain: returns mountain folds, which are convex as
 * seen from outside, otherwise valley folds. A tab is folded along its edge. The triangles of a flat face have no fold
 * between them. */
static bool folds(sheet *s, uint32_t piece, bool mountain, vs_value *out) {
  vs_args *f = s->f;
  const vs_flat_net *n = &s->net;
  VS_ROOTS(vs_call_vm(f), r, 2);
  r[0] = VS_NIL;
  for (uint32_t e = 0; e < n->edges.edge_count; e++) {
    const vs_mesh_edge *g = &n->edges.edges[e];
    const vs_glue_tab *tab = s->tab ? s->tab[e] : NULL;
    uint32_t t = tab ? tab->triangle : g->side[0], u = g->side[t == g->side[0]];
    if ((!n->joined[e] && !tab) || n->piece[t] != piece || n->face[t] == n->face[u]) continue;
    vs_vec3 a = vs_mesh_edges_place(&n->edges, t, 0), b = vs_mesh_edges_place(&n->edges, t, 1),
            c = vs_mesh_edges_place(&n->edges, t, 2);
    vs_vec3 q = vs_mesh_edges_place(&n->edges, u, vs_flat_net_corner(n, u, e));
    bool convex = vs_v3_dot(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)), vs_v3_sub(q, a)) < 0;
    if (convex != mountain) continue;
    vs_vec2 ends[2];
    vs_flat_net_ends(n, t, e, ends);
    for (int k = 0; k < 2; k++)
      if (!vs_bind_give_point(f, vs_v3(ends[k].x + s->shift, ends[k].y, 0), &r[1]) ||
          !vs_cons(vs_call_vm(f), r[1], r[0], &r[0]))
        return false;
  }
  *out = r[0];
  return true;
}

/* Sets *out to the list of the piece's cut edges, each as number, start and end, in the direction of the border.
 * number[e] is the number that edge e has in the result. */
static bool numbers(sheet *s, uint32_t piece, const uint32_t *number, vs_value *out) {
  vs_args *f = s->f;
  const vs_flat_net *n = &s->net;
  VS_ROOTS(vs_call_vm(f), r, 2);
  r[0] = VS_NIL;
  for (uint32_t e = 0; e < n->edges.edge_count; e++)
    for (int side = 0; number[e] && side < 2; side++) {
      uint32_t t = n->edges.edges[e].side[side];
      if (n->piece[t] != piece) continue;
      vs_vec2 ends[2], w = n->at[t][vs_flat_net_corner(n, t, e)];
      vs_flat_net_ends(n, t, e, ends);
      bool back = (ends[1].x - ends[0].x) * (w.y - ends[0].y) < (ends[1].y - ends[0].y) * (w.x - ends[0].x);
      for (int k = 1; k >= 0; k--)
        if (!vs_bind_give_point(f, vs_v3(ends[k ^ back].x + s->shift, ends[k ^ back].y, 0), &r[1]) ||
            !vs_cons(vs_call_vm(f), r[1], r[0], &r[0]))
          return false;
      if (!vs_cons(vs_call_vm(f), vs_fix((int64_t)number[e]), r[0], &r[0])) return false;
    }
  *out = r[0];
  return true;
}

/* (%unfold solid width): returns a list of the number of faces, the number of cut edges without a tab, and for each
 * piece a list (region mountains valleys edges). width: width of the tabs. */
vs_status vs_p_unfold(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  sheet s;
  vs_glue_tab *tabs = NULL;
  size_t tab_count = 0, missing = 0;
  VS_ROOTS(vm, r, 6);
  r[4] = VS_NIL;
  if (!begin(&s, f)) return sheet_free(&s), VS_ERROR;
  if (s.net.faces > 5000)
    return sheet_free(&s), vs_fail(vm, vm->sym.range,
                                   "the solid has %zu faces, and unfold takes 5000 at most; make it coarser with "
                                   "current-segments", s.net.faces);
  uint32_t *number = vs_zeros(s.net.edges.edge_count + 1, sizeof *number), count = 0;
  bool ok = number != NULL || vs_fail_memory(vm);
  if (ok && !vs_flat_net_unfold(&s.net, (vs_long_work){ vs_bind_keep_going, vm }))
    ok = vs_poll(vm, 1) ? vs_fail_memory(vm) : VS_ERROR;
  if (ok && vs_arg_real(f, 1) > 0) {
    s.tab = vs_zeros(s.net.edges.edge_count + 1, sizeof *s.tab);
    ok = (s.tab && vs_flat_net_tabs(&s.net, vs_arg_real(f, 1), &tabs, &tab_count, &missing)) || vs_fail_memory(vm);
    for (size_t i = 0; ok && i < tab_count; i++) s.tab[tabs[i].edge] = &tabs[i];
  }
  for (size_t e = 0; ok && e < s.net.edges.edge_count; e++)
    if (!s.net.joined[e]) number[e] = ++count;
  double right = NAN;
  for (uint32_t p = 0; ok && p < s.net.pieces; p++) {
    right = beside(&s, p, right) + 2 * vs_arg_real(f, 1) + .05 * s.net.size;
    ok = vs_flat_net_borders(&s.net, p, add_border, end_loop, &s) || vs_fail_memory(vm);
    ok = ok && vs_bind_give_node(f, vs_node_of_outline(vs_call_store(f), &s.outline, NULL), &r[0]) &&
         folds(&s, p, true, &r[1]) && folds(&s, p, false, &r[2]) && numbers(&s, p, number, &r[3]);
    vs_outline_free(&s.outline);
    s.outline = (vs_outline){ 0 }, s.room = 0;
    ok = ok && list_of(f, r, 4, &r[5]) && vs_cons(vm, r[5], r[4], &r[4]) && vs_poll(vm, 64);
  }
  ok = ok && vs_cons(vm, vs_fix((int64_t)missing), r[4], &r[4]) &&
       vs_cons(vm, vs_fix((int64_t)s.net.faces), r[4], out);
  free(number), free(tabs);
  sheet_free(&s);
  return ok ? VS_OK : VS_ERROR;
}
