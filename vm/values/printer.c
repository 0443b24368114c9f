/* Implements the printer (printer.h). This file allocates no Scheme objects, so that the values and addresses on its
 * stacks remain valid.
 *
 * A walk with an explicit stack writes the text. Unless the mode is SIMPLE, the printer first finds the objects that
 * need a label. For write and display, only cycles need labels. The structure is then first walked as a tree, without
 * recording its objects, in at most as many steps as the heap can have objects. This suffices unless the structure has
 * cycles or much sharing, and needs no memory for a long list. Otherwise, a depth-first walk records the objects, and
 * finds those that it enters again while they are open (in mode SHARED: that it enters twice). */
#include "vm/values/printer.h"

#include <utf8proc.h>

#include "vm/numbers/dual.h"
#include "vm/numbers/number_text.h"

typedef enum {
  ITEM,        /* task: print v */
  TAIL,        /* task: print v, the remaining part of a list whose parenthesis was printed */
  CLOSE,       /* task: print ) */
  SLOTS,       /* task: print the elements of the vector, values object or record v from number i on, then ) or > */
  ENTRIES,     /* task: print the entries of the hash table v from position i on, then ) */
  DOT          /* task: print " . " */
} print_step;

typedef struct print_frame { uint8_t step; uint32_t i; vs_value v; } print_frame;

/* A record about an object in the walk; these records are in a hash table by the object's address. */
typedef struct print_note { const vs_object *object; int32_t label; } print_note;
enum { NOTE_OPEN = -1, NOTE_DONE = -2, NOTE_WANTED = -3 };      /* special values of print_note.label; any other value
                                                                 * is the printed number of the label */

typedef struct printer {
  vs_scheme *vm;
  vs_text *t;
  vs_print_mode mode;
  print_frame *stack; size_t count, room;
  print_note *notes; size_t noted, slots;
  int32_t labels;
} printer;

/* ---- the stack and the records of objects ---- */

static bool push(printer *p, print_step step, vs_value v, uint32_t i) {
  if (p->count == p->room) {
    size_t room = p->room ? p->room * 2 : 64;
    print_frame *stack = vs_mem(p->vm, p->stack, p->room * sizeof *stack, room * sizeof *stack);
    if (!stack) return false;
    p->stack = stack;
    p->room = room;
  }
  p->stack[p->count++] = (print_frame){(uint8_t)step, i, v};
  return true;
}

/* Returns the slot that contains object o, or the free slot where it belongs. The number of slots is a power of two. */
static print_note *note_slot(print_note *notes, size_t slots, const vs_object *o) {
  size_t i = (size_t)((uintptr_t)o * UINT64_C(0x9E3779B97F4A7C15) >> 20) & (slots - 1);
  VS_ASSERT(slots > 0 && (slots & (slots - 1)) == 0);
  while (notes[i].object && notes[i].object != o) i = (i + 1) & (slots - 1);
  return &notes[i];
}

static print_note *note_find(const printer *p, vs_value v) {
  if (!p->slots || !vs_is_object(v)) return NULL;
  print_note *n = note_slot(p->notes, p->slots, vs_object_of(v));
  return n->object ? n : NULL;
}

static bool note_add(printer *p, const vs_object *o) {
  if (p->noted * 2 >= p->slots) {
    size_t slots = p->slots ? p->slots * 2 : 256;
    print_note *notes = vs_mem(p->vm, NULL, 0, slots * sizeof *notes);
    if (!notes) return false;
    memset(notes, 0, slots * sizeof *notes);
    for (size_t i = 0; i < p->slots; i++)
      if (p->notes[i].object) *note_slot(notes, slots, p->notes[i].object) = p->notes[i];
    if (p->notes) vs_mem(p->vm, p->notes, p->slots * sizeof *notes, 0);
    p->notes = notes;
    p->slots = slots;
  }
  *note_slot(p->notes, p->slots, o) = (print_note){o, NOTE_OPEN};
  p->noted++;
  return true;
}

/* ---- finding the objects that need labels ---- */

static bool is_compound(vs_value v) {
  if (!vs_is_object(v)) return false;
  int type = vs_object_of(v)->type;
  return type == VS_T_PAIR || type == VS_T_VECTOR || type == VS_T_TABLE || type == VS_T_RECORD || type == VS_T_BOX ||
         type == VS_T_VALUES || type == VS_T_CONDITION;
}

