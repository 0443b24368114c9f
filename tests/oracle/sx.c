/* Implements the .sx reader: (box x y z) (cbox x y z) (cyl h r1 r2 n) (sphere r n) (torus R r n m) (startwist ro ri p h
 * tw s), (translate ...) (rotate ...) (scale ...) (multmatrix ...), (union ...) (difference ...) (intersection ...),
 * (def name form ...) (use name). */
#include "tests/oracle/sx.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct { char name[32]; const char *body, *end; } definition;
typedef struct { char op[32]; double args[12]; int arg_count; vs_affine saved; uint32_t kids[1]; uint32_t *at; size_t count, room; } frame;
typedef struct {
  sx_problem *out;
  definition defs[64];
  int def_count;
  struct { char key[160]; vs_mesh *mesh; } *cache;
  size_t cache_count, cache_room;
} reader;

static void *more(void *at, size_t *room, size_t need, size_t size) {
  if (need <= *room) return at;
  *room = need * 2 + 16;
  at = realloc(at, *room * size);
  if (!at) abort();
  return at;
}

static uint32_t add_term(sx_problem *p, vs_term_kind kind, const uint32_t *kids, size_t count) {
  p->terms = more(p->terms, &p->term_room, p->problem.term_count + 1u, sizeof *p->terms);
  p->operands = more(p->operands, &p->operand_room, p->problem.operand_count + count, sizeof *p->operands);
  if (count) memcpy(p->operands + p->problem.operand_count, kids, count * sizeof *kids);
  p->terms[p->problem.term_count] = (vs_kernel_term){ kind, p->problem.operand_count, (uint32_t)count };
  p->problem.operand_count += (uint32_t)count;
  return p->problem.term_count++;
}

static uint32_t vertex(vs_mesh *m, double x, double y, double z) {
  uint32_t i;
  if (!vs_mesh_add_vertex(m, vs_v3(x, y, z), &i)) abort();
  return i;
}
static void face(vs_mesh *m, uint32_t a, uint32_t b, uint32_t c) { if (!vs_mesh_add_triangle(m, a, b, c)) abort(); }
static void quad(vs_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d) { face(m, a, b, c), face(m, a, c, d); }

static void make(vs_mesh *m, const char *op, const double *a) {
  double sn, cs, pi = acos(-1);
  if (!strcmp(op, "box") || !strcmp(op, "cbox")) {
    double o = op[0] == 'c' ? -0.5 : 0;
    for (int i = 0; i < 8; i++) vertex(m, a[0] * (o + (i & 1)), a[1] * (o + (i >> 1 & 1)), a[2] * (o + (i >> 2)));
    quad(m, 0, 2, 3, 1), quad(m, 4, 5, 7, 6), quad(m, 0, 1, 5, 4), quad(m, 2, 6, 7, 3), quad(m, 0, 4, 6, 2), quad(m, 1, 3, 7, 5);
  } else if (!strcmp(op, "cyl")) {
    uint32_t n = (uint32_t)a[3];
    for (uint32_t i = 0; i < n; i++) vs_sincos(2 * pi * i / n, &sn, &cs), vertex(m, a[1] * cs, a[1] * sn, 0), vertex(m, a[2] * cs, a[2] * sn, a[0]);
    for (uint32_t i = 0; i < n; i++) quad(m, 2 * i, 2 * ((i + 1) % n), 2 * ((i + 1) % n) + 1, 2 * i + 1);
    for (uint32_t i = 1; i + 1 < n; i++) face(m, 0, 2 * i + 2, 2 * i), face(m, 1, 2 * i + 1, 2 * i + 3);
  } else if (!strcmp(op, "sphere")) {
    uint32_t n = (uint32_t)a[1], b = n / 2;
    vertex(m, 0, 0, -a[0]);
    for (uint32_t j = 1; j < b; j++)
      for (uint32_t i = 0; i < n; i++) {
        double s2, c2;
        vs_sincos(pi * j / b, &s2, &c2), vs_sincos(2 * pi * i / n, &sn, &cs);
        vertex(m, a[0] * s2 * cs, a[0] * s2 * sn, -a[0] * c2);
      }
    uint32_t top = vertex(m, 0, 0, a[0]);
    for (uint32_t i = 0; i < n; i++) {
      uint32_t k = (i + 1) % n;
      face(m, 0, 1 + k, 1 + i);
      for (uint32_t j = 0; j + 2 < b; j++) quad(m, 1 + j * n + i, 1 + j * n + k, 1 + (j + 1) * n + k, 1 + (j + 1) * n + i);
      face(m, top, 1 + (b - 2) * n + i, 1 + (b - 2) * n + k);
    }
  } else if (!strcmp(op, "torus")) {
    uint32_t n = (uint32_t)a[2], q = (uint32_t)a[3];
    for (uint32_t i = 0; i < n; i++)
      for (uint32_t j = 0; j < q; j++) {
        double s2, c2;
        vs_sincos(2 * pi * i / n, &sn, &cs), vs_sincos(2 * pi * j / q, &s2, &c2);
        vertex(m, (a[0] + a[1] * c2) * cs, (a[0] + a[1] * c2) * sn, a[1] * s2);
      }
    for (uint32_t i = 0; i < n; i++)
      for (uint32_t j = 0; j < q; j++) quad(m, i * q + j, (i + 1) % n * q + j, (i + 1) % n * q + (j + 1) % q, i * q + (j + 1) % q);
  } else { /* the form startwist */
    uint32_t p = (uint32_t)a[2], k = 2 * p, s = (uint32_t)a[5];
    for (uint32_t l = 0; l <= s; l++)
      for (uint32_t i = 0; i < k; i++) {
        double r = i % 2 ? a[1] : a[0];
        vs_sincos(pi * i / p + a[4] * pi / 180 * l / s, &sn, &cs);
        vertex(m, r * cs, r * sn, a[3] * l / s);
      }
    uint32_t bottom = vertex(m, 0, 0, 0), top = vertex(m, 0, 0, a[3]);
    for (uint32_t i = 0; i < k; i++) {
      for (uint32_t l = 0; l < s; l++) quad(m, l * k + i, l * k + (i + 1) % k, (l + 1) * k + (i + 1) % k, (l + 1) * k + i);
      face(m, bottom, (i + 1) % k, i), face(m, top, s * k + i, s * k + (i + 1) % k);
    }
  }
}

