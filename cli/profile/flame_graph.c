/* Draws a tree of calls as a flame graph. */
#include "cli/profile/flame_graph.h"

#include <stdlib.h>
#include <string.h>

#include "languages/analysis/notation.h"
#include "model/store/array.h"

/* Sizes in units of the picture. A bar narrower than LEAST is not drawn. */
enum { WIDTH = 1200, LEVEL = 18, MARGIN = 10, HEAD = 40, LETTER = 7 };
static const double LEAST = 0.3;

typedef struct { double x, used; uint32_t level; } bar;

/* Sets x and level of each call: next to the calls before it that have the same caller. Returns the number of levels
 * that are drawn. */
static uint32_t place_bars(const profile_tree *t, bar *bars, double scale) {
  double top = 0; /* sum of the widths so far of the calls that have no caller */
  uint32_t levels = 0;
  for (size_t i = 0; i < t->count; i++) {
    size_t caller = t->calls[i].caller;
    double width = t->whole[i] * scale, *used = caller ? &bars[caller - 1].used : &top;
    bars[i].x = (caller ? bars[caller - 1].x : 0) + *used;
    bars[i].level = caller ? bars[caller - 1].level + 1 : 0;
    *used += width;
    if (width >= LEAST && bars[i].level + 1 > levels) levels = bars[i].level + 1;
  }
  return levels;
}

/* Returns a hue in degrees, the same for all calls at a line. */
static unsigned hue_of(const vs_profile_call_info *c) {
  unsigned hash = c->at.line * 2654435761u;
  for (const char *p = c->procedure; *p; p++) hash = (hash ^ (unsigned char)*p) * 16777619u;
  return (hash >> 8) % 60;
}

static void put(FILE *to, const char *text, size_t length) { know_xml_text(to, text, length); }

static const char *name_of(const vs_profile_call_info *c) { return *c->procedure ? c->procedure : "top level"; }

/* Returns the bytes of the first characters of the text, at most `most`. */
static size_t cut(const char *text, size_t most) {
  size_t n = 0, characters = 0;
  for (; text[n]; n++) {
    if ((text[n] & 0xC0) == 0x80) continue;
    if (characters++ == most) return n;
  }
  return n;
}

static void put_bar(const profile_tree *t, size_t i, const bar *b, double width, FILE *to) {
  const vs_profile_call_info *c = &t->calls[i];
  const char *name = name_of(c), *file = c->at.file ? c->at.file : "";
  char text[300];
  fputs("<g><title>", to);
  put(to, name, strlen(name));
  fputs(", ", to);
  put(to, file, strlen(file));
  fprintf(to, ":%u, %.3g s, %.1f %%</title><rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%d\" ",
          (unsigned)c->at.line, t->whole[i], 100 * t->whole[i] / t->seconds, MARGIN + b->x, b->used, width, LEVEL - 1);
  fprintf(to, "fill=\"hsl(%u,75%%,62%%)\"/>", hue_of(c));
  snprintf(text, sizeof text, "%.200s:%u", name, (unsigned)c->at.line);
  size_t most = (size_t)(width / LETTER), n = cut(text, most);
  if (most > 2) {
    fprintf(to, "<text x=\"%.2f\" y=\"%.2f\">", MARGIN + b->x + 3, b->used + LEVEL - 5);
    put(to, text, n);
    fputs("</text>", to);
  }
  fputs("</g>\n", to);
}

bool profile_write_flames(const profile_tree *t, const char *title, FILE *to) {
  bar *bars = vs_zeros(t->count + 1, sizeof *bars);
  if (!bars) return false;
  double scale = t->seconds > 0 ? (WIDTH - 2 * MARGIN) / t->seconds : 0;
  uint32_t levels = place_bars(t, bars, scale), height = HEAD + levels * LEVEL + MARGIN;
  fprintf(to, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%u\" viewBox=\"0 0 %d %u\" "
              "font-family=\"monospace\" font-size=\"11\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
          WIDTH, (unsigned)height, WIDTH, (unsigned)height);
  fprintf(to, "<text x=\"%d\" y=\"20\" font-size=\"14\">", MARGIN);
  put(to, title, strlen(title));
  fprintf(to, ": %.3g s, %zu samples</text>\n", t->seconds, t->looks);
  for (size_t i = 0; i < t->count; i++) {
    double width = t->whole[i] * scale;
    bars[i].used = HEAD + (double)(levels - 1 - bars[i].level) * LEVEL; /* first the width of the bar that is used by
                                                                         * calls; from here on the bar's upper edge */
    if (width >= LEAST) put_bar(t, i, &bars[i], width, to);
  }
  fputs("</svg>\n", to);
  free(bars);
  return true;
}
