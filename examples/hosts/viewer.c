/* A viewer in SDL2 and OpenGL: a host of visualscheme.h that shows a model's scene, with one buffer of the graphics
 * card for each distinct mesh. The left button drags gizmos, picks the object under it, or turns the view; the wheel
 * zooms. The viewer runs the program's actions in each frame. If frames take long, it draws round shapes coarser.
 *
 *   cc viewer.c -o viewer -lvisualscheme -lSDL2 -lGL -lm
 *   ./viewer model.vs               shows the model
 *   ./viewer model.vs --test FILE   plays the lines of FILE as a user: see play() */
#define GL_GLEXT_PROTOTYPES
#include <SDL2/SDL.h>
#include <SDL2/SDL_opengl.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <visualscheme.h>

enum { WIDTH = 800, HEIGHT = 600, MOST_GIZMOS = 64 };
static const double HALF_ANGLE = 0.35; /* half of the vertical field of view, in radians */
static const double PI = 3.14159265358979;

typedef struct { float point[3], normal[3]; unsigned char color[4]; } vertex;

typedef struct {
  uint64_t id;
  GLuint buffer;
  GLsizei count;      /* number of vertices */
  bool curve;
  double (*places)[16]; /* matrices column by column, as OpenGL expects */
  size_t place_count;
} shape;

typedef struct {
  vs_scheme *scheme;
  SDL_Window *window;
  shape *shapes;
  size_t shape_count, shape_room;
  vs_gizmo gizmos[MOST_GIZMOS];
  size_t gizmo_count;
  double centre[3], distance, turn, height; /* camera: the point around which it rotates, its distance from this point,
                                             * its angles in radians */
  bool holds, turns;  /* action of the left button while it is pressed: drags a gizmo, or rotates the view */
  int x, y;           /* last position of the mouse in pixels */
  char said[400];     /* last message, so that it is not repeated in every frame */
} viewer;

static void diagnose(void *context, const vs_diagnostic *d) {
  viewer *v = context;
  if (strncmp(v->said, d->message, sizeof v->said - 1) == 0) return;
  snprintf(v->said, sizeof v->said, "%s", d->message);
  fprintf(stderr, "%s:%u:%u: %s\n", d->at.file ? d->at.file : "", d->at.line, d->at.column, d->message);
}

static bool print(void *context, const char *text, size_t length) {
  (void)context;
  return fwrite(text, 1, length, stdout) == length;
}

static void *grown(void *old, size_t bytes) {
  void *p = realloc(old, bytes ? bytes : 1);
  if (!p) fputs("out of memory\n", stderr), exit(4);
  return p;
}

/* ---- meshes: a buffer for each, and its places ---- */

static shape *shape_of(viewer *v, uint64_t id) {
  for (size_t i = 0; i < v->shape_count; i++)
    if (v->shapes[i].id == id) return &v->shapes[i];
  if (v->shape_count == v->shape_room)
    v->shapes = grown(v->shapes, (v->shape_room = 2 * v->shape_room + 16) * sizeof *v->shapes);
  v->shapes[v->shape_count] = (shape){ .id = id };
  return &v->shapes[v->shape_count++];
}

static void fill(vertex *to, const double point[3], const double normal[3], const vs_mesh_part *part) {
  for (int k = 0; k < 3; k++) to->point[k] = (float)point[k], to->normal[k] = (float)normal[k];
  for (int k = 0; k < 4; k++) to->color[k] = (unsigned char)lrint(255 * part->color[k]);
}

static void upload(shape *to, const vs_mesh_info *m) {
  static const double none[3] = { 0, 0, 1 };
  size_t count = m->triangle_count ? 3 * m->triangle_count : m->point_count;
  vertex *all = grown(NULL, count * sizeof *all);
  for (size_t i = 0; i < m->triangle_count; i++)
    for (int k = 0; k < 3; k++)
      fill(&all[3 * i + (size_t)k], m->points[m->corners[i][k]], m->normals[m->normal_corners[i][k]],
           &m->parts[m->part_of ? m->part_of[i] : 0]);
  if (!m->triangle_count)
    for (size_t i = 0; i < count; i++) fill(&all[i], m->points[i], none, &m->parts[0]);
  glGenBuffers(1, &to->buffer);
  glBindBuffer(GL_ARRAY_BUFFER, to->buffer);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *all), all, GL_STATIC_DRAW);
  to->count = (GLsizei)count, to->curve = m->triangle_count == 0;
  free(all);
}