static bool is_leaf(const char *op) {
  static const char *const names[] = { "box", "cbox", "cyl", "sphere", "torus", "startwist" };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (!strcmp(op, names[i])) return true;
  return false;
}

static uint32_t leaf(reader *r, const frame *f, const vs_affine *at) {
  char key[160];
  int n = snprintf(key, sizeof key, "%s", f->op);
  for (int i = 0; i < f->arg_count; i++) n += snprintf(key + n, sizeof key - (size_t)n, " %.9g", f->args[i]);
  vs_mesh *mesh = NULL;
  for (size_t i = r->cache_count; i-- > 0 && !mesh;)
    if (!strcmp(r->cache[i].key, key)) mesh = r->cache[i].mesh;
  sx_problem *p = r->out;
  if (!mesh) {
    mesh = calloc(1, sizeof *mesh);
    if (!mesh) abort();
    make(mesh, f->op, f->args);
    r->cache = more(r->cache, &r->cache_room, r->cache_count + 1, sizeof *r->cache);
    strcpy(r->cache[r->cache_count].key, key);
    r->cache[r->cache_count++].mesh = mesh;
    p->meshes = more(p->meshes, &p->mesh_room, p->mesh_count + 1, sizeof *p->meshes);
    p->meshes[p->mesh_count++] = mesh;
  }
  p->leaves = more(p->leaves, &p->leaf_room, p->problem.leaf_count + 1u, sizeof *p->leaves);
  p->leaves[p->problem.leaf_count] = (vs_kernel_leaf){ mesh, *at, 0, false };
  uint32_t term = add_term(p, VS_TERM_LEAF, NULL, 0);
  p->terms[term].first = p->problem.leaf_count++;
  return term;
}

static void apply(const frame *f, vs_affine *at) {
  const double *a = f->args, deg = acos(-1) / 180;
  vs_vec3 o = vs_v3(0, 0, 0);
  if (!strcmp(f->op, "translate")) {
    vs_affine t = vs_affine_translation(vs_v3(a[0], a[1], a[2]));
    *at = vs_affine_multiply(at, &t);
  } else if (!strcmp(f->op, "scale")) {
    vs_affine t = vs_affine_scaling(o, vs_v3(a[0], a[1], a[2]));
    *at = vs_affine_multiply(at, &t);
  } else if (!strcmp(f->op, "rotate")) {
    vs_affine x = vs_affine_rotation(o, vs_v3(1, 0, 0), a[0] * deg), y = vs_affine_rotation(o, vs_v3(0, 1, 0), a[1] * deg),
              z = vs_affine_rotation(o, vs_v3(0, 0, 1), a[2] * deg);
    y = vs_affine_multiply(&y, &x);
    z = vs_affine_multiply(&z, &y);
    *at = vs_affine_multiply(at, &z);
  } else if (!strcmp(f->op, "multmatrix")) {
    vs_affine t;
    for (int i = 0; i < 12; i++) t.m[i / 4][i % 4] = a[i];
    *at = vs_affine_multiply(at, &t);
  }
}

/* Parses the text in a single pass with a stack of open forms. A form (use name) pushes the current position, to which
 * the parser returns after reading the definition. */