static size_t record_fields(const vs_record *r) { return r->h.words - 2; }

/* Returns true if the name begins with %, as internal names of the library do. Records of a type with such a name are
 * printed without the fields with such names, which may contain the record's owner. */
static bool is_inner_name(vs_value name) { return vs_is_symbol(name) && *vs_as_symbol(name)->name == '%'; }
static bool is_hidden(const vs_record *r, uint32_t i) {
  const vs_record_type *type = vs_as_record_type(r->type);
  return is_inner_name(type->name) && vs_is_vector(type->fields) && i < vs_as_vector(type->fields)->length &&
         is_inner_name(vs_as_vector(type->fields)->at[i]);
}

/* Sets *child to child number *i of v, a compound value, and advances *i. Returns false after the last child. */
static bool next_child(vs_value v, uint32_t *i, vs_value *child) {
  vs_value other;
  VS_ASSERT(is_compound(v));
  switch (vs_object_of(v)->type) {
    case VS_T_PAIR:
      if (*i >= 2) return false;
      *child = (*i)++ == 0 ? vs_car(v) : vs_cdr(v);
      return true;
    case VS_T_VECTOR:
      if (*i >= vs_as_vector(v)->length) return false;
      *child = vs_as_vector(v)->at[(*i)++];
      return true;
    case VS_T_VALUES:
      if (*i >= vs_as_values(v)->count) return false;
      *child = vs_as_values(v)->at[(*i)++];
      return true;
    case VS_T_RECORD:
      while (*i < record_fields(vs_as_record(v)) && is_hidden(vs_as_record(v), *i)) (*i)++;
      if (*i >= record_fields(vs_as_record(v))) return false;
      *child = vs_as_record(v)->at[(*i)++];
      return true;
    case VS_T_BOX:
      if ((*i)++) return false;
      *child = vs_as_box(v)->value;
      return true;
    case VS_T_CONDITION:
      if ((*i)++) return false;
      *child = vs_as_condition(v)->irritants;
      return true;
    case VS_T_TABLE: {
      /* Children with even numbers are the keys of the table v, those with odd numbers its values. i/2 is the position
       * of the entry. */
      uint32_t position = *i >> 1;
      const vs_table *t = vs_as_table(v);
      const vs_value *at = vs_as_vector(t->entries)->at;
      while (position < t->used && at[position * 3] == VS_VACANT) position++;
      if (position >= t->used) return false;
      *child = at[position * 3];
      other = at[position * 3 + 1];
      if (*i & 1) *child = other;
      *i = (position << 1 | (*i & 1)) + 1;
      return true;
    }
  }
  return false;
}

/* Sets *small to true if walking the structure as a tree ends within `budget` steps. */
static bool walk_tree(printer *p, vs_value v, size_t budget, bool *small) {
  size_t steps = 0;
  *small = false;
  if (!push(p, ITEM, v, 0)) return false;
  while (p->count) {
    print_frame *f = &p->stack[p->count - 1];
    vs_value child;
    if (++steps > budget) break;
    if (!vs_poll_turn(p->vm, steps, 8)) return false;
    if (!next_child(f->v, &f->i, &child)) {
      p->count--;
    } else if (is_compound(child)) {
      /* The pair's cdr replaces the pair on the stack, so that long lists need no memory. */
      if (vs_object_of(f->v)->type == VS_T_PAIR && f->i == 2) *f = (print_frame){ITEM, 0, child};
      else if (!push(p, ITEM, child, 0)) return false;
    }
  }
  *small = p->count == 0;
  p->count = 0;
  return true;
}

static bool find_labels(printer *p, vs_value v) {
  if (!note_add(p, vs_object_of(v)) || !push(p, ITEM, v, 0)) return false;
  for (size_t steps = 1; p->count; steps++) {
    print_frame *f = &p->stack[p->count - 1];
    vs_value child;
    if (!vs_poll_turn(p->vm, steps, 8)) return false;
    if (!next_child(f->v, &f->i, &child)) {
      print_note *n = note_find(p, f->v);
      if (n->label == NOTE_OPEN) n->label = NOTE_DONE;
      p->count--;
    } else if (is_compound(child)) {
      print_note *n = note_find(p, child);
      if (!n) {
        if (!note_add(p, vs_object_of(child)) || !push(p, ITEM, child, 0)) return false;
      } else if (n->label == NOTE_OPEN || p->mode == VS_PRINT_SHARED) {
        n->label = NOTE_WANTED;
      }
    }
  }
  return true;
}