static void place(shape *to, const vs_mesh_info *m) {
  to->places = grown(to->places, m->place_count * sizeof *to->places);
  to->place_count = m->place_count;
  for (size_t i = 0; i < m->place_count; i++)
    for (int row = 0; row < 4; row++)
      for (int column = 0; column < 4; column++)
        to->places[i][4 * column + row] = row < 3 ? m->places[i][row][column] : column == 3;
}

static bool take_gizmo(void *context, vs_scheme *s, const vs_gizmo *gizmo) {
  viewer *v = context;
  (void)s;
  v->gizmos[v->gizmo_count++] = *gizmo;
  return v->gizmo_count < MOST_GIZMOS;
}

/* Returns the number of facets in a full turn, for the quality that the times of the last frames allow. Returns 0 if
 * the tolerance determines the number. There are few levels of quality, because each change of level meshes all round
 * shapes again. */
static int facets(viewer *v) {
  vs_handle controller = vs_scene_controller(v->scheme), value = 0;
  double quality = 1;
  if (vs_property_get(v->scheme, controller, "quality", &value) == VS_OUTCOME_DONE)
    vs_handle_get_numbers(v->scheme, value, &quality, 1);
  vs_handle_release(v->scheme, value);
  vs_handle_release(v->scheme, controller);
  return quality > 0.6 ? 0 : quality > 0.3 ? 16 : 8;
}

/* Receives the meshes that have changed since the last call. */
static void update(viewer *v) {
  vs_mesh_info m;
  vs_output_options o = vs_output_options_default();
  o.segments = facets(v);
  vs_meshes_begin(v->scheme, &o);
  while (vs_mesh_next(v->scheme, &m)) {
    shape *to = shape_of(v, m.id);
    if (m.change == VS_MESH_REMOVED) {
      glDeleteBuffers(1, &to->buffer);
      free(to->places);
      *to = v->shapes[--v->shape_count];
      continue;
    }
    if (m.change == VS_MESH_ADDED) upload(to, &m);
    place(to, &m);
  }
  v->gizmo_count = 0;
  vs_gizmos(v->scheme, take_gizmo, v);
}

/* ---- the camera ---- */

/* Computes the camera's position and its unit vectors to the right, up and forward. */
static void camera(const viewer *v, double eye[3], double axes[3][3]) {
  double ct = cos(v->turn), st = sin(v->turn), ch = cos(v->height), sh = sin(v->height);
  const double forward[] = { -ct * ch, -st * ch, -sh }, right[] = { -st, ct, 0 }, up[] = { -ct * sh, -st * sh, ch };
  for (int k = 0; k < 3; k++) {
    axes[0][k] = right[k], axes[1][k] = up[k], axes[2][k] = forward[k];
    eye[k] = v->centre[k] - v->distance * forward[k];
  }
}

static void ray(const viewer *v, int x, int y, double eye[3], double way[3]) {
  double axes[3][3], t = tan(HALF_ANGLE);
  camera(v, eye, axes);
  double right = (2 * (x + 0.5) / WIDTH - 1) * t * WIDTH / HEIGHT, up = (1 - 2 * (y + 0.5) / HEIGHT) * t;
  for (int k = 0; k < 3; k++) way[k] = axes[2][k] + right * axes[0][k] + up * axes[1][k];
}

/* Computes the position of point p in the window, in pixels. */
static void project(const viewer *v, const double p[3], int *x, int *y) {
  double eye[3], axes[3][3], q[3] = { 0, 0, 0 }, t = tan(HALF_ANGLE);
  camera(v, eye, axes);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) q[i] += axes[i][k] * (p[k] - eye[k]);
  *x = (int)((q[0] / (q[2] * t * WIDTH / HEIGHT) + 1) / 2 * WIDTH), *y = (int)((1 - q[1] / (q[2] * t)) / 2 * HEIGHT);
}

static void look_at_all(viewer *v) {
  vs_summary s;
  v->turn = -1.1, v->height = 0.5, v->distance = 10;
  if (vs_drawing_summary(v->scheme, &s) != VS_OUTCOME_DONE) return;
  double size = 0;
  for (int k = 0; k < 3; k++) v->centre[k] = (s.min[k] + s.max[k]) / 2, size += pow(s.max[k] - s.min[k], 2);
  v->distance = fmax(0.42 * sqrt(size) / sin(HALF_ANGLE), 1e-3);
}

/* ---- drawing ---- */

