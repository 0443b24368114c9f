/* Implements the prompt's command ,show: draws a picture of the drawing on the terminal. The coloured triangles come
 * from the PLY writer. A small rasteriser with a depth buffer draws them in parallel projection from the upper front
 * left.
 *
 * A terminal with the protocol of sixel, kitty or iTerm shows pixels. On other terminals, each character is the upper
 * half block in 24-bit colours, and shows two pixels. */
#include "cli/prompt/show.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/prompt/editor.h"
#include "cli/prompt/prompt.h"

typedef struct { char *at; size_t length, room; bool failed; } bytes;

static bool take(void *context, const void *more, size_t count) {
  bytes *b = context;
  if (b->room - b->length < count) {
    size_t room = (b->length + count) * 2;
    char *grown = realloc(b->at, room);
    if (!grown) return !(b->failed = true);
    b->at = grown, b->room = room;
  }
  memcpy(b->at + b->length, more, count);
  b->length += count;
  return true;
}

/* ---- reading the mesh: little-endian PLY as the library writes it ---- */

typedef struct { size_t vertices, faces, vertex_bytes; bool wide; const unsigned char *body;
    const unsigned char *end; } ply;

static bool read_ply(const bytes *b, ply *p) {
  static const char stop[] = "end_header\n";
  const char *at = b->at, *end = b->at + b->length;
  bool in_vertex = false;
  *p = (ply){.end = (const unsigned char *)end};
  while (at < end) {
    const char *next = memchr(at, '\n', (size_t)(end - at));
    if (!next) return false;
    next++;
    char line[200];
    size_t n = (size_t)(next - at) < sizeof line ? (size_t)(next - at) : sizeof line - 1;
    memcpy(line, at, n);
    line[n] = 0;
    if (!strcmp(line, stop)) return p->body = (const unsigned char *)next, p->vertex_bytes > 0;
    if (sscanf(line, "element vertex %zu", &p->vertices) == 1) in_vertex = true;
    else if (sscanf(line, "element face %zu", &p->faces) == 1) in_vertex = false;
    else if (in_vertex && !strncmp(line, "property double", 15)) p->vertex_bytes += 8, p->wide = true;
    else if (in_vertex && !strncmp(line, "property float", 14)) p->vertex_bytes += 4;
    else if (in_vertex && !strncmp(line, "property uchar", 14)) p->vertex_bytes += 1;
    at = next;
  }
  return false;
}

static double number_at(const unsigned char *at, bool wide) {
  double d;
  float f;
  if (wide) return memcpy(&d, at, sizeof d), d;
  memcpy(&f, at, sizeof f);
  return (double)f;
}

static uint32_t index_at(const unsigned char *at) {
  uint32_t i;
  return memcpy(&i, at, sizeof i), i;
}

/* ---- drawing the picture ---- */

typedef struct { int width, height; float *depth; unsigned char *rgb; } picture;
typedef struct { double x, y, z; } vec;

static vec corner(const ply *p, uint32_t i) {
  const unsigned char *at = p->body + (size_t)i * p->vertex_bytes;
  size_t step = p->wide ? 8 : 4;
  return (vec){number_at(at, p->wide), number_at(at + step, p->wide), number_at(at + 2 * step, p->wide)};
}

/* Projects the point v in parallel: x to the right, y upwards, z towards the eye, which is at the upper front left. */
static vec seen(vec v) {
  /* c, s: cosine and sine of a rotation by 30 degrees about Z; ct, st: of a tilt by 30 degrees */
  const double c = .8660254037844387, s = .5, ct = .8660254037844386, st = .5;
  double x = c * v.x - s * v.y, y = s * v.x + c * v.y;
  return (vec){x, st * y + ct * v.z, ct * -y + st * v.z};
}