/* ---- printing atoms ---- */

static const struct { uint32_t c; const char *name;
} char_names[] = {
  { ' ', "space" },   { '\n', "newline" }, { '\t', "tab" },    { '\r', "return" }, { 0, "null" },
  { 0x7F, "delete" }, { 0x1B, "escape" },  { 8, "backspace" }, { 7, "alarm" },
};

/* Returns false for characters that are printed as numbers: control characters, unassigned code points and marks. */
static bool is_visible(uint32_t c) {
  if (c < 0x20 || (c >= 0x7F && c < 0xA0)) return false;
  if (c < 0x7F) return true;
  utf8proc_category_t k = utf8proc_category((utf8proc_int32_t)c);
  return k != UTF8PROC_CATEGORY_CN && k != UTF8PROC_CATEGORY_CC && k != UTF8PROC_CATEGORY_CF &&
         k != UTF8PROC_CATEGORY_CS && k != UTF8PROC_CATEGORY_CO && k != UTF8PROC_CATEGORY_ZL &&
         k != UTF8PROC_CATEGORY_ZP && k != UTF8PROC_CATEGORY_ZS;
}

static bool put_hex(vs_text *t, uint32_t c) {
  static const char digit[] = "0123456789abcdef";
  char s[8];
  size_t i = sizeof s;
  do s[--i] = digit[c & 15];
  while (c >>= 4);
  return vs_text_put(t, s + i, sizeof s - i);
}

static bool put_int(vs_text *t, uint64_t n) {
  char s[20];
  size_t i = sizeof s;
  do s[--i] = (char)('0' + n % 10);
  while (n /= 10);
  return vs_text_put(t, s + i, sizeof s - i);
}

static bool put_char(vs_text *t, uint32_t c) {
  if (!vs_text_puts(t, "#\\")) return false;
  for (size_t i = 0; i < sizeof char_names / sizeof *char_names; i++)
    if (char_names[i].c == c) return vs_text_puts(t, char_names[i].name);
  bool mark = c >= 0x300 && (utf8proc_category((utf8proc_int32_t)c) == UTF8PROC_CATEGORY_MN);
  if (is_visible(c) && !mark) return vs_text_char(t, c);
  return vs_text_put(t, "x", 1) && put_hex(t, c);
}

/* Appends one character of a string (quote is ") or of a symbol (quote is |), with an escape if necessary. */
static bool put_escaped(vs_text *t, uint32_t c, char quote) {
  if (c == (uint32_t)quote || c == '\\') {
    char s[2] = {'\\', (char)c};
    return vs_text_put(t, s, 2);
  }
  switch (c) {
    case '\n': return vs_text_put(t, "\\n", 2);
    case '\t': return vs_text_put(t, "\\t", 2);
    case '\r': return vs_text_put(t, "\\r", 2);
    case 7: return vs_text_put(t, "\\a", 2);
    case 8: return vs_text_put(t, "\\b", 2);
  }
  if (c == 0xA0 || is_visible(c) || (c > 0x7F && utf8proc_category((utf8proc_int32_t)c) == UTF8PROC_CATEGORY_ZS))
    return vs_text_char(t, c);
  return vs_text_put(t, "\\x", 2) && put_hex(t, c) && vs_text_put(t, ";", 1);
}

static bool put_string(vs_text *t, vs_value v) {
  const vs_string *s = vs_as_string(v);
  const uint8_t *narrow = vs_as_bytes(s->store)->at;
  const uint32_t *wide = (const uint32_t *)(const void *)narrow;
  bool ok = vs_text_put(t, "\"", 1);
  for (uint32_t i = 0; ok && i < s->length; i++)
    ok = put_escaped(t, s->h.flags & VS_F_WIDE ? wide[i] : narrow[i], '"') && vs_poll_turn(t->vm, i, 4);
  return ok && vs_text_put(t, "\"", 1);
}

static bool same_letters(const char *s, const char *lower, size_t n) {
  for (size_t i = 0; i < n; i++) if ((s[i] >= 'A' && s[i] <= 'Z' ? s[i] | 32 : s[i]) != lower[i]) return false;
  return true;
}

