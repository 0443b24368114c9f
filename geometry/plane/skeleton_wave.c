/* Moves the wave front of a straight skeleton (skeleton_wave.h) from event to event. At an event, vertices of the front
 * meet each other or a segment. However many meet at one time, the front is made anew there. Points within w->least of
 * each other become one place. Segments are cut at the places on them. Pieces of opposite directions between two places
 * cancel: they are a ridge. The ways of vertices end at their places. At each place, a piece that arrives continues
 * with the piece that leaves next to it, clockwise. Thus no case of simultaneous events is special. */
#include "geometry/plane/skeleton_wave.h"

#include <math.h>
#include <string.h>

#include "model/store/array.h"

#define PARALLEL 1e-9L  /* sine of the angle below which two moving lines count as parallel */
#define STILL 1e-14L    /* fraction of the other speeds below which a speed counts as 0 */
#define NONE UINT32_MAX

/* A part of a segment of the front between two places (positions of vertices). line: number of its moving line; from,
 * to: places at its ends; link: the piece that continues it. */
typedef struct { uint32_t segment, line, from, to, link; bool first, gone, merged, taken, stepped; } piece;
typedef struct { long double along; uint32_t place; } cut;

typedef struct vs_wave_work {
  piece *piece;
  size_t piece_count, piece_room;
  cut *cut;
  size_t cut_count, cut_room;
  vs_wave_segment *fresh; /* segments of the front (the moving outline) after the current event */
  size_t fresh_count, fresh_room;
  /* at[i]: position of vertex i of the front; coinciding vertices form a place, which has the index of its first
   * vertex */
  vs_wave_point *at;
  uint32_t *place, *node, *first;
  bool *touched;
  size_t rooms[5], start_room;
  uint32_t *start; /* start[p]: segment of the next front that begins with piece p of the present front */
} work;

void vs_wave_free(vs_wave *w) {
  work *k = w->work;
  if (k) {
    free(k->piece), free(k->cut), free(k->fresh), free(k->at), free(k->place), free(k->node), free(k->first);
    free(k->touched), free(k->start), free(k);
  }
  free(w->line), free(w->segment), free(w->node), free(w->half);
  *w = (vs_wave){ 0 };
}

long double vs_wave_turn(vs_wave_point in, vs_wave_point out) {
  vs_wave_point back = { -in.x, -in.y };
  long double angle = atan2l(vs_wave_cross(out, back), vs_wave_dot(out, back));
  return angle > PARALLEL ? angle : angle + 2 * acosl(-1);
}

bool vs_wave_half_add(vs_wave *w, uint32_t line, uint32_t from, uint32_t to) {
  if (from == to) return true;
  if (!VS_GROW(w->half, w->half_room, w->half_count + 1)) return false;
  w->half[w->half_count++] = (vs_wave_half){ line, from, to };
  return true;
}

static vs_wave_point position(const vs_wave_segment *s, long double time) {
  return (vs_wave_point){ s->at.x + s->way.x * time, s->at.y + s->way.y * time };
}

static bool parallel(const vs_wave_line *a, const vs_wave_line *b) {
  return fabsl(vs_wave_cross(a->normal, b->normal)) < PARALLEL;
}

/* Sets the straight way (position at any time) of the vertex between the moving lines `in` and `out`. The vertex is at
 * p now. */
static void set_way(const vs_wave *w, uint32_t in, uint32_t out, vs_wave_point p, vs_wave_segment *s) {
  const vs_wave_line *a = &w->line[in], *b = &w->line[out];
  long double d = vs_wave_cross(a->normal, b->normal);
  if (parallel(a, b)) {
    s->way = (vs_wave_point){ b->normal.x * b->speed, b->normal.y * b->speed };
    s->at = (vs_wave_point){ p.x - s->way.x * w->time, p.y - s->way.y * w->time };
    return;
  }
  s->at.x = (a->offset * b->normal.y - b->offset * a->normal.y) / d;
  s->at.y = (a->normal.x * b->offset - b->normal.x * a->offset) / d;
  s->way.x = (a->speed * b->normal.y - b->speed * a->normal.y) / d;
  s->way.y = (a->normal.x * b->speed - b->normal.x * a->speed) / d;
}

/* ---- the time of the next event ---- */

/* Returns the time until segment s has shrunk to a point; infinity if it does not shrink. */
static long double until_short(const vs_wave *w, const vs_wave_segment *s) {
  const vs_wave_segment *n = &w->segment[s->next];
  vs_wave_point d = w->line[s->line].along;
  long double rate = vs_wave_dot(d, vs_wave_sub(n->way, s->way));
  if (rate > -STILL) return INFINITY;
  return fmaxl(0, vs_wave_dot(d, vs_wave_sub(position(n, w->time), position(s, w->time))) / -rate);
}