static void fill(picture *p, const vec t[3], const unsigned char rgb[3]) {
  vec u = {t[1].x - t[0].x, t[1].y - t[0].y, t[1].z - t[0].z}, v = {t[2].x - t[0].x, t[2].y - t[0].y, t[2].z - t[0].z};
  vec n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z), area = n.z;
  if (!(length > 0) || fabs(area) < 1e-12) return;
  double facing = n.z < 0 ? -1 : 1;
  double light = .3 + .7 * fmax(0, facing * (-.35 * n.x + .6 * n.y + .72 * n.z) / length);
  int x0 = (int)floor(fmax(0, fmin(t[0].x, fmin(t[1].x, t[2].x)))), x1 =
      (int)ceil(fmin(p->width - 1, fmax(t[0].x, fmax(t[1].x, t[2].x))));
  int y0 = (int)floor(fmax(0, fmin(t[0].y, fmin(t[1].y, t[2].y)))), y1 =
      (int)ceil(fmin(p->height - 1, fmax(t[0].y, fmax(t[1].y, t[2].y))));
  for (int y = y0; y <= y1; y++)
    for (int x = x0; x <= x1; x++) {
      double px = x + .5 - t[0].x, py = y + .5 - t[0].y;
      double b = (px * v.y - py * v.x) / area, c = (py * u.x - px * u.y) / area;
      if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9) continue;
      float z = (float)(t[0].z + b * u.z + c * v.z);
      size_t at = (size_t)y * (size_t)p->width + (size_t)x;
      if (z <= p->depth[at]) continue;
      p->depth[at] = z;
      for (int k = 0; k < 3; k++) p->rgb[3 * at + (size_t)k] = (unsigned char)(light * rgb[k]);
    }
}

enum { FACE = 17 }; /* FACE: size of a face in bytes: a count, three corners, red, green, blue and opacity */

/* Draws the mesh. Returns false if memory is out or nothing is visible. */
static bool draw(const ply *m, int width, int height, picture *p) {
  size_t pixels = (size_t)width * (size_t)height;
  *p = (picture){width, height, malloc(pixels * sizeof(float)), calloc(pixels, 3)};
  if (!p->depth || !p->rgb) return false;
  for (size_t i = 0; i < pixels; i++) p->depth[i] = -INFINITY;
  vec low = {INFINITY, INFINITY, 0}, high = {-INFINITY, -INFINITY, 0};
  for (size_t i = 0; i < m->vertices; i++) {
    vec s = seen(corner(m, (uint32_t)i));
    low.x = fmin(low.x, s.x), low.y = fmin(low.y, s.y), high.x = fmax(high.x, s.x), high.y = fmax(high.y, s.y);
  }
  if (!(high.x >= low.x)) return false;
  double scale = fmin((width - 2) / fmax(high.x - low.x, 1e-12), (height - 2) / fmax(high.y - low.y, 1e-12));
  double dx = (width - scale * (high.x + low.x)) / 2, dy = (height + scale * (high.y + low.y)) / 2;
  const unsigned char *face = m->body + m->vertices * m->vertex_bytes;
  for (size_t i = 0; i < m->faces && face + FACE <= m->end; i++) {
    vec t[3];
    bool fits = face[0] == 3;
    for (int k = 0; fits && k < 3; k++) {
      uint32_t c = index_at(face + 1 + 4 * k);
      if (c >= m->vertices) return false;
      vec s = seen(corner(m, c));
      t[k] = (vec){dx + scale * s.x, dy - scale * s.y, scale * s.z};
    }
    vec swap = t[1]; /* exchanges two corners, because y points downwards in the picture, which reverses their order */
    t[1] = t[2], t[2] = swap;
    if (fits) fill(p, t, face + 13);
    face += FACE;
  }
  return true;
}

/* ---- showing the picture ---- */

static bool inked(const picture *p, int x, int y) { return x < p->width && y < p->height &&
    isfinite(p->depth[(size_t)y * (size_t)p->width + (size_t)x]); }
static const unsigned char *pixel(const picture *p, int x,
    int y) { return p->rgb + 3 * ((size_t)y * (size_t)p->width + (size_t)x); }

static void show_blocks(const picture *p) {
  for (int y = 0; y < p->height; y += 2) {
    int last = p->width - 1;
    while (last >= 0 && !inked(p, last, y) && !inked(p, last, y + 1)) last--;
    for (int x = 0; x <= last; x++) {
      bool up = inked(p, x, y), down = inked(p, x, y + 1);
      const unsigned char *a = up ? pixel(p, x, y) : NULL, *b = down ? pixel(p, x, y + 1) : NULL;
      if (a && b) printf("\033[38;2;%d;%d;%d;48;2;%d;%d;%dm\u2580", a[0], a[1], a[2], b[0], b[1], b[2]);
      else if (a) printf("\033[0;38;2;%d;%d;%dm\u2580", a[0], a[1], a[2]);
      else if (b) printf("\033[0;38;2;%d;%d;%dm\u2584", b[0], b[1], b[2]);
      else fputs("\033[0m ", stdout);
    }
    fputs("\033[0m\n", stdout);
  }
}

