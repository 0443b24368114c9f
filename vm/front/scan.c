/* Finds the end of a datum without building it, for continuation lines and for reading from ports. It is a state
 * machine. */
#include "vm/front/scan.h"
#include "vm/values/text.h"

enum { BLANK, ATOM, STRING, BARS, LINE, BLOCK, HASH, CHARACTER };

void vs_scan_open(vs_scheme *vm, vs_scan *s) {
  memset(s, 0, sizeof *s);
  s->vm = vm;
  s->wanted = 1;
  s->line = s->col = 1;
}

void vs_scan_close(vs_scan *s) {
  if (s->at) vs_mem(s->vm, s->at, s->room * sizeof *s->at, 0);
  s->at = NULL;
}

static bool push(vs_scan *s, uint32_t c) {
  if (s->depth == s->room) {
    size_t room = s->room ? 2 * s->room : 16;
    struct vs_scan_open *at = vs_mem(s->vm, s->at, s->room * sizeof *at, room * sizeof *at);
    if (!at) return false;
    s->at = at;
    s->room = room;
  }
  s->at[s->depth++] = (struct vs_scan_open){(char)c, s->line, s->col};
  return true;
}

static bool is_blank(uint32_t c) {
  return c <= ' ' || c == 0xA0 || c == 0xFEFF || c == 0x3000 || (c >= 0x2000 && c <= 0x200B) || c == 0x2028;
}
static bool is_delimiter(uint32_t c) { return is_blank(c) || (c < 128 && strchr("()[]\";,'`", (int)c)); }

/* Called when a datum is complete. Returns `how` if it was the last expected datum and all parentheses are closed,
 * otherwise VS_SCAN_MORE. */
static vs_scan_result ended(vs_scan *s, vs_scan_result how) {
  VS_ASSERT(s->wanted > 0);
  s->state = BLANK;
  return s->depth == 0 && --s->wanted == 0 ? how : VS_SCAN_MORE;
}

static vs_scan_result bad(vs_scan *s, const char *why) {
  s->trouble = why;
  return VS_SCAN_BAD;
}

static bool begin(vs_scan *s, uint32_t c, vs_scan_result *r) {
  s->token_line = s->line;
  s->token_col = s->col;
  if (is_blank(c) || c == '\'' || c == '`' || c == ',' || (c == '@' && s->escaped)) {
    s->escaped = c == ',';
    return true;
  }
  s->escaped = false;
  if (c == ';') { s->state = LINE; return true; }
  if (c == '#') { s->state = HASH; return true; }
  s->any = true;
  if (c == '(' || c == '[') return push(s, c);
  if (c == ')' || c == ']') {
    if (!s->depth) { *r = bad(s, c == ')' ? "this ) closes nothing" : "this ] closes nothing"); return true; }
    char open = s->at[--s->depth].open;
    if ((open == '(') != (c == ')')) { *r = bad(s, c == ')' ? "[ is closed by )" : "( is closed by ]"); return true; }
    *r = ended(s, VS_SCAN_WHOLE_WITH);
    return true;
  }
  s->state = c == '"' ? STRING : c == '|' ? BARS : ATOM;
  return true;
}

