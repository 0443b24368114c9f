/* Implements the expansion of syntax-rules over nodes. Every part of the result has its place in the text.
 *
 * A form that a macro use passes to the macro is copied one node deep. The copy has the original as its origin, and
 * shares all nodes below it. The forms of a template are new. The template's names become aliases that belong to this
 * expansion. Each alias has the meaning of the name at the macro's definition, unless the expansion binds it. Patterns
 * and templates deeper than MOST_DEPTH are not expanded. */
#include "languages/analysis/macro_rules.h"

#include <string.h>

enum { MOST_DEPTH = 200 };

/* The value of a pattern variable: a node, or the nodes that its ellipsis collected. */
typedef struct match {
  know_index name, node;
  struct match *parts;   /* the matches that an ellipsis collected, in order; each has its own list of variables in
                          * `bound` */
  struct match *bound, *next;
  bool repeated;
} match;

typedef struct {
  know_walk *w;
  knowledge *k;
  know_index scope, defined; /* scope: scope of the macro use. defined: scope of the macro's definition */
  know_index literals, ellipsis;
  know_index use;
  know_index serial;         /* number of a scope, unique for this expansion, that distinguishes its aliases from those
                              * of other expansions */
  match *bound;
  int depth;
} expansion;

static match *bind(expansion *x, match **list, know_index name, know_index node) {
  match *m = know_alloc(x->k, sizeof *m);
  if (m) *m = (match){.name = name, .node = node, .next = *list}, *list = m;
  return m;
}

static bool is_ellipsis(const expansion *x, know_index node) {
  if (!node || x->k->nodes[node].kind != KNOW_SYMBOL) return false;
  if (x->ellipsis) return x->k->nodes[node].name == x->k->nodes[x->ellipsis].name;
  return know_is(x->k, node, "...");
}

static bool is_literal(const expansion *x, know_index node) {
  for (know_index i = x->literals ? x->k->nodes[x->literals].first : 0; i; i = x->k->nodes[i].next)
    if (x->k->nodes[i].name == x->k->nodes[node].name) return true;
  return false;
}

/* Returns a list node for `first` and the elements after it, without copying them. */
static know_index tail(expansion *x, know_index list, know_index first, uint32_t count) {
  if (count == 1 && x->k->nodes[list].dotted && !x->k->nodes[first].next) return first;
  know_index t = know_node_new(x->k, KNOW_LIST);
  if (!t) return 0;
  know_node *n = &x->k->nodes[t];
  n->at = x->k->nodes[list].at, n->open = '(', n->first = first, n->count = count, n->made = true, n->parent = list;
  n->dotted = x->k->nodes[list].dotted && count;
  return t;
}

static bool same_datum(const knowledge *k, know_index a, know_index b) {
  size_t n, m;
  const char *s = know_spelling(k, a, &n), *t = know_spelling(k, b, &m);
  return k->nodes[a].kind == k->nodes[b].kind && n == m && !memcmp(s, t, n);
}

static void collect_names(expansion *x, know_index pattern, match **out) {
  know_node *p = &x->k->nodes[pattern];
  if (p->kind == KNOW_SYMBOL) {
    if (!is_ellipsis(x, pattern) && !is_literal(x, pattern) && !know_is(x->k, pattern, "_")) bind(x, out, p->name, 0);
    return;
  }
  if (++x->depth < MOST_DEPTH)
    for (know_index i = x->k->nodes[pattern].first; i; i = x->k->nodes[i].next) collect_names(x, i, out);
  x->depth--;
}

static bool fits(expansion *x, know_index pattern, know_index node, match **out);

/* Matches the elements of `list` with the patterns in `pattern`. skip: ignores the first element of each, which is the
 * macro's name. */
static bool fits_list(expansion *x, know_index pattern, know_index list, bool skip, match **out) {
  knowledge *k = x->k;
  know_index p = k->nodes[pattern].first, i = k->nodes[list].first;
  uint32_t left = k->nodes[list].count;
  if (skip) p = k->nodes[p].next, i = k->nodes[i].next, left--;
  bool dotted = k->nodes[list].dotted, dotted_pattern = k->nodes[pattern].dotted;
  for (; p; p = k->nodes[p].next) {
    know_index behind = k->nodes[p].next;
    bool last = dotted_pattern && !behind;
    if (last) {
      know_index rest = tail(x, list, i, left);
      return rest && fits(x, p, rest, out);
    }
    if (is_ellipsis(x, behind)) {
      uint32_t after = 0;
      for (know_index q = k->nodes[behind].next; q; q = k->nodes[q].next) after++;
      if (dotted_pattern) after--;
      if (dotted && !dotted_pattern) return false;
      uint32_t have = left - (dotted ? 1 : 0);
      if (have < after) return false;
      match *names = NULL, *first = NULL, **end = &first;
      collect_names(x, p, &names);
      for (uint32_t n = have - after; n; n--, left--, i = k->nodes[i].next) {
        match *one = know_alloc(k, sizeof *one);
        if (!one || !fits(x, p, i, &one->bound)) return false;
        *end = one, end = &one->next;
      }
      for (match *v = names; v; v = v->next) {
        match *m = bind(x, out, v->name, 0);
        if (!m) return false;
        m->repeated = true, m->parts = first;
      }
      p = behind;
      continue;
    }
    if (!i || (dotted && !k->nodes[i].next)) return false;
    if (!fits(x, p, i, out)) return false;
    i = k->nodes[i].next, left--;
  }
  return !left;
}