/* Shows the brightness of pixels without colours. Each character represents two pixels, an upper and a lower one. */
static void show_characters(const picture *p) {
  static const char ramp[] = " .:-=+*#%@";
  for (int y = 0; y < p->height; y += 2) {
    int last = p->width - 1;
    while (last >= 0 && !inked(p, last, y) && !inked(p, last, y + 1)) last--;
    for (int x = 0; x <= last; x++) {
      int sum = 0, n = 0;
      for (int k = 0; k < 2; k++)
        if (inked(p, x, y + k)) sum += pixel(p, x, y + k)[0] + pixel(p, x, y + k)[1] + pixel(p, x, y + k)[2], n++;
      putchar(n ? ramp[1 + sum * 8 / (n * 765)] : ' ');
    }
    putchar('\n');
  }
}

static void base64(const unsigned char *at, size_t n) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < n; i += 3) {
    uint32_t v = (uint32_t)at[i] << 16 | (i + 1 < n ? (uint32_t)at[i + 1] << 8 : 0) | (i + 2 < n ? at[i + 2] : 0);
    putchar(digits[v >> 18]), putchar(digits[v >> 12 & 63]);
    putchar(i + 1 < n ? digits[v >> 6 & 63] : '='), putchar(i + 2 < n ? digits[v & 63] : '=');
  }
}

/* Sends the pixels with opacity to the terminal by kitty's protocol, in pieces of 3072 bytes. */
static void show_kitty(const picture *p) {
  enum { PIECE = 3072 };
  size_t pixels = (size_t)p->width * (size_t)p->height, n = 4 * pixels;
  unsigned char *rgba = malloc(n);
  if (!rgba) return;
  for (size_t i = 0; i < pixels; i++) memcpy(rgba + 4 * i, p->rgb + 3 * i, 3), rgba[4 * i + 3] =
      isfinite(p->depth[i]) ? 255 : 0;
  for (size_t at = 0; at < n; at += PIECE) {
    size_t size = n - at < PIECE ? n - at : PIECE;
    if (at == 0) printf("\033_Ga=T,f=32,s=%d,v=%d,m=%d;", p->width, p->height, at + size < n);
    else printf("\033_Gm=%d;", at + size < n);
    base64(rgba + at, size);
    fputs("\033\\", stdout);
  }
  putchar('\n');
  free(rgba);
}

/* Sends the picture to the terminal by iTerm's protocol, which transfers files: a portable pixmap. */
static void show_iterm(const picture *p) {
  size_t pixels = (size_t)p->width * (size_t)p->height, head;
  unsigned char *file = malloc(3 * pixels + 40);
  if (!file) return;
  head = (size_t)snprintf((char *)file, 40, "P6\n%d %d\n255\n", p->width, p->height);
  for (size_t i = 0; i < pixels; i++)
    for (size_t k = 0; k < 3; k++) file[head + 3 * i + k] = isfinite(p->depth[i]) ? p->rgb[3 * i + k] : 255;
  printf("\033]1337;File=inline=1;size=%zu:", head + 3 * pixels);
  base64(file, head + 3 * pixels);
  fputs("\a\n", stdout);
  free(file);
}