/* Returns true if a symbol's name has the syntax of a number, in VisualScheme or in other Schemes (+i). */
static bool spells_number(const char *s, size_t n) {
  bool sign = *s == '+' || *s == '-';
  if (sign && n == 2 && (s[1] | 32) == 'i') return true;
  if (n > 3 && (same_letters(s + n - 3, "+0i", 3) || same_letters(s + n - 3, "-0i", 3))) n -= 3;
  const char *end = s + n;
  if (sign && n == 6 && (same_letters(s + 1, "inf.0", 5) || same_letters(s + 1, "nan.0", 5))) return true;
  if (sign) s++;
  const char *digits = s;
  while (s < end && *s >= '0' && *s <= '9') s++;
  size_t whole = (size_t)(s - digits), part = 0;
  if (whole && s < end && *s == '/') {
    for (digits = ++s; s < end && *s >= '0' && *s <= '9';) s++;
    return s == end && s > digits;
  }
  if (s < end && *s == '.') for (s++; s < end && *s >= '0' && *s <= '9'; part++) s++;
  if (whole + part == 0) return false;
  if (s < end && strchr("eEsSfFdDlL", *s)) {
    s++;
    if (s < end && (*s == '+' || *s == '-')) s++;
    for (digits = s; s < end && *s >= '0' && *s <= '9';) s++;
    if (s == digits) return false;
  }
  return s == end;
}

static bool needs_bars(const char *s, size_t n) {
  if (n == 0 || (n == 1 && *s == '.') || (*s == '#' && !(n > 2 && (s[1] == ':' || s[1] == '%'))) || spells_number(s, n))
    return true;
  for (size_t i = 0; i < n;) {
    uint32_t c;
    size_t used = vs_utf8_decode(s + i, n - i, &c);
    if (!used || c <= ' ' || strchr("()[]{}\";'`,|\\", (int)(c < 0x80 ? c : 'a')) || !is_visible(c)) return true;
    i += used;
  }
  return false;
}

static bool put_symbol(vs_text *t, vs_value v, bool written) {
  const vs_symbol *s = vs_as_symbol(v);
  if (!written || !needs_bars(s->name, s->length)) return vs_text_put(t, s->name, s->length);
  bool ok = vs_text_put(t, "|", 1);
  for (size_t i = 0; ok && i < s->length;) {
    uint32_t c;
    size_t used = vs_utf8_decode(s->name + i, s->length - i, &c);
    if (!used) break;
    ok = put_escaped(t, c, '|');
    i += used;
  }
  return ok && vs_text_put(t, "|", 1);
}

/* Appends "#<WHAT NAME>", without NAME if it is neither a symbol nor a string. */
static bool put_opaque(vs_text *t, const char *what, vs_value name) {
  bool ok = vs_text_put(t, "#<", 2) && vs_text_puts(t, what);
  if (ok && vs_is_symbol(name)) ok = vs_text_put(t, " ", 1) && put_symbol(t, name, false);
  if (ok && vs_is_string(name)) ok = vs_text_put(t, " ", 1) && vs_text_string(t, name);
  return ok && vs_text_put(t, ">", 1);
}

static bool put_flat(vs_scheme *vm, vs_text *t, vs_value v) {
  const vs_flat *f = vs_as_flat(v);
  uint32_t tag = vs_flat_tag(f), count = vs_flat_count(f);
  const vs_flat_type *type = vm->flat && tag < VS_FLAT_TAGS ? &vm->flat->type[tag] : NULL;
  bool ok = vs_text_put(t, "(", 1) && vs_text_puts(t, type && type->constructor ? type->constructor : "flat");
  if (type && (uint32_t)type->fields < count) count = (uint32_t)type->fields;
  for (uint32_t i = 0; ok && i < count; i++) {
    char s[VS_DOUBLE_TEXT];
    const char *part = type && i / 3 < 2 ? type->parts[i / 3] : NULL;
    if (part && i % 3 == 0) ok = vs_text_puts(t, i ? ") (" : " (") && vs_text_puts(t, part);
    size_t n = vs_double_text(f->at[i] == 0 ? 0.0 : f->at[i], s);
    if (n > 2 && s[n - 1] == '0' && s[n - 2] == '.' && s[n - 3] >= '0' && s[n - 3] <= '9') n -= 2;
    ok = ok && vs_text_put(t, " ", 1) && vs_text_put(t, s, n);
  }
  return ok && vs_text_puts(t, type && type->parts[0] ? "))" : ")");
}