static bool parse(reader *r, const char *text, uint32_t *root) {
  frame *stack = NULL;
  size_t room = 0, depth = 0;
  vs_affine at = vs_affine_identity();
  struct { const char *back; } uses[64];
  int use_depth = 0;
  const char *end_of_use[64];
  bool ok = true;
  stack = more(stack, &room, 1, sizeof *stack);
  memset(&stack[0], 0, sizeof stack[0]);
  depth = 1;
  for (const char *s = text; ok;) {
    if (use_depth && s == end_of_use[use_depth - 1]) { s = uses[--use_depth].back; continue; }
    while (isspace((unsigned char)*s)) s++;
    if (use_depth && s == end_of_use[use_depth - 1]) continue;
    if (*s == ';') { while (*s && *s != '\n') s++; continue; }
    if (!*s) break;
    frame *top = &stack[depth - 1];
    if (*s == '(') {
      s++;
      char op[32];
      int n = 0;
      while (*s && !isspace((unsigned char)*s) && *s != ')' && n < 31) op[n++] = *s++;
      op[n] = 0;
      if (!strcmp(op, "def")) {
        definition *d = &r->defs[r->def_count++];
        while (isspace((unsigned char)*s)) s++;
        for (n = 0; *s && !isspace((unsigned char)*s);) d->name[n++] = *s++;
        d->name[n] = 0;
        d->body = s;
        for (int level = 1; *s; s++) {
          if (*s == '(') level++;
          if (*s == ')' && --level == 0) break;
        }
        d->end = s++;
        continue;
      }
      if (!strcmp(op, "use")) {
        char name[32];
        while (isspace((unsigned char)*s)) s++;
        for (n = 0; *s && *s != ')' && !isspace((unsigned char)*s);) name[n++] = *s++;
        name[n] = 0;
        while (*s != ')') s++;
        definition *d = NULL;
        for (int i = 0; i < r->def_count; i++)
          if (!strcmp(r->defs[i].name, name)) d = &r->defs[i];
        if (!d || use_depth == 64) { fprintf(stderr, "sx: no %s\n", name); ok = false; break; }
        uses[use_depth].back = s + 1;
        end_of_use[use_depth++] = d->end;
        s = d->body;
        continue;
      }
      stack = more(stack, &room, depth + 1, sizeof *stack);
      frame *f = &stack[depth++];
      memset(f, 0, sizeof *f);
      strcpy(f->op, op);
      f->saved = at;
      continue;
    }
    if (*s == ')') {
      s++;
      frame *f = top, *up = &stack[depth - 2];
      uint32_t term;
      if (is_leaf(f->op)) term = leaf(r, f, &at);
      else if (!strcmp(f->op, "difference")) term = add_term(r->out, VS_TERM_DIFFERENCE, f->at, f->count);
      else if (!strcmp(f->op, "intersection")) term = add_term(r->out, VS_TERM_INTERSECTION, f->at, f->count);
      else term = add_term(r->out, VS_TERM_UNION, f->at, f->count);
      at = f->saved;
      free(f->at);
      depth--;
      up->at = more(up->at, &up->room, up->count + 1, sizeof *up->at);
      up->at[up->count++] = term;
      continue;
    }
    char *after;
    double x = strtod(s, &after);
    if (after == s || top->arg_count == 12) { fprintf(stderr, "sx: cannot read %.20s\n", s); ok = false; break; }
    s = after;
    top->args[top->arg_count++] = x;
    int want = !strcmp(top->op, "multmatrix") ? 12 : 3;
    if (!is_leaf(top->op) && top->arg_count == want) apply(top, &at);
  }
  if (ok && (depth != 1 || stack[0].count == 0)) ok = false, fprintf(stderr, "sx: unfinished\n");
  if (ok) *root = add_term(r->out, VS_TERM_UNION, stack[0].at, stack[0].count);
  for (size_t i = 0; i < depth; i++) free(stack[i].at);
  free(stack);
  return ok;
}

bool sx_parse(const char *text, sx_problem *out) {
  reader r = { .out = out };
  uint32_t root;
  memset(out, 0, sizeof *out);
  bool ok = parse(&r, text, &root);
  free(r.cache);
  out->problem.leaves = out->leaves;
  out->problem.terms = out->terms;
  out->problem.operands = out->operands;
  return ok;
}

void sx_free(sx_problem *p) {
  for (size_t i = 0; i < p->mesh_count; i++) vs_mesh_free(p->meshes[i]), free(p->meshes[i]);
  free(p->meshes);
  free(p->leaves);
  free(p->terms);
  free(p->operands);
  memset(p, 0, sizeof *p);
}

bool sx_write_stl(const vs_mesh *m, const char *path) {
  FILE *f = fopen(path, "wb");
  if (!f) return false;
  char head[80] = "visualscheme";
  uint32_t n = (uint32_t)m->triangle_count;
  fwrite(head, 1, 80, f);
  fwrite(&n, 4, 1, f);
  for (size_t i = 0; i < m->triangle_count; i++) {
    float x[12] = { 0 };
    uint16_t none = 0;
    for (int j = 0; j < 3; j++) {
      vs_vec3 v = m->vertices[m->triangles[i][j]];
      x[3 + 3 * j] = (float)v.x, x[4 + 3 * j] = (float)v.y, x[5 + 3 * j] = (float)v.z;
    }
    fwrite(x, 4, 12, f);
    fwrite(&none, 2, 1, f);
  }
  return fclose(f) == 0;
}