static bool fits_here(expansion *x, know_index pattern, know_index node, match **out) {
  knowledge *k = x->k;
  const know_node *p = &k->nodes[pattern], *n = &k->nodes[node];
  switch (p->kind) {
  case KNOW_SYMBOL:
    if (know_is(k, pattern, "_")) return true;
    if (!is_literal(x, pattern)) return bind(x, out, p->name, node) != NULL;
    if (n->kind != KNOW_SYMBOL) return false;
    know_index a = know_find(x->w, n->name, x->scope), b = know_find(x->w, k->nodes[pattern].name, x->defined);
    return a == b && (a || !strcmp(k->names[k->nodes[node].name].text, k->names[k->nodes[pattern].name].text));
  case KNOW_KEYWORD: return n->kind == KNOW_KEYWORD && n->name == p->name;
  case KNOW_LIST: case KNOW_VECTOR: return n->kind == p->kind && fits_list(x, pattern, node, false, out);
  default: return same_datum(k, pattern, node);
  }
}

static bool fits(expansion *x, know_index pattern, know_index node, match **out) {
  if (*x->k->trouble || x->depth >= MOST_DEPTH) return false;
  x->depth++;
  bool ok = fits_here(x, pattern, node, out);
  x->depth--;
  return ok;
}

/* ---- templates ---- */

static match *find(match *bound, know_index name) {
  while (bound && bound->name != name) bound = bound->next;
  return bound;
}

static know_index new_node(expansion *x, know_kind kind, know_index origin) {
  if (++x->w->made > KNOW_MOST_MADE) return know_fail(x->k, &x->k->nodes[x->use].at, VS_OUTCOME_MODEL,
      "the macro used here never ends: it has made %d parts", KNOW_MOST_MADE), 0;
  know_index i = know_node_new(x->k, kind);
  if (i) x->k->nodes[i].origin = origin;
  return i;
}

static know_index copy_of_use(expansion *x, know_index node) {
  know_index i = new_node(x, (know_kind)x->k->nodes[node].kind, node);
  if (!i) return 0;
  const know_node *from = &x->k->nodes[node];
  know_node *n = &x->k->nodes[i];
  n->open = from->open, n->dotted = from->dotted, n->first = from->first, n->count = from->count, n->name = from->name,
      n->at = from->at;
  n->made = from->made;
  if (from->made && from->kind != KNOW_SYMBOL) n->origin = from->origin;
  return i;
}

static know_index made(expansion *x, know_index template) {
  know_index i = new_node(x, (know_kind)x->k->nodes[template].kind, template);
  if (!i) return 0;
  know_node *n = &x->k->nodes[i], *from = &x->k->nodes[template];
  n->made = true, n->open = from->open, n->at = x->k->nodes[x->use].at;
  if (n->kind == KNOW_SYMBOL) n->name = know_name_of(x->k, x->k->names[from->name].text,
      strlen(x->k->names[from->name].text), from->name, x->serial);
  else n->name = from->name;
  return i;
}

static know_index build(expansion *x, know_index template, match *bound);

static bool append(expansion *x, know_index list, know_index *last, know_index node) {
  if (!node) return false;
  knowledge *k = x->k;
  if (k->nodes[node].next || k->nodes[node].parent) node = copy_of_use(x, node);
  if (!node) return false;
  k->nodes[node].parent = list;
  if (*last) k->nodes[*last].next = node;
  else k->nodes[list].first = node;
  *last = node;
  k->nodes[list].count++;
  return true;
}

/* Returns a pattern variable that occurs in the template and whose value an ellipsis collected. */
static match *repeated_in(expansion *x, know_index template, match *bound) {
  const know_node *t = &x->k->nodes[template];
  if (t->kind == KNOW_SYMBOL) {
    match *m = find(bound, t->name);
    return m && m->repeated ? m : NULL;
  }
  match *found = NULL;
  if (++x->depth < MOST_DEPTH)
    for (know_index i = t->first; i && !found; i = x->k->nodes[i].next) found = repeated_in(x, i, bound);
  x->depth--;
  return found;
}