static bool put_bytes(vs_text *t, vs_value v) {
  const vs_bytes *b = vs_as_bytes(v);
  bool ok = vs_text_put(t, "#u8(", 4);
  for (uint64_t i = 0; ok && i < b->length; i++)
    ok = (i == 0 || vs_text_put(t, " ", 1)) && put_int(t, b->at[i]) && vs_poll_turn(t->vm, i, 16);
  return ok && vs_text_put(t, ")", 1);
}

static bool put_foreign(void *to, const char *s, size_t n) { return vs_text_put(to, s, n); }

static bool put_immediate(vs_text *t, vs_value v, bool written) {
  if (vs_is_char(v)) return written ? put_char(t, vs_char(v)) : vs_text_char(t, vs_char(v));
  const char *s = v == VS_TRUE        ? "#t"
                  : v == VS_FALSE     ? "#f"
                  : v == VS_NIL       ? "()"
                  : v == VS_EOF       ? "#<eof>"
                  : v == VS_UNDEFINED ? "#<undefined>"
                  : v == VS_ABSENT    ? "#<absent>"
                                      : "#<void>";
  return vs_text_puts(t, s);
}

static bool put_atom(printer *p, vs_value v) {
  vs_text *t = p->t;
  bool written = p->mode != VS_PRINT_DISPLAY;
  if (vs_is_number(v)) return vs_number_print(p->vm, v, 10, t);
  if (!vs_is_object(v)) return put_immediate(t, v, written);
  const vs_object *o = vs_object_of(v);
  switch (o->type) {
    case VS_T_STRING: return written ? put_string(t, v) : vs_text_string(t, v);
    case VS_T_SYMBOL: return put_symbol(t, v, written);
    case VS_T_BYTES: return put_bytes(t, v);
    case VS_T_FLAT: return put_flat(p->vm, t, v);
    case VS_T_DUAL: /* a dual number is printed without its derivative: users print numbers to follow a program */
      return vs_text_puts(t, "#<dual ") && put_atom(p, vs_dual_base(v)) && vs_text_puts(t, ">");
    case VS_T_CLOSURE: return put_opaque(t, "procedure", vs_as_code(vs_as_closure(v)->code)->name);
    case VS_T_CASE: {
      const vs_case *c = vs_as_case(v);
      return put_opaque(t, "procedure", c->count ? vs_as_code(vs_as_closure(c->clause[0])->code)->name : VS_FALSE);
    }
    case VS_T_NATIVE: return put_opaque(t, "procedure", vs_as_native(v)->name);
    case VS_T_CONTINUATION: return put_opaque(t, "continuation", VS_FALSE);
    case VS_T_PARAMETER: return put_opaque(t, "parameter", vs_as_parameter(v)->name);
    case VS_T_CODE: return put_opaque(t, "code", vs_as_code(v)->name);
    case VS_T_CELL: return put_opaque(t, "variable", vs_as_cell(v)->name);
    case VS_T_RECORD_TYPE: return put_opaque(t, "record-type", vs_as_record_type(v)->name);
    case VS_T_PORT: return put_opaque(t, "port", vs_as_port(v)->name);
    case VS_T_PROMISE: return put_opaque(t, "promise", VS_FALSE);
    case VS_T_ENVIRONMENT: return put_opaque(t, "environment", vs_as_environment(v)->name);
    case VS_T_MACRO: return put_opaque(t, "macro", VS_FALSE);
    case VS_T_ALIAS: {
      while (vs_is(v, VS_T_ALIAS)) v = vs_as_alias(v)->name;
      return vs_is_symbol(v) ? put_symbol(t, v, written) : put_opaque(t, "identifier", VS_FALSE);
    }
    case VS_T_FOREIGN: {
      const vs_foreign *f = vs_as_foreign(v);
      if (f->type->print) return f->type->print(p->vm, f->object, put_foreign, t);
      const char *name = f->type->name;
      return put_opaque(t, !strncmp(name, "a ", 2) ? name + 2 : !strncmp(name, "an ", 3) ? name + 3 : name, VS_FALSE);
    }
  }
  return put_opaque(t, "object", VS_FALSE);
}

/* ---- printing compound data ---- */