/* Returns the time until the vertex at the start of segment v reaches segment s, or infinity. If the time is above
 * `best`, it may be inexact. */
static long double until_met(const vs_wave *w, const vs_wave_segment *v, const vs_wave_segment *s, long double best) {
  const vs_wave_line *l = &w->line[s->line];
  long double rate = vs_wave_dot(l->normal, v->way) - l->speed;
  if (rate > -STILL) return INFINITY;
  long double far = vs_wave_dot(l->normal, position(v, w->time)) - l->offset - l->speed * w->time;
  if (far <= w->least || far >= best * -rate) return INFINITY;
  long double then = w->time + far / -rate;
  vs_wave_point p = position(v, then);
  if (vs_wave_dot(l->along, vs_wave_sub(p, position(s, then))) < -w->least ||
      vs_wave_dot(l->along, vs_wave_sub(p, position(&w->segment[s->next], then))) > w->least)
    return INFINITY;
  return far / -rate;
}

static long double until_event(const vs_wave *w) {
  long double best = INFINITY;
  for (size_t i = 0; i < w->count; i++) best = fminl(best, until_short(w, &w->segment[i]));
  for (uint32_t i = 0; i < w->count; i++) {
    const vs_wave_segment *v = &w->segment[i];
    /* only vertices at reflex and straight corners can reach segments */
    if (vs_wave_cross(w->line[w->segment[v->last].line].along, w->line[v->line].along) > PARALLEL) continue;
    for (uint32_t j = 0; j < w->count; j++)
      if (j != i && j != v->last) best = fminl(best, until_met(w, v, &w->segment[j], best));
  }
  return best;
}

/* ---- the front (the moving outline) is made anew after an event ---- */

/* Returns the skeleton's node at a place (point where parts of the front meet). Makes it when it is first needed.
 * Returns NONE when memory is out. */
static uint32_t node_of(vs_wave *w, uint32_t place) {
  work *k = w->work;
  if (k->node[place] != NONE) return k->node[place];
  if (w->node_count >= NONE || !VS_GROW(w->node, w->node_room, w->node_count + 1)) return NONE;
  w->node[w->node_count] = (vs_wave_node){ k->at[place], w->time };
  return k->node[place] = (uint32_t)w->node_count++;
}

static bool rooms(work *k, size_t n) {
  return VS_GROW(k->at, k->rooms[0], n) && VS_GROW(k->place, k->rooms[1], n) && VS_GROW(k->node, k->rooms[2], n) &&
         VS_GROW(k->first, k->rooms[3], n) && VS_GROW(k->touched, k->rooms[4], n);
}

/* Finds the places (coinciding positions) of all vertices of the front. A place is marked as touched if several
 * vertices are there. */
static bool find_places(vs_wave *w) {
  work *k = w->work;
  if (!rooms(k, w->count)) return false;
  for (uint32_t i = 0; i < w->count; i++) {
    vs_wave_point p = k->at[i] = position(&w->segment[i], w->time);
    k->place[i] = i, k->node[i] = NONE, k->touched[i] = false;
    for (uint32_t j = 0; j < i; j++) {
      if (fabsl(k->at[j].x - p.x) > w->least || fabsl(k->at[j].y - p.y) > w->least) continue;
      k->place[i] = k->place[j], k->touched[k->place[j]] = true;
      break;
    }
  }
  return true;
}

static int compare_cuts(const void *p, const void *q) {
  const cut *a = p, *b = q;
  return a->along < b->along ? -1 : a->along > b->along;
}

static bool add_piece(work *k, piece p) {
  if (p.from == p.to) return true;
  if (!VS_GROW(k->piece, k->piece_room, k->piece_count + 1)) return false;
  k->piece[k->piece_count++] = p;
  return true;
}

/* Cuts segment i of the front into pieces at the places that lie on it. */
static bool cut_segment(vs_wave *w, uint32_t i) {
  work *k = w->work;
  const vs_wave_segment *s = &w->segment[i];
  const vs_wave_line *l = &w->line[s->line];
  uint32_t from = k->place[i], to = k->place[s->next];
  long double length = vs_wave_dot(l->along, vs_wave_sub(k->at[to], k->at[from]));
  k->cut_count = 0;
  for (uint32_t j = 0; j < w->count && from != to; j++) {
    if (k->place[j] != j || j == from || j == to) continue;
    vs_wave_point v = vs_wave_sub(k->at[j], k->at[from]);
    long double along = vs_wave_dot(l->along, v);
    if (fabsl(vs_wave_dot(l->normal, v)) > w->least || along <= 0 || along >= length) continue;
    if (!VS_GROW(k->cut, k->cut_room, k->cut_count + 1)) return false;
    k->cut[k->cut_count++] = (cut){ along, j };
    k->touched[j] = true;
  }
  if (k->cut_count > 1) qsort(k->cut, k->cut_count, sizeof *k->cut, compare_cuts);
  piece p = { .segment = i, .line = s->line, .from = from, .link = NONE, .first = true };
  for (size_t c = 0; c < k->cut_count; c++) {
    p.to = k->cut[c].place;
    if (!add_piece(k, p)) return false;
    p.from = p.to, p.first = false;
  }
  p.to = to;
  return add_piece(k, p);
}