static void ball(const double at[3], double radius) {
  enum { PARTS = 12 };
  for (int i = 0; i < PARTS; i++) {
    glBegin(GL_QUAD_STRIP);
    for (int j = 0; j <= 2 * PARTS; j++)
      for (int k = 0; k < 2; k++) {
        double b = PI * ((double)(i + k) / PARTS - 0.5), a = -PI * j / PARTS;
        const double n[] = { cos(b) * cos(a), cos(b) * sin(a), sin(b) };
        glNormal3dv(n);
        glVertex3d(at[0] + radius * n[0], at[1] + radius * n[1], at[2] + radius * n[2]);
      }
    glEnd();
  }
}

static void line(const double from[3], const double to[3]) {
  glDisable(GL_LIGHTING);
  glBegin(GL_LINES), glVertex3dv(from), glVertex3dv(to), glEnd();
  glEnable(GL_LIGHTING);
}

/* Draws a gizmo: a slider as its track with a ball on it, arrows as lines with balls at their tips, a trigger as a
 * ball. */
static void draw_gizmo(const vs_gizmo *g) {
  static const unsigned char colors[][3] = { { 220, 60, 50 }, { 60, 160, 60 }, { 50, 100, 220 }, { 240, 180, 0 } };
  for (size_t i = 0; i < g->handle_count; i++) {
    bool along[3];
    for (int k = 0; k < 3; k++) along[k] = fabs(g->axes[i][k]) > 1e-9;
    int color = g->kind == VS_GIZMO_TRIGGER ? 3 : g->kind != VS_GIZMO_TRIPOD ? 0 : along[0] ? 0 : along[1] ? 1 : 2;
    double from[3], to[3];
    for (int k = 0; k < 3; k++) {
      from[k] = g->at[k] + (g->kind == VS_GIZMO_TRIPOD ? g->value[k] : 0);
      to[k] = g->kind == VS_GIZMO_SLIDER ? from[k] + g->axes[i][k] : g->handles[i][k];
    }
    glColor3ubv(colors[color]);
    line(from, to);
    ball(g->handles[i], g->size / (g->kind == VS_GIZMO_ARROW || g->kind == VS_GIZMO_TRIPOD ? 7 : 2));
  }
}

static void draw(const viewer *v) {
  double eye[3], axes[3][3], near = v->distance / 100, top = near * tan(HALF_ANGLE), right = top * WIDTH / HEIGHT;
  camera(v, eye, axes);
  double turn[16] = { 0 };
  for (int k = 0; k < 3; k++) turn[4 * k] = axes[0][k], turn[4 * k + 1] = axes[1][k], turn[4 * k + 2] = -axes[2][k];
  turn[15] = 1;
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glMatrixMode(GL_PROJECTION), glLoadIdentity(), glFrustum(-right, right, -top, top, near, 100 * v->distance);
  glMatrixMode(GL_MODELVIEW), glLoadIdentity();
  glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ -0.3f, 0.6f, 1, 0 }); /* light from above the camera's left
                                                                            * shoulder */
  glLoadMatrixd(turn);
  glTranslated(-eye[0], -eye[1], -eye[2]);
  for (size_t i = 0; i < v->shape_count; i++) {
    const shape *s = &v->shapes[i];
    glBindBuffer(GL_ARRAY_BUFFER, s->buffer);
    glEnableClientState(GL_VERTEX_ARRAY), glEnableClientState(GL_NORMAL_ARRAY), glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof(vertex), (void *)offsetof(vertex, point));
    glNormalPointer(GL_FLOAT, sizeof(vertex), (void *)offsetof(vertex, normal));
    glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(vertex), (void *)offsetof(vertex, color));
    if (s->curve) glDisable(GL_LIGHTING);
    for (size_t k = 0; k < s->place_count; k++) {
      glPushMatrix();
      glMultMatrixd(s->places[k]);
      glDrawArrays(s->curve ? GL_LINE_STRIP : GL_TRIANGLES, 0, s->count);
      glPopMatrix();
    }
    glEnable(GL_LIGHTING);
  }
  glDisableClientState(GL_VERTEX_ARRAY), glDisableClientState(GL_NORMAL_ARRAY), glDisableClientState(GL_COLOR_ARRAY);
  for (size_t i = 0; i < v->gizmo_count; i++) draw_gizmo(&v->gizmos[i]);
  glFinish();
}

/* ---- the mouse ---- */

/* Returns true if the ray hits a handle. vs_input decides which handle receives the mouse, and which objects hide
 * it. */
