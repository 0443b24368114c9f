/* Fuzzes passes, kernel and formats: the bytes describe a tree of shapes and operations. The first byte selects the
 * format. */
#include "tests/fuzz/fuzz.h"

enum { ROOM = 1 << 14, DEPTH = 6 };
typedef struct { const uint8_t *at, *end; char text[ROOM]; size_t used; } recipe;

static unsigned next(recipe *r) { return r->at < r->end ? *r->at++ : 0; }
static void say(recipe *r, const char *text) {
  size_t n = strlen(text);
  if (r->used + n < ROOM) memcpy(r->text + r->used, text, n + 1), r->used += n;
}
static void number(recipe *r) { /* chooses mostly numbers on a small grid, so that shapes overlap and touch */
  static const char *const odd[] = { "0", "1e-9", "-1e-9", "1e9", "1/3", "0.1", "1e300", "-0.0" };
  char text[40];
  unsigned k = next(r);
  if (k >= 248) snprintf(text, sizeof text, " %s", odd[k - 248]);
  else snprintf(text, sizeof text, " %g", ((int)k - 100) / 20.);
  say(r, text);
}
static void point(recipe *r) { say(r, " (xyz"), number(r), number(r), number(r), say(r, ")"); }

static void shape(recipe *r, int depth) {
  static const struct { const char *name; int points, numbers; } solids[] = {
    { "make-box", 2, 0 }, { "make-sphere", 1, 1 }, { "make-cylinder", 1, 2 }, { "make-cone", 2, 1 }, { "make-cut-cone", 1, 1 }, { "make-torus", 1, 2 }, { "make-wedge", 2, 0 },
    { "make-circle", 1, 1 }, { "make-rectangle", 2, 0 }, { "make-line", 3, 0 }, { "make-polygon", 4, 0 }, { "make-spline", 4, 0 }, { "make-3dface", 4, 0 }, { "make-superellipsoid", 0, 3 },
    { "make-donut", 1, 2 }, { "make-arc", 1, 3 }, { "make-ellipse", 1, 2 },
  };
  static const char *const operations[] = { "unite", "subtract", "intersect", "hull" };
  static const char *const wraps[] = { "(do-move X (vxyz 1 0.5 0))", "(do-rotate X 'z 0.3)", "(do-scale X 0.5)", "(do-mirror X 'yz)", "(do-slice X 'xy)", "(with-material 'copper X)", "(layer \"]]><\\\"\" X)",
                                       "(do-extrude X 1)", "(do-revolve X 'y)", "(do-offset X 0.1)", "(do-thicken X 0.2)", "(do-section X 'xy)", "(do-edges X)", "(ghost X)", "(highlight X)", "(do-project X 'xy)" };
  unsigned k = next(r);
  if (depth >= DEPTH || k < 120) {
    const unsigned i = k % (sizeof solids / sizeof *solids);
    say(r, "("), say(r, solids[i].name);
    for (int p = 0; p < solids[i].points; p++) point(r);
    for (int n = 0; n < solids[i].numbers; n++) number(r);
    if (!strcmp(solids[i].name, "make-cut-cone")) point(r), number(r);
    say(r, ")");
  } else if (k < 190) {
    say(r, "("), say(r, operations[k % 4]);
    for (unsigned n = 2 + next(r) % 3; n; n--) say(r, " "), shape(r, depth + 1);
    say(r, ")");
  } else {
    const char *wrap = wraps[k % (sizeof wraps / sizeof *wraps)], *hole = strchr(wrap, 'X');
    char before[80];
    snprintf(before, sizeof before, "%.*s", (int)(hole - wrap), wrap);
    say(r, before), shape(r, depth + 1), say(r, hole + 1);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static fuzz_file none;
  static recipe r;
  size_t formats;
  const vs_format_info *format = vs_format_list(&formats);
  if (size < 2) return 0;
  format += data[0] % formats;
  if (format->worker) return 0;
  r = (recipe){ .at = data + 1, .end = data + size };
  for (int n = 0; n < 3 && r.at < r.end; n++) say(&r, "(guard (e (#t 0)) (draw "), shape(&r, 0), say(&r, "))\n");
  vs_scheme *s = fuzz_interpreter(&none, data, size, 50, NULL);
  vs_output_options o = vs_output_options_default();
  o.segments = 5;
  vs_drawing_clear(s);
  vs_eval_text(s, "fuzz", 1, r.text, r.used, 0);
  vs_write_drawing_to(s, format->name, &o, fuzz_drop_bytes, NULL);
  return 0;
}
