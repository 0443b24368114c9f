/* Reads unfinished Scheme text for the prompt. It splits the text into tokens, by which the prompt finds brackets,
 * colours and indentation. */
#include "cli/prompt/source_text.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

const char *const cli_syntax_colours[] = {
#define SYNTAX(name, colour, what) colour,
#include "cli/prompt/syntax.def"
};

typedef enum { TOKEN_BLANK, TOKEN_COMMENT, TOKEN_STRING, TOKEN_OPEN, TOKEN_CLOSE, TOKEN_QUOTE, TOKEN_WORD } token_kind;
typedef struct {
  size_t from, to;
  token_kind kind;
  bool whole; /* whether the token is complete; false for a string or comment that is not closed */
} token;

static bool ends_word(char c) { return strchr(" \t\r\n()[]{}\"';`,", c) != NULL; }

/* Returns the end of the string that begins at `at`, or length + 1 if the string is not closed. */
static size_t end_of_string(const char *text, size_t length, size_t at) {
  for (size_t i = at + 1; i < length; i++) {
    if (text[i] == '\\') i++;
    else if (text[i] == '"') return i + 1;
  }
  return length + 1;
}

/* Returns the end of the comment #| ... |# that begins at `at`, including nested comments. Returns length + 1 if the
 * comment is not closed. */
static size_t end_of_comment(const char *text, size_t length, size_t at) {
  int depth = 0;
  for (size_t i = at; i + 1 < length; i++) {
    if (text[i] == '#' && text[i + 1] == '|') depth++, i++;
    else if (text[i] == '|' && text[i + 1] == '#') {
      if (--depth == 0) return i + 2;
      i++;
    }
  }
  return length + 1;
}

/* Returns the token at position `at`, which must be less than the length. */
static token next_token(const char *text, size_t length, size_t at) {
  char c = text[at], next = at + 1 < length ? text[at + 1] : 0;
  token t = { at, at + 1, TOKEN_WORD, true };
  if (isspace((unsigned char)c)) t.kind = TOKEN_BLANK;
  else if (c == ';') {
    const char *end = memchr(text + at, '\n', length - at);
    t = (token){ at, end ? (size_t)(end - text) : length, TOKEN_COMMENT, true };
  } else if (c == '#' && next == '|') t = (token){ at, end_of_comment(text, length, at), TOKEN_COMMENT, true };
  else if (c == '#' && next == ';') t = (token){ at, at + 2, TOKEN_QUOTE, true };
  else if (c == '"') t = (token){ at, end_of_string(text, length, at), TOKEN_STRING, true };
  else if (c == '(' || c == '[') t.kind = TOKEN_OPEN;
  else if (c == ')' || c == ']') t.kind = TOKEN_CLOSE;
  else if (c == '\'' || c == '`' || c == ',') t.kind = TOKEN_QUOTE;
  else {
    if (c == '#' && next == '\\') t.to += 2; /* the character after #\ may be a bracket */
    while (t.to < length && !ends_word(text[t.to])) t.to++;
  }
  if (t.to > length) t.to = length, t.whole = false;
  return t;
}

size_t cli_text_open(const char *text, size_t length, size_t open[CLI_DEEP], bool *in_string) {
  size_t depth = 0;
  bool string = false;
  for (size_t at = 0; at < length;) {
    token t = next_token(text, length, at);
    if (t.kind == TOKEN_OPEN) {
      if (depth < CLI_DEEP) open[depth] = at;
      depth++;
    } else if (t.kind == TOKEN_CLOSE && depth) depth--;
    string = t.kind == TOKEN_STRING && !t.whole;
    at = t.to;
  }
  if (in_string) *in_string = string;
  return depth < CLI_DEEP ? depth : CLI_DEEP;
}

/* ---- the call at the end of a text ---- */

/* Returns the number of the argument at the end of a text that follows the name of a call. */
static int argument_at(const char *text, size_t length) {
  int begun = 0, current = -1, depth = 0;
  bool touching = true, of_keyword = false, prefix = false; /* touching: the last token reaches the end of the text;
                                                             * of_keyword: the next argument is the value of a keyword;
                                                             * prefix: a quote precedes the next datum */
  for (size_t at = 0; at < length;) {
    token t = next_token(text, length, at);
    bool starts = t.kind == TOKEN_OPEN || t.kind == TOKEN_WORD || t.kind == TOKEN_STRING || t.kind == TOKEN_QUOTE;
    if (depth == 0 && starts && !prefix) {
      bool keyword = t.kind == TOKEN_WORD && t.to - t.from > 2 && !memcmp(text + t.from, "#:", 2);
      current = keyword || of_keyword ? -1 : begun++;
      of_keyword = keyword;
    }
    prefix = t.kind == TOKEN_QUOTE; /* the datum after a quote belongs to the quote's argument */
    depth += t.kind == TOKEN_OPEN;
    depth -= t.kind == TOKEN_CLOSE;
    touching = t.kind != TOKEN_BLANK && t.kind != TOKEN_COMMENT;
    at = t.to;
  }
  if (touching || depth > 0) return current;
  return of_keyword ? -1 : begun;
}

bool cli_text_call(const char *text, cli_call *call) {
  size_t open[CLI_DEEP], depth = cli_text_open(text, strlen(text), open, NULL);
  while (depth-- > 0) {
    const char *name = text + open[depth] + 1;
    size_t n = 0;
    while (name[n] && !ends_word(name[n])) n++;
    if (!n || n >= sizeof call->name) continue;
    memcpy(call->name, name, n);
    call->name[n] = 0;
    call->argument = argument_at(name + n, strlen(name + n));
    return true;
  }
  return false;
}