/* Builds the template once for each match that its variables have collected, `levels` ellipses deep. */
static bool repeat(expansion *x, know_index list, know_index *last, know_index template, match *bound, int levels) {
  match *m = repeated_in(x, template, bound);
  if (!m || x->depth >= MOST_DEPTH) return false;
  /* variables whose values one ellipsis collected share their parts; for other variables, the part with the same number
   * is used */
  uint32_t at = 0;
  for (match *part = m->parts; part; part = part->next, at++) {
    match *inner = bound;
    for (match *v = bound; v; v = v->next) {
      if (!v->repeated) continue;
      match *p = v->parts;
      for (uint32_t n = at; p && n; n--) p = p->next;
      match *own = p ? find(p->bound, v->name) : NULL;
      if (!own) continue;
      match *copy = bind(x, &inner, v->name, own->node);
      if (!copy) return false;
      copy->repeated = own->repeated, copy->parts = own->parts;
    }
    x->depth++;
    bool ok = levels > 1 ? repeat(x, list, last, template, inner, levels - 1) : append(x, list, last, build(x,
        template, inner));
    x->depth--;
    if (!ok) return false;
  }
  return true;
}

static know_index build_list(expansion *x, know_index template, match *bound) {
  knowledge *k = x->k;
  if (is_ellipsis(x, k->nodes[template].first) && k->nodes[template].count == 2) { /* (... ...): the template after the
                                                                                    * first ... is used literally */
    know_index kept = x->ellipsis, none = know_node_new(k, KNOW_SYMBOL);
    if (!none) return 0;
    x->ellipsis = none; /* sets the ellipsis to a name that does not occur: inside (... template), the name ... has no
                         * special meaning */
    know_index out = build(x, know_nth(k, template, 1), bound);
    x->ellipsis = kept;
    return out;
  }
  know_index list = made(x, template), last = 0;
  if (!list) return 0;
  for (know_index i = k->nodes[template].first; i; i = k->nodes[i].next) {
    know_index behind = k->nodes[i].next;
    bool is_tail = k->nodes[template].dotted && !behind;
    if (is_tail) {
      know_index end = build(x, i, bound);
      if (!end) return 0;
      if (k->nodes[end].kind == KNOW_LIST) { /* a list after the dot: (a . (b c)) is another spelling of (a b c) */
        for (know_index e = k->nodes[end].first; e; e = k->nodes[e].next)
          if (!append(x, list, &last, copy_of_use(x, e))) return 0;
        k->nodes[list].dotted = k->nodes[end].dotted;
        k->nodes[list].origin = k->nodes[list].origin ? k->nodes[list].origin : end;
      } else {
        if (!append(x, list, &last, end)) return 0;
        k->nodes[list].dotted = true;
      }
    } else if (is_ellipsis(x, behind)) {
      int levels = 0;
      while (is_ellipsis(x, k->nodes[i].next ? behind : 0) && behind) levels++, behind = k->nodes[behind].next;
      if (!repeat(x, list, &last, i, bound, levels)) return 0;
      know_index skip = i;
      for (int n = 0; n < levels; n++) skip = k->nodes[skip].next;
      i = skip;
    } else if (!append(x, list, &last, build(x, i, bound))) return 0;
  }
  return list;
}

static know_index build(expansion *x, know_index template, match *bound) {
  knowledge *k = x->k;
  if (*k->trouble || x->depth >= MOST_DEPTH) return 0;
  const know_node *t = &k->nodes[template];
  if (t->kind == KNOW_SYMBOL) {
    match *m = find(bound, t->name);
    if (m) return m->repeated ? 0 : copy_of_use(x, m->node);
    return made(x, template);
  }
  if (t->kind != KNOW_LIST && t->kind != KNOW_VECTOR) return made(x, template);
  x->depth++;
  know_index out = build_list(x, template, bound);
  x->depth--;
  return out;
}

/* ---- a use of a macro ---- */

static bool try_rule(expansion *x, know_index pattern, know_index template, know_index node, know_index *out) {
  match *bound = NULL;
  knowledge *k = x->k;
  x->depth = 1;
  if (k->nodes[pattern].kind != KNOW_LIST || !fits_list(x, pattern, node, true, &bound)) return false;
  x->serial = know_scope_new(k, x->defined, KNOW_SCOPE_SYNTAX, node);
  x->depth = 1;
  *out = build(x, template, bound);
  return *out != 0;
}

bool know_macro_expand(know_walk *w, know_index macro, know_index node, know_index scope, know_index *out) {
  knowledge *k = w->k;
  const know_symbol *s = &k->symbols[macro];
  expansion x = {.w = w, .k = k, .scope = scope, .defined = s->scope, .use = node};
  if (s->rules) return try_rule(&x, s->value, k->nodes[s->value].next, node, out);
  know_index rules = s->value;
  if (!rules || k->nodes[rules].kind != KNOW_LIST || !know_is(k, k->nodes[rules].first, "syntax-rules")) return false;
  know_index i = know_nth(k, rules, 1);
  if (i && k->nodes[i].kind == KNOW_SYMBOL) x.ellipsis = i, i = k->nodes[i].next;
  x.literals = i;
  for (i = i ? k->nodes[i].next : 0; i && !*k->trouble; i = k->nodes[i].next) {
    know_index pattern = k->nodes[i].first;
    if (pattern && try_rule(&x, pattern, k->nodes[pattern].next, node, out)) return true;
  }
  return false;
}