/* Removes pairs of pieces that lie between the same two places with opposite directions, and records each pair as a
 * ridge between two faces. */
static bool cancel(vs_wave *w) {
  work *k = w->work;
  for (size_t i = 0; i < k->piece_count; i++) {
    piece *a = &k->piece[i];
    if (!k->touched[a->from] || !k->touched[a->to]) continue;
    for (size_t j = i + 1; j < k->piece_count && !a->gone; j++) {
      piece *b = &k->piece[j];
      if (b->gone || b->from != a->to || b->to != a->from) continue;
      uint32_t from = node_of(w, a->from), to = node_of(w, a->to);
      if (from == NONE || to == NONE || !vs_wave_half_add(w, a->line, to, from) ||
          !vs_wave_half_add(w, b->line, from, to))
        return false;
      a->gone = b->gone = true;
    }
  }
  return true;
}

/* Ends the straight paths of the vertices at touched places (positions with several vertices), and records these paths
 * as edges of faces. */
static bool end_ways(vs_wave *w) {
  work *k = w->work;
  for (uint32_t i = 0; i < w->count; i++) {
    const vs_wave_segment *s = &w->segment[i];
    if (!k->touched[k->place[i]]) continue;
    uint32_t node = node_of(w, k->place[i]);
    if (node == NONE || !vs_wave_half_add(w, w->segment[s->last].line, s->born, node) ||
        !vs_wave_half_add(w, s->line, node, s->born))
      return false;
  }
  return true;
}

/* Links each piece of the front to the piece that continues it. Returns false if the pieces do not form loops. */
static bool link_pieces(vs_wave *w) {
  work *k = w->work;
  for (size_t i = 0; i < k->piece_count; i++)
    if (k->piece[i].first && !k->piece[i].gone) k->first[k->piece[i].segment] = (uint32_t)i;
  for (size_t i = 0; i < k->piece_count; i++) {
    piece *in = &k->piece[i];
    if (in->gone) continue;
    long double least = INFINITY;
    if (!k->touched[in->to]) in->link = k->first[w->segment[in->segment].next];
    else
      for (size_t j = 0; j < k->piece_count; j++) {
        if (k->piece[j].gone || k->piece[j].from != in->to) continue;
        long double turn = vs_wave_turn(w->line[in->line].along, w->line[k->piece[j].line].along);
        if (turn < least) least = turn, in->link = (uint32_t)j;
      }
    if (in->link == NONE || k->piece[in->link].taken) return false;
    k->piece[in->link].taken = true;
    k->piece[in->link].merged = k->piece[in->link].line == in->line;
  }
  return true;
}

static bool add_segment(work *k, vs_wave_segment s, uint32_t *index) {
  if (k->fresh_count >= NONE || !VS_GROW(k->fresh, k->fresh_room, k->fresh_count + 1)) return false;
  *index = (uint32_t)k->fresh_count;
  k->fresh[k->fresh_count++] = s;
  return true;
}

/* Adds a line across two parallel lines, whose edges have different speeds: the vertical step between their faces.
 * *line: receives the number of the new line. */
static bool add_step(vs_wave *w, uint32_t in, uint32_t out, vs_wave_point at, uint32_t *line) {
  if (w->line_count >= NONE || !VS_GROW(w->line, w->line_room, w->line_count + 1)) return false;
  vs_wave_point n = w->line[in].normal;
  vs_wave_point d = w->line[in].speed > w->line[out].speed ? (vs_wave_point){ -n.x, -n.y } : n;
  vs_wave_line step = { .along = d, .normal = { -d.y, d.x } };
  step.offset = vs_wave_dot(step.normal, at);
  *line = (uint32_t)w->line_count;
  w->line[w->line_count++] = step;
  return true;
}

static bool needs_step(const vs_wave_line *a, const vs_wave_line *b) {
  return parallel(a, b) && vs_wave_dot(a->along, b->along) > 0 &&
         fabsl(a->speed - b->speed) > PARALLEL * fmaxl(a->speed, b->speed);
}

/* Makes the segments of the next front that begin at the vertex between the piece `in` and the piece with the index
 * out_index. */