static bool near_handle(const viewer *v, const double eye[3], const double way[3]) {
  double length = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
  for (size_t i = 0; i < v->gizmo_count; i++)
    for (size_t h = 0; h < v->gizmos[i].handle_count; h++) {
      double along = 0, away = 0;
      for (int k = 0; k < 3; k++) along += (v->gizmos[i].handles[h][k] - eye[k]) * way[k] / length;
      for (int k = 0; k < 3; k++) away += pow(eye[k] + along * way[k] / length - v->gizmos[i].handles[h][k], 2);
      if (along > 0 && sqrt(away) <= v->gizmos[i].size / 2) return true;
    }
  return false;
}

static bool tell(void *context, vs_scheme *s, const vs_hit *hit) {
  const char *name = vs_node_name(s, hit->node);
  (void)context;
  printf("%s", name ? name : "a node");
  printf(" at (%.2f %.2f %.2f), made in %s:%u\n", hit->point[0], hit->point[1], hit->point[2], hit->file, hit->line);
  return false; /* returns false because only the nearest hit counts */
}

static void mouse(viewer *v, const SDL_Event *e) {
  double eye[3], way[3];
  if (e->type == SDL_MOUSEWHEEL) {
    v->distance *= pow(0.9, e->wheel.y);
  } else if (e->type == SDL_MOUSEBUTTONDOWN && e->button.button == SDL_BUTTON_LEFT) {
    ray(v, v->x = e->button.x, v->y = e->button.y, eye, way);
    v->holds = near_handle(v, eye, way);
    v->turns = !v->holds;
    if (v->holds) vs_input(v->scheme, VS_INPUT_PRESS, VS_BUTTON_LEFT, eye, way, NULL, NULL);
    else vs_pick(v->scheme, eye, way, tell, v);
  } else if (e->type == SDL_MOUSEMOTION && v->holds) {
    ray(v, e->motion.x, e->motion.y, eye, way);
    vs_input(v->scheme, VS_INPUT_DRAG, VS_BUTTON_LEFT, eye, way, NULL, NULL);
  } else if (e->type == SDL_MOUSEMOTION && v->turns) {
    v->turn -= 0.01 * (e->motion.x - v->x), v->height += 0.01 * (e->motion.y - v->y);
    v->height = fmax(-1.5, fmin(1.5, v->height));
    v->x = e->motion.x, v->y = e->motion.y;
  } else if (e->type == SDL_MOUSEBUTTONUP && e->button.button == SDL_BUTTON_LEFT) {
    ray(v, e->button.x, e->button.y, eye, way);
    if (v->holds) vs_input(v->scheme, VS_INPUT_RELEASE, VS_BUTTON_LEFT, eye, way, NULL, NULL);
    v->holds = v->turns = false;
  }
}

/* Handles the waiting events, runs a frame and draws it. Returns false when the user has closed the window. */
static bool frame(viewer *v, double seconds) {
  for (SDL_Event e; SDL_PollEvent(&e); mouse(v, &e))
    if (e.type == SDL_QUIT) return false;
  vs_scene_frame(v->scheme, seconds);
  vs_update(v->scheme);
  update(v);
  draw(v);
  return true;
}

/* ---- a script in place of a user ---- */

static void push(Uint32 type, int x, int y) {
  SDL_Event e = { .type = type };
  if (type == SDL_MOUSEMOTION) e.motion.x = x, e.motion.y = y;
  else e.button.button = SDL_BUTTON_LEFT, e.button.x = x, e.button.y = y;
  SDL_PushEvent(&e);
}

static void tell_pixels(int x, int y, const char *file) {
  static unsigned char pixels[HEIGHT][WIDTH][3]; /* OpenGL stores the lowest row first */
  size_t covered = 0;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, pixels);
  for (int i = 0; i < HEIGHT; i++)
    for (int k = 0; k < WIDTH; k++) covered += memcmp(pixels[i][k], pixels[0][0], 3) != 0;
  const unsigned char *p = pixels[HEIGHT - 1 - y][x];
  if (!file) printf("covered %zu, at %d %d: %d %d %d\n", covered, x, y, p[0], p[1], p[2]);
  FILE *to = file ? fopen(file, "wb") : NULL;
  if (!to) return;
  fprintf(to, "P6 %d %d 255\n", WIDTH, HEIGHT);
  for (int i = HEIGHT; i--;) fwrite(pixels[i], 3, WIDTH, to);
  fclose(to);
}

