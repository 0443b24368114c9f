/* Adds value and picture of a definition to the text that an editor shows for its name. */
#include "cli/lsp/lsp_pictures.h"

#include <stdlib.h>
#include <string.h>

#include "cli/lsp/lsp_messages.h"
#include "cli/lsp/lsp_runs.h"
#include "cli/lsp/lsp_words.h"

/* SECONDS: the longest run; after a longer one the text has no values until it is saved again. MOST_PICTURE: bytes of
 * the largest picture; MOST_VALUE: bytes of the longest value. */
enum { SECONDS = 3, MOST_PICTURE = 300000, MOST_VALUE = 400 };

/* The program that runs after the text. The control characters 2 and 3 enclose the value in the output. */
static const char program[] =
    "(let ([v %s])\n"
    "  (display \"\\x2;\") (write v) (display \"\\x3;\")\n"
    "  (erase-all)\n"
    "  (if (or (object? v) (and (pair? v) (list? v) (andmap object? v))) (draw v))\n"
    "  (view \"hover\" 'isometric #:sheet 'none))";

/* Writes the bytes as base64. */
static void put_base64(FILE *to, const char *at, size_t n) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const unsigned char *b = (const unsigned char *)at;
  for (size_t i = 0; i < n; i += 3) {
    uint32_t v = (uint32_t)b[i] << 16 | (i + 1 < n ? (uint32_t)b[i + 1] << 8 : 0) | (i + 2 < n ? b[i + 2] : 0);
    fputc(digits[v >> 18], to), fputc(digits[v >> 12 & 63], to);
    fputc(i + 1 < n ? digits[v >> 6 & 63] : '=', to), fputc(i + 2 < n ? digits[v & 63] : '=', to);
  }
}

/* Paper for editors with dark colours, and lines of one pixel at any size of the object. */
static const char look[] = "<style>*{vector-effect:non-scaling-stroke;stroke-width:1px}</style>"
                           "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>";

/* Writes the picture as a data address. Its root gets a width in pixels in place of the object's true size. */
static void put_picture(FILE *to, const char *svg, size_t length) {
  const char *root = strstr(svg, "<svg "), *box = root ? strstr(root, " viewBox=") : NULL;
  const char *size_from = root ? strstr(root, " width=") : NULL;
  char *text = NULL;
  size_t size = 0;
  const char *body = box ? strchr(box, '>') : NULL;
  bool fits = body && size_from && size_from < box && length < MOST_PICTURE;
  FILE *whole = fits ? open_memstream(&text, &size) : NULL;
  if (!whole) return;
  fprintf(whole, "%.*s width=\"320\" height=\"240\"", (int)(size_from - root), root);
  fprintf(whole, "%.*s%s", (int)(body + 1 - box), box, look);
  fwrite(body + 1, 1, length - (size_t)(body + 1 - svg), whole);
  if (fclose(whole) == 0) {
    fputs("\n\n![picture](data:image/svg+xml;base64,", to);
    put_base64(to, text, size);
    fputc(')', to);
  }
  free(text);
}

static void put_value(FILE *to, const char *said) {
  const char *from = strchr(said, 2), *end = from ? strchr(from, 3) : NULL;
  if (!end) return;
  size_t n = (size_t)(end - ++from), most = n > MOST_VALUE ? MOST_VALUE : n;
  while (most < n && most && ((unsigned char)from[most] & 0xC0) == 0x80) most--;
  fprintf(to, "\n\n```scheme\n%.*s%s\n```", (int)most, from, most < n ? " ..." : "");
}

static void answer(lsp_server *s, const lsp_run *r, bool whole) {
  lsp_document *d = lsp_find_uri(s, r->uri);
  char *text = NULL;
  size_t length = 0;
  FILE *to = open_memstream(&text, &length);
  if (d) d->slow |= !whole;
  if (to) {
    const char *svg = strstr(r->said, "<?xml"), *end = svg ? strstr(svg, "</svg>") : NULL;
    fputs(r->text, to);
    put_value(to, r->said);
    if (end) put_picture(to, svg, (size_t)(end - svg) + 6);
    fclose(to);
  }
  lsp_message m;
  if (lsp_message_begin(&m)) {
    fprintf(m.to, "\"id\":%s,\"result\":{\"contents\":{\"kind\":\"markdown\",\"value\":", r->id);
    lsp_put(m.to, text ? text : r->text);
    fprintf(m.to, "},%s}", r->range);
    lsp_message_send(&m);
  }
  free(text);
}

/* Returns the node's range as JSON; the caller frees it. Returns NULL when memory is out. */
static char *range_text(const knowledge *k, know_index node) {
  char *text = NULL;
  size_t length = 0;
  FILE *to = open_memstream(&text, &length);
  if (!to) return NULL;
  lsp_put_node_range(to, "range", k, node);
  fclose(to);
  return text;
}

static char *id_text(const lsp_server *s) {
  char *text = NULL;
  size_t length = 0;
  FILE *to = open_memstream(&text, &length);
  if (!to) return NULL;
  cli_data_echo(&s->json, s->id, to);
  fclose(to);
  return text;
}

bool lsp_picture_start(lsp_server *s, lsp_document *d, know_index node, const char *text) {
  const knowledge *k = &d->draft->k;
  const know_symbol *y = &k->symbols[know_at(k, node)->symbol];
  bool ours = y->definition && !y->made && y->kind != KNOW_FUNCTION && y->kind != KNOW_MACRO &&
              k->scopes[y->scope].kind == KNOW_SCOPE_PROGRAM;
  if (!s->pictures || !ours || !d->saved || d->slow || *d->path != '/' || strlen(y->text) > 200) return false;
  char expression[sizeof program + 200], seconds[20];
  snprintf(expression, sizeof expression, program, y->text);
  snprintf(seconds, sizeof seconds, "%d", SECONDS);
  const char *words[] = {
    "vs", "-q",       "--limit-time", seconds, "--limit-memory", "1024", strrchr(d->path, '/') + 1,
    "-e", expression, "--view",       "hover", "--format",       "svg",  "-o",
    "-",  NULL
  };
  lsp_run r = { .done = answer, .id = id_text(s), .text = strdup(text), .range = range_text(k, node) };
  return lsp_run_start(s, &r, d, words, SECONDS + 1);
}