/* Returns the index of a colour among the 216 colours of sixels: 6 levels each of red, green and blue. */
static int cube(const unsigned char *c) {
  return (c[0] * 5 + 127) / 255 * 36 + (c[1] * 5 + 127) / 255 * 6 + (c[2] * 5 + 127) / 255;
}
static void show_sixel(const picture *p) {
  printf("\033P0;1q\"1;1;%d;%d", p->width, p->height);
  for (int i = 0; i < 216; i++) printf("#%d;2;%d;%d;%d", i, i / 36 * 20, i / 6 % 6 * 20, i % 6 * 20);
  for (int y = 0; y < p->height; y += 6) {
    bool used[216] = {false};
    for (int x = 0; x < p->width; x++)
      for (int k = 0; k < 6; k++)
        if (inked(p, x, y + k)) used[cube(pixel(p, x, y + k))] = true;
    for (int c = 0; c < 216; c++) {
      if (!used[c]) continue;
      printf("#%d", c);
      for (int x = 0, run = 1; x < p->width; x += run) {
        int bits = 0;
        for (int k = 0; k < 6; k++)
          if (inked(p, x, y + k) && cube(pixel(p, x, y + k)) == c) bits |= 1 << k;
        for (run = 1; x + run < p->width; run++) {
          int next = 0;
          for (int k = 0; k < 6; k++)
            if (inked(p, x + run, y + k) && cube(pixel(p, x + run, y + k)) == c) next |= 1 << k;
          if (next != bits) break;
        }
        if (run > 3) printf("!%d%c", run, 63 + bits);
        else for (int k = 0; k < run; k++) putchar(63 + bits);
      }
      putchar('$');
    }
    putchar('-');
  }
  fputs("\033\\\n", stdout);
}

/* ---- choosing the protocol ---- */

typedef enum { SHOW_BLOCKS, SHOW_KITTY, SHOW_ITERM, SHOW_SIXEL, SHOW_CHARACTERS } way;

/* Chooses the protocol by environment variables that describe the terminal. The variable VS_SHOW has precedence: kitty,
 * iterm, sixel, blocks or characters. */
static way best_way(void) {
  static const char *const names[] = {"blocks", "kitty", "iterm", "sixel", "characters"};
  const char *wanted = getenv("VS_SHOW"), *term = getenv("TERM"), *program = getenv("TERM_PROGRAM");
  for (int i = 0; wanted && i < 5; i++)
    if (!strcmp(wanted, names[i])) return (way)i;
  if (!isatty(STDOUT_FILENO) || !cli_colours(STDOUT_FILENO)) return SHOW_CHARACTERS;
  bool inside = getenv("TMUX") || (term && !strncmp(term, "screen", 6)); /* within tmux and screen, the other
                                                                          * environment variables may describe another
                                                                          * terminal */
  if (!inside && (getenv("KITTY_WINDOW_ID") || (term && strstr(term, "kitty")) || (program &&
      !strcmp(program, "ghostty")))) return SHOW_KITTY;
  if (!inside && program && (!strcmp(program, "iTerm.app") || !strcmp(program, "WezTerm"))) return SHOW_ITERM;
  if (!inside && term && (strstr(term, "sixel") || strstr(term, "mlterm") || strstr(term, "foot") || strstr(term,
      "contour"))) return SHOW_SIXEL;
  return SHOW_BLOCKS;
}

void cli_show(cli_session *c, const char *size) {
  bytes file = {0};
  ply mesh;
  picture p = {0};
  struct winsize screen = {0};
  int width = 0, height = 0;
  way how = best_way();
  bool cells = how == SHOW_BLOCKS || how == SHOW_CHARACTERS;
  ioctl(STDOUT_FILENO, TIOCGWINSZ, &screen);
  if (sscanf(size, "%dx%d", &width, &height) != 2 || width < 4 || height < 2 || width > 1000 || height > 1000) {
    width = screen.ws_col > 8 ? screen.ws_col - 1 : 79, height = screen.ws_row > 8 ? screen.ws_row - 3 : 21;
    if (width > 120) width = 120;
    if (height > 40) height = 40;
  }
  vs_output_options options = c->options->output;
  vs_outcome outcome = vs_write_drawing_to(c->scheme, "ply", &options, take, &file);
  cli_report_settle(&c->reporter);
  if (outcome == VS_OUTCOME_DONE && !file.failed && read_ply(&file, &mesh) && draw(&mesh, cells ? width : width * 8,
      cells ? height * 2 : height * 16, &p)) {
    if (how == SHOW_BLOCKS) show_blocks(&p);
    else if (how == SHOW_KITTY) show_kitty(&p);
    else if (how == SHOW_ITERM) show_iterm(&p);
    else if (how == SHOW_SIXEL) show_sixel(&p);
    else show_characters(&p);
  } else if (outcome == VS_OUTCOME_DONE) {
    fputs("; there is nothing solid to show\n", stderr);
  }
  free(p.depth);
  free(p.rgb);
  free(file.at);
}