/* A line is one of: frame SECONDS, press X Y, grab GIZMO HANDLE, drag DX DY, release, pixels X Y, save FILE, buffers.
 * The mouse's events go through SDL's queue. */
static int play(viewer *v, const char *path) {
  char text[300], file[256];
  int a, b, x = 0, y = 0;
  double seconds;
  FILE *script = fopen(path, "r");
  if (!script) return fprintf(stderr, "%s cannot be read\n", path), 2;
  while (fgets(text, sizeof text, script)) {
    if (sscanf(text, "frame %lf", &seconds) == 1) {
      frame(v, seconds);
      continue;
    }
    if (sscanf(text, "press %d %d", &a, &b) == 2) push(SDL_MOUSEBUTTONDOWN, x = a, y = b);
    else if (sscanf(text, "grab %d %d", &a, &b) == 2 && a >= 0 && (size_t)a < v->gizmo_count && b >= 0 && b < 3) {
      project(v, v->gizmos[a].handles[b], &x, &y);
      push(SDL_MOUSEBUTTONDOWN, x, y);
    } else if (sscanf(text, "drag %d %d", &a, &b) == 2) push(SDL_MOUSEMOTION, x += a, y += b);
    else if (strncmp(text, "release", 7) == 0) push(SDL_MOUSEBUTTONUP, x, y);
    else if (sscanf(text, "pixels %d %d", &a, &b) == 2) tell_pixels(a, b, NULL);
    else if (sscanf(text, "save %255s", file) == 1) tell_pixels(0, 0, file);
    else if (strncmp(text, "buffers", 7) == 0) {
      size_t places = 0, corners = 0;
      for (size_t i = 0; i < v->shape_count; i++)
        places += v->shapes[i].place_count, corners += (size_t)v->shapes[i].count;
      printf("%zu buffers at %zu places, %zu gizmos, %zu corners\n", v->shape_count, places, v->gizmo_count, corners);
    } else return fprintf(stderr, "this line means nothing: %s", text), fclose(script), 2;
    frame(v, 0);
  }
  fclose(script);
  return 0;
}

int main(int count, char **words) {
  static viewer v;
  if (count != 2 && !(count == 4 && strcmp(words[2], "--test") == 0))
    return fputs("usage: viewer MODEL [--test FILE]\n", stderr), 2;
  if (SDL_Init(SDL_INIT_VIDEO) != 0) return fprintf(stderr, "%s\n", SDL_GetError()), 3;
  SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 24);
  v.window = SDL_CreateWindow(words[1], SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, WIDTH, HEIGHT,
                              SDL_WINDOW_OPENGL);
  SDL_GLContext gl = v.window ? SDL_GL_CreateContext(v.window) : NULL;
  if (!gl) return fprintf(stderr, "%s\n", SDL_GetError()), SDL_Quit(), 3;
  glClearColor(0.93f, 0.94f, 0.96f, 1);
  glEnable(GL_DEPTH_TEST), glEnable(GL_LIGHTING), glEnable(GL_LIGHT0), glEnable(GL_COLOR_MATERIAL);
  glEnable(GL_NORMALIZE), glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1), glLineWidth(3);
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (const float[]){ 0.4f, 0.4f, 0.4f, 1 });

  vs_options o = vs_options_default();
  o.host = (vs_host){ .context = &v, .diagnose = diagnose, .output = print };
  v.scheme = vs_new(&o);
  int code = v.scheme ? (int)vs_eval_file(v.scheme, words[1], VS_EVAL_PROGRAM) : VS_OUTCOME_MACHINE;
  if (code == VS_OUTCOME_DONE) {
    vs_handle adapt = vs_lookup(v.scheme, "scene-quality"); /* after this first call, the quality depends on the times
                                                             * of the frames */
    vs_apply(v.scheme, adapt, NULL, 0, NULL);
    vs_handle_release(v.scheme, adapt);
    look_at_all(&v);
    Uint32 before = SDL_GetTicks();
    if (count == 4) frame(&v, 0), code = play(&v, words[3]);
    else
      while (frame(&v, (SDL_GetTicks() - before) / 1000.0)) {
        before = SDL_GetTicks();
        SDL_GL_SwapWindow(v.window);
        SDL_Delay(10);
      }
  }
  vs_free(v.scheme);
  for (size_t i = 0; i < v.shape_count; i++) free(v.shapes[i].places);
  free(v.shapes);
  SDL_GL_DeleteContext(gl);
  SDL_DestroyWindow(v.window);
  SDL_Quit();
  return code;
}