/* ---- names ---- */

static bool describe(vs_scheme *scheme, const char *word, size_t n, vs_name_info *info) {
  char name[100];
  if (!n || n >= sizeof name) return false;
  memcpy(name, word, n);
  name[n] = 0;
  return vs_name_get(scheme, name, info);
}

static bool is_procedure(vs_scheme *scheme, const char *word, size_t n) {
  vs_name_info info;
  return describe(scheme, word, n, &info) && strcmp(info.kind, "procedure") == 0;
}

size_t cli_text_indentation(vs_scheme *scheme, const char *text) {
  enum { MOST = 60 };
  size_t open[CLI_DEEP], length = strlen(text), column = 0;
  bool in_string;
  size_t depth = cli_text_open(text, length, open, &in_string);
  if (!depth || in_string) return 0;
  size_t bracket = open[depth - 1], from = bracket;
  while (from > 0 && text[from - 1] != '\n') from--;
  for (size_t i = from; i < bracket; i++) column += ((unsigned char)text[i] & 0xC0) != 0x80;
  size_t n = 0, more = 2;
  while (text[bracket + 1 + n] && !ends_word(text[bracket + 1 + n])) n++;
  const char *name = text + bracket + 1, *argument = name + n + strspn(name + n, " \t");
  /* more: columns by which the next line is indented; 1 for quoted data and for clauses in [ ] */
  if (!n || text[bracket] == '[' || (bracket && text[bracket - 1] == '\'')) more = 1;
  else if (is_procedure(scheme, name, n) && *argument && *argument != '\n' && *argument != ';')
    more = (size_t)(argument - text) - bracket;
  return column + more < MOST ? column + more : MOST;
}

/* Returns true if the end of the text is among the arguments of a procedure. */
static bool in_arguments(vs_scheme *scheme, const char *text, size_t length) {
  size_t open[CLI_DEEP], depth = cli_text_open(text, length, open, NULL), n = 0;
  if (!depth) return false;
  const char *name = text + open[depth - 1] + 1;
  while (name + n < text + length && !ends_word(name[n])) n++;
  return is_procedure(scheme, name, n);
}

unsigned cli_text_lacks_bracket(vs_scheme *scheme, const char *text) {
  unsigned number = 1;
  const char *line = text;
  while ((line = strchr(line, '\n')) != NULL) {
    line++;
    const char *first = line + strspn(line, " \t");
    bool definition = strncmp(first, "(define", 7) == 0 && in_arguments(scheme, text, (size_t)(line - text));
    if (*line == '(' || *line == '[' || definition) return number;
    number++;
  }
  return 0;
}

/* ---- colours ---- */

static cli_syntax class_of_word(vs_scheme *scheme, const char *word, size_t n, bool quoted) {
  vs_name_info info;
  if (n > 2 && word[0] == '#' && word[1] == ':') return CLI_SYNTAX_KEYWORD;
  if (quoted || word[0] == '#') return CLI_SYNTAX_LITERAL;
  if (describe(scheme, word, n, &info)) {
    if (strcmp(info.kind, "form") == 0) return CLI_SYNTAX_FORM;
    if (strcmp(info.kind, "procedure") == 0) return CLI_SYNTAX_PROCEDURE;
    return CLI_SYNTAX_PLAIN;
  }
  size_t sign = strchr("+-.", word[0]) && n > 1;
  return isdigit((unsigned char)word[sign]) ? CLI_SYNTAX_LITERAL : CLI_SYNTAX_PLAIN;
}

void cli_text_classes(vs_scheme *scheme, const char *text, size_t length, size_t cursor, unsigned char *classes) {
  size_t open[CLI_DEEP], depth = 0;
  bool quoted = false, behind = false; /* behind: whether the cursor is directly after a bracket, whose counterpart is
                                        * marked */
  memset(classes, CLI_SYNTAX_PLAIN, length);
  size_t first = strspn(text, " \t");
  if (first < length && text[first] == ',') { /* a comma at the start of the text: it is a command of the prompt */
    memset(classes + first, CLI_SYNTAX_KEYWORD, strcspn(text + first, " \t\n"));
    return;
  }
  for (size_t at = 0; at < length;) {
    token t = next_token(text, length, at);
    size_t n = t.to - t.from;
    cli_syntax class = CLI_SYNTAX_PLAIN;
    if (t.kind == TOKEN_COMMENT) class = CLI_SYNTAX_COMMENT;
    else if (t.kind == TOKEN_STRING) class = CLI_SYNTAX_STRING;
    else if (t.kind == TOKEN_WORD) class = class_of_word(scheme, text + t.from, n, quoted);
    else if (t.kind == TOKEN_CLOSE && !depth) class = CLI_SYNTAX_FAULT;
    memset(classes + t.from, (int)class, n);
    if (t.kind == TOKEN_OPEN) {
      if (depth < CLI_DEEP) open[depth] = at;
      depth++;
    } else if (t.kind == TOKEN_CLOSE && depth && --depth < CLI_DEEP) {
      bool here = t.to == cursor, there = open[depth] == cursor || t.from == cursor;
      if (here || (there && !behind)) classes[at] = classes[open[depth]] = CLI_SYNTAX_MATCH;
      behind = behind || here;
    }
    quoted = t.kind == TOKEN_QUOTE && text[at] == '\'';
    at = t.to;
  }
}