/* Returns the abbreviation ' for (quote x), and similar ones, or NULL. (unquote @x) has none, since ,@x means
 * (unquote-splicing x). */
static const char *abbreviation(const vs_scheme *vm, vs_value v) {
  if (!vs_is_pair(v) || !vs_is_pair(vs_cdr(v)) || vs_cdr(vs_cdr(v)) != VS_NIL) return NULL;
  vs_value head = vs_car(v), quoted = vs_car(vs_cdr(v));
  if (head == vm->sym.unquote && vs_is_symbol(quoted) && vs_as_symbol(quoted)->name[0] == '@') return NULL;
  return head == vm->sym.quote              ? "'"
         : head == vm->sym.quasiquote       ? "`"
         : head == vm->sym.unquote          ? ","
         : head == vm->sym.unquote_splicing ? ",@"
                                            : NULL;
}

static bool put_label(printer *p, print_note *n, bool *again) {
  *again = n->label >= 0;
  if (!*again) n->label = p->labels++;
  return vs_text_put(p->t, "#", 1) && put_int(p->t, (uint64_t)n->label) && vs_text_put(p->t, *again ? "#" : "=", 1);
}

static bool has_label(const printer *p, vs_value v) {
  print_note *n = note_find(p, v);
  return n && (n->label >= 0 || n->label == NOTE_WANTED);
}

static bool put_item(printer *p, vs_value v) {
  if (!is_compound(v)) return put_atom(p, v);
  vs_text *t = p->t;
  if (has_label(p, v)) {
    bool again;
    if (!put_label(p, note_find(p, v), &again)) return false;
    if (again) return true;
  }
  const char *short_form;
  switch (vs_object_of(v)->type) {
    case VS_T_PAIR:
      short_form = abbreviation(p->vm, v);
      if (short_form && !has_label(p, vs_cdr(v)))
        return vs_text_puts(t, short_form) && push(p, ITEM, vs_car(vs_cdr(v)), 0);
      return vs_text_put(t, "(", 1) && push(p, TAIL, vs_cdr(v), 0) && push(p, ITEM, vs_car(v), 0);
    case VS_T_VECTOR: return vs_text_put(t, "#(", 2) && push(p, SLOTS, v, 0);
    case VS_T_VALUES: return push(p, SLOTS, v, 0);
    case VS_T_RECORD: {
      const vs_record_type *type = vs_as_record_type(vs_as_record(v)->type);
      if (is_inner_name(type->name))
        return vs_text_put(t, "#<", 2) && vs_text_puts(t, vs_as_symbol(type->name)->name + 1) && push(p, SLOTS, v, 0);
      return vs_text_put(t, "#<", 2) &&
             (vs_is_symbol(type->name) ? put_symbol(t, type->name, false) : vs_text_puts(t, "record")) &&
             push(p, SLOTS, v, 0);
    }
    case VS_T_BOX: return vs_text_put(t, "#&", 2) && push(p, ITEM, vs_as_box(v)->value, 0);
    case VS_T_TABLE: return vs_text_puts(t, "#hash(") && push(p, ENTRIES, v, 0);
    case VS_T_CONDITION: {
      const vs_condition *c = vs_as_condition(v);
      if (!vs_text_puts(t, "#<error ") ||
          !(vs_is_string(c->message) ? put_string(t, c->message) : vs_text_puts(t, "?")))
        return false;
      if (vs_is_pair(c->irritants))
        return push(p, SLOTS, v, 0) && vs_text_put(t, " ", 1) && push(p, ITEM, c->irritants, 0);
      return vs_text_put(t, ">", 1);
    }
  }
  return true;
}

static bool step_slots(printer *p, print_frame f) {
  vs_value child;
  uint32_t i = f.i;
  int type = vs_object_of(f.v)->type;
  if (type == VS_T_CONDITION || !next_child(f.v, &i, &child))
    return type == VS_T_VALUES || vs_text_put(p->t, type == VS_T_VECTOR ? ")" : ">", 1);
  if ((f.i > 0 || type == VS_T_RECORD) && !vs_text_put(p->t, " ", 1)) return false;
  if (type == VS_T_RECORD) {
    vs_value fields = vs_as_record_type(vs_as_record(f.v)->type)->fields;
    if (vs_is_vector(fields) && i - 1 < vs_as_vector(fields)->length && vs_is_symbol(vs_as_vector(fields)->at[i - 1]) &&
        !(put_symbol(p->t, vs_as_vector(fields)->at[i - 1], true) && vs_text_put(p->t, "=", 1)))
      return false;
  }
  return push(p, SLOTS, f.v, i) && push(p, ITEM, child, 0);
}

