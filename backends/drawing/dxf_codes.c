/* Writes the texts of .dxf, and finds its colours and units. */
#include "backends/drawing/dxf_codes.h"

#include <math.h>
#include <stdio.h>

/* ---- texts ---- */

enum { DXF_CHARACTER = 12, DXF_LINE = 250 /* greatest number of bytes of text on a line; a longer text is an MTEXT */ };

/* Writes the character at *text into `as`, as this DXF version spells it: a character outside ASCII becomes \U+ and
 * four hexadecimal digits. Returns the number of bytes; *text moves to the next character. */
static size_t text_character(const char **text, char as[DXF_CHARACTER]) {
  enum { ENOUGH = 16 }; /* number of bytes that suffices for any character */
  char spelled[VS_SPELLED_ROOM + 1];
  uint32_t point = 0xFFFD;
  size_t count = vs_spell_line(text, *text + strnlen(*text, ENOUGH), spelled);
  spelled[count] = '\0';
  vs_character_read(spelled, count, &point);
  bool escape = point == '\\' && (**text == 'U' || **text == 'M') && (*text)[1] == '+';
  int length = escape         ? snprintf(as, DXF_CHARACTER, "\\U+005C")
               : point < 0x80 ? snprintf(as, DXF_CHARACTER, point == '^' ? "^ " : "%c", (int)point)
                              : snprintf(as, DXF_CHARACTER, "\\U+%04X", point < 0x10000 ? (unsigned)point : 0xFFFDu);
  return (size_t)length;
}

bool vs_dxf_text_is_short(const char *text) {
  char as[DXF_CHARACTER];
  size_t bytes = 0;
  while (*text != '\0' && bytes <= DXF_LINE) bytes += text_character(&text, as);
  return bytes <= DXF_LINE;
}

/* Writes as much of *text as fits on a line of the file. *text moves to the first character that is not written. */
static void text_line(vs_writer *w, const char **text) {
  char as[DXF_CHARACTER];
  for (size_t bytes = 0; **text != '\0';) {
    const char *next = *text;
    size_t n = text_character(&next, as);
    bytes += n;
    if (bytes > DXF_LINE) break;
    vs_put(w, as, n);
    *text = next;
  }
  vs_puts(w, "\n");
}

void vs_dxf_text(vs_writer *w, int number, const char *text) {
  vs_putf(w, "%3d\n", number);
  text_line(w, &text);
}

void vs_dxf_long_text(vs_writer *w, const char *text) {
  while (!vs_dxf_text_is_short(text)) {
    vs_putf(w, "%3d\n", 3);
    text_line(w, &text);
  }
  vs_dxf_text(w, 1, text);
}

char *vs_dxf_name(char *name) {
  for (char *at = name; *at; at++)
    if (strchr("<>/\\\":;?*|=,`", *at) || (unsigned char)*at < ' ') *at = '_';
  return name[0] ? name : strcpy(name, "_");
}

/* ---- colours and units ---- */

/* Indices 1 to 9 are pure colours. Indices from 10 on are 24 hues in five shades, each full and pale; indices from 250
 * on are greys. */
int vs_dxf_colour_index(const double rgb[3]) {
  static const double pure[9][3] = { { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 },
                                     { 1, 0, 1 }, { 1, 1, 1 }, { .5, .5, .5 }, { .75, .75, .75 } };
  static const double shades[5] = { 1, 0.65, 0.5, 0.3, 0.15 };
  int best = 7;
  double least = rgb[0] * rgb[0] + rgb[1] * rgb[1] + rgb[2] * rgb[2]; /* index 7 is also black: on white paper it is
                                                                       * drawn black */
  for (int i = 1; i < 256; i++) {
    double c[3];
    for (int k = 0; k < 3; k++) {
      double hue = fmod((i / 10 - 1) * 15 / 60. - 2 * k + 9, 6) - 3; /* distance of the hue from the hue at which colour
                                                                      * component k (red, green or blue) has its full
                                                                      * value */
      double full = fmin(1, fmax(0, 2 - fabs(hue))), shade = shades[i % 10 / 2];
      c[k] = i < 10 ? pure[i - 1][k] : i >= 250 ? 0.2 + 0.16 * (i - 250) : shade * (i % 2 ? (1 + full) / 2 : full);
    }
    double off = (c[0] - rgb[0]) * (c[0] - rgb[0]) + (c[1] - rgb[1]) * (c[1] - rgb[1]) +
                 (c[2] - rgb[2]) * (c[2] - rgb[2]);
    if (off < least - 1e-9) least = off, best = i;
  }
  return best;
}

long vs_dxf_unit(const char *unit) {
  static const struct { const char *unit; long insert; } units[] = { { "m", 6 }, { "mm", 4 }, { "cm", 5 },
      { "in", 1 }, { "ft", 2 } };
  for (size_t i = 0; i < sizeof units / sizeof *units; i++)
    if (strcmp(units[i].unit, unit) == 0) return units[i].insert;
  return 0;
}