static bool add_vertex(vs_wave *w, const piece *in, uint32_t out_index) {
  work *k = w->work;
  const piece *out = &k->piece[out_index];
  vs_wave_segment s = w->segment[out->segment];
  if (k->touched[out->from] || !out->first) {
    uint32_t step, made, node = node_of(w, out->from);
    if (node == NONE) return false;
    s = (vs_wave_segment){ .line = out->line, .born = node };
    if (needs_step(&w->line[in->line], &w->line[out->line])) {
      if (!add_step(w, in->line, out->line, k->at[out->from], &step)) return false;
      vs_wave_segment across = { .line = step, .born = node };
      set_way(w, in->line, step, k->at[out->from], &across);
      set_way(w, step, out->line, k->at[out->from], &s);
      if (!add_segment(k, across, &made)) return false;
      k->fresh[made].next = made + 1; /* the vertical step between two faces is followed by the segment that is added to
                                       * the array directly after it */
      k->piece[out_index].stepped = true;
    } else set_way(w, in->line, out->line, k->at[out->from], &s);
  }
  return add_segment(k, s, &k->start[out_index]);
}

/* Makes the front after an event from the linked pieces of the old front. Returns false when memory is out. */
static bool make_front(vs_wave *w) {
  work *k = w->work;
  k->fresh_count = 0;
  if (!VS_GROW(k->start, k->start_room, k->piece_count)) return false;
  for (size_t i = 0; i < k->piece_count; i++)
    if (!k->piece[i].gone && !k->piece[k->piece[i].link].merged && !add_vertex(w, &k->piece[i], k->piece[i].link))
      return false;
  for (size_t i = 0; i < k->piece_count; i++) {
    if (k->piece[i].gone || k->piece[i].merged) continue;
    uint32_t end = (uint32_t)i;
    for (size_t turns = 0; k->piece[k->piece[end].link].merged && turns < k->piece_count; turns++)
      end = k->piece[end].link;
    end = k->piece[end].link;
    k->fresh[k->start[i]].next = k->start[end] - (k->piece[end].stepped ? 1 : 0); /* if a vertical step precedes the
                                                                                   * segment of the next piece, the step
                                                                                   * is the next segment */
  }
  for (uint32_t i = 0; i < k->fresh_count; i++) k->fresh[k->fresh[i].next].last = i;
  vs_wave_segment *segment = w->segment;
  size_t room = w->room;
  w->segment = k->fresh, w->count = k->fresh_count, w->room = k->fresh_room;
  k->fresh = segment, k->fresh_room = room;
  return true;
}

/* Makes the front (the moving outline) anew at the present time, after an event. */
static vs_skeleton_outcome renew(vs_wave *w) {
  work *k = w->work;
  k->piece_count = 0;
  bool ok = find_places(w);
  for (uint32_t i = 0; ok && i < w->count; i++) ok = cut_segment(w, i);
  if (!ok || !cancel(w) || !end_ways(w)) return VS_SKELETON_MEMORY;
  if (!link_pieces(w)) return VS_SKELETON_FAILED;
  return make_front(w) ? VS_SKELETON_DONE : VS_SKELETON_MEMORY;
}

/* Makes the first front (moving outline): each edge of the outline becomes a segment, and each corner a node at a place
 * where pieces meet. */
static bool begin(vs_wave *w, const uint32_t *next) {
  size_t n = w->line_count;
  work *k = w->work = vs_zeros(1, sizeof *k);
  if (!k || !VS_GROW(w->segment, w->room, n) || !rooms(k, n)) return false;
  w->count = n;
  for (uint32_t i = 0; i < n; i++) {
    w->segment[i] = (vs_wave_segment){ .line = i, .next = next[i], .born = i };
    k->at[i] = w->node[i].at, k->place[i] = k->node[i] = i, k->touched[i] = true;
    if (!vs_wave_half_add(w, i, i, next[i]) ||
        !add_piece(k, (piece){ .segment = i, .line = i, .from = i, .to = next[i], .link = next[i], .first = true }))
      return false;
  }
  return make_front(w);
}

vs_skeleton_outcome vs_wave_run(vs_wave *w, const uint32_t *next, vs_long_work going) {
  size_t most = 40 * w->line_count + 100; /* most: limit on the number of events, so that the loop ends; each event
                                           * removes or adds an edge of the front */
  if (!begin(w, next)) return VS_SKELETON_MEMORY;
  for (size_t events = 0; w->count; events++) {
    long double wait = until_event(w);
    if (!(wait < INFINITY)) return VS_SKELETON_OPEN;
    if (events > most) return VS_SKELETON_FAILED;
    if (!going.going(going.context, fmax(0, 1 - (double)w->count / (double)w->line_count)))
      return VS_SKELETON_STOPPED;
    w->time += wait;
    vs_skeleton_outcome outcome = renew(w);
    if (outcome != VS_SKELETON_DONE) return outcome;
  }
  return VS_SKELETON_DONE;
}