static bool step_entries(printer *p, print_frame f) {
  vs_value key, value;
  uint32_t i = f.i, before = f.i;
  if (!next_child(f.v, &i, &key)) return vs_text_put(p->t, ")", 1);
  next_child(f.v, &i, &value);
  return (before == 0 || vs_text_put(p->t, " ", 1)) && vs_text_put(p->t, "(", 1) && push(p, ENTRIES, f.v, i) &&
         push(p, CLOSE, VS_NIL, 0) && push(p, ITEM, value, 0) && push(p, DOT, VS_NIL, 0) && push(p, ITEM, key, 0);
}

static bool step_tail(printer *p, vs_value v) {
  if (v == VS_NIL) return vs_text_put(p->t, ")", 1);
  if (vs_is_pair(v) && !has_label(p, v))
    return vs_text_put(p->t, " ", 1) && push(p, TAIL, vs_cdr(v), 0) && push(p, ITEM, vs_car(v), 0);
  return vs_text_put(p->t, " . ", 3) && push(p, CLOSE, VS_NIL, 0) && push(p, ITEM, v, 0);
}

static bool print_compound(printer *p, vs_value v) {
  bool small = p->mode == VS_PRINT_SIMPLE;
  if (!small && p->mode != VS_PRINT_SHARED && !walk_tree(p, v, 1000 + p->vm->bytes / 16, &small)) return false;
  if (!small && !find_labels(p, v)) return false;
  bool ok = push(p, ITEM, v, 0);
  for (uint32_t steps = 1; ok && p->count && !p->t->cut; steps++) {
    print_frame f = p->stack[--p->count];
    switch ((print_step)f.step) {
      case ITEM: ok = put_item(p, f.v); break;
      case TAIL: ok = step_tail(p, f.v); break;
      case CLOSE: ok = vs_text_put(p->t, ")", 1); break;
      case SLOTS: ok = step_slots(p, f); break;
      case ENTRIES: ok = step_entries(p, f); break;
      case DOT: ok = vs_text_put(p->t, " . ", 3); break;
    }
    if ((steps & 1023) == 0) ok = ok && vs_poll(p->vm, 64 * 1024);         /* polls every 1024 steps; printing a number
                                                                            * takes about half a microsecond */
  }
  return ok;
}

bool vs_print(vs_scheme *vm, vs_value v, vs_print_mode mode, vs_text *t) {
  printer p = {.vm = vm, .t = t, .mode = mode};
  if (!is_compound(v)) return put_atom(&p, v);
  bool ok = print_compound(&p, v);
  if (p.stack) vs_mem(vm, p.stack, p.room * sizeof *p.stack, 0);
  if (p.notes) vs_mem(vm, p.notes, p.slots * sizeof *p.notes, 0);
  return ok;
}

/* ---- printing errors ---- */

/* Appends a value to a message, shortened to 240 bytes. */
static bool put_brief(vs_scheme *vm, vs_value v, vs_text *t) {
  vs_text brief;
  vs_text_open(vm, &brief, 240);
  bool ok = vs_print(vm, v, VS_PRINT_WRITE, &brief) && vs_text_put(t, brief.at ? brief.at : "", brief.count) &&
            (!brief.cut || vs_text_puts(t, " ..."));
  vs_text_close(&brief);
  return ok;
}

bool vs_print_condition(vs_scheme *vm, vs_value condition, vs_text *t) {
  if (!vs_is(condition, VS_T_CONDITION)) return vs_text_puts(t, "uncaught raise: ") && put_brief(vm, condition, t);
  const vs_condition *c = vs_as_condition(condition);
  bool ok = vs_is_string(c->message) ? vs_text_string(t, c->message) : put_brief(vm, c->message, t);
  int shown = 0;
  for (vs_value l = c->irritants; ok && vs_is_pair(l); l = vs_cdr(l)) {
    if (++shown > 20) return vs_text_puts(t, " ...");
    ok = vs_text_put(t, " ", 1) && put_brief(vm, vs_car(l), t);
  }
  return ok;
}