bool vs_scan_feed(vs_scan *s, uint32_t c, vs_scan_result *result) {
  bool ok = true;
  *result = VS_SCAN_MORE;
again:
  switch (s->state) {
  case BLANK: ok = begin(s, c, result); break;
  case HASH:                                       /* the state after the character # */
    s->any = s->any || (c != '|' && c != ';' && c != '!');
    if (c == ';') { s->wanted += s->depth == 0; s->state = BLANK; }
    else if (c == '|') { s->state = BLOCK; s->comment = 1; s->after_hash = 0; }
    else if (c == '\\') s->state = CHARACTER;
    else if (c == '(') { s->state = BLANK; ok = push(s, c); }
    else if (c == '!') { s->state = ATOM; s->after_hash = '!';
    } else {
      s->state = ATOM;
      s->after_hash = c == 'u' || (c >= '0' && c <= '9') ? '#' : 0;
      goto again;
    } /* after #u8( and #0= the same datum continues; in #t( a second datum begins with the parenthesis */
    break;
  case CHARACTER: s->state = ATOM; s->after_hash = 0; break;   /* any character may follow #\ */
  case ATOM:
    if (c == '|') { s->state = BARS; break; }
    /* The prefix #u8( begins a bytevector. */
    if (s->after_hash == '#' && c == '(') { s->after_hash = 0; s->state = BLANK; ok = push(s, c); break; }
    /* The label #0= precedes the datum that it labels. */
    if (s->after_hash == '#' && c == '=') { s->after_hash = 0; s->state = BLANK; break; }
    if (!is_delimiter(c)) break;
    /* A directive such as #!fold-case is no datum. */
    if (s->after_hash == '!') { s->after_hash = 0; s->state = BLANK; goto again; }
    s->after_hash = 0;
    *result = ended(s, VS_SCAN_WHOLE);
    if (*result == VS_SCAN_MORE) goto again;
    return true;
  case STRING:
    if (s->escaped) s->escaped = false;
    else if (c == '\\') s->escaped = true;
    else if (c == '"') *result = ended(s, VS_SCAN_WHOLE_WITH);
    break;
  case BARS:
    if (s->escaped) s->escaped = false;
    else if (c == '\\') s->escaped = true;
    else if (c == '|') s->state = ATOM;
    break;
  case LINE: if (c == '\n' || c == '\r') s->state = BLANK; break;
  case BLOCK:
    if (s->after_hash == '|' && c == '#') { s->after_hash = 0; if (!--s->comment) s->state = BLANK; }
    else if (s->after_hash == '#' && c == '|') { s->after_hash = 0; s->comment++; }
    else s->after_hash = c == '|' || c == '#' ? (uint8_t)c : 0;
    break;
  }
  if (c == '\r' || c == '\n') {                       /* a line ends with \r, \n or both in this order */
    s->line += c == '\r' || !s->returned;
    s->col = 1;
  } else s->col++;
  s->returned = c == '\r';
  return ok;
}

bool vs_scan_end(vs_scan *s) { return s->depth == 0 && (s->state == BLANK || s->state == LINE || s->state == ATOM); }

bool vs_read_whole(vs_scheme *vm, const char *text, size_t size, vs_text_check *out) {
  vs_scan s;
  vs_scan_open(vm, &s);
  bool ok = true, any = false;
  *out = (vs_text_check){VS_TEXT_EMPTY, 0, 1, 1, NULL};
  for (size_t i = 0; i < size && ok;) {
    uint32_t c;
    size_t n = vs_utf8_decode(text + i, size - i, &c);
    if (!n) { n = 1; c = 0xFFFD; }
    vs_scan_result r;
    ok = vs_scan_feed(&s, c, &r) && vs_poll_turn(vm, i, 4);
    if (r == VS_SCAN_BAD) { *out = (vs_text_check){VS_TEXT_BAD, 0, s.token_line, s.token_col, s.trouble}; break; }
    if (r != VS_SCAN_MORE) { any = true; s.wanted = 1; s.any = false; }
    if (r != VS_SCAN_WHOLE) i += n;                /* a delimiter that ended an atom is processed once more */
  }
  if (ok && out->state != VS_TEXT_BAD) {
    if (!vs_scan_end(&s) || s.wanted > 1) {
      bool token = s.state == STRING || s.state == BARS || s.state == BLOCK || !s.depth;
      *out = (vs_text_check){VS_TEXT_OPEN, (uint32_t)s.depth, token ? s.token_line : s.at[s.depth - 1].line,
                             token ? s.token_col : s.at[s.depth - 1].col, NULL};
    } else if (any || s.any) out->state = VS_TEXT_WHOLE;
  }
  vs_scan_close(&s);
  return ok;
}
