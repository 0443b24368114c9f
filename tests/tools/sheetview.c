/* Compares a picture of a sheet of shapes with the mesh of this sheet, seen by the same camera: `sheetview TABLE
 * FILE.stl SCENE PICTURE.png WHAT SHEET.png` judges each cell, in the words that tests/run.sh reads, and writes a
 * contact sheet.
 *
 * SCENE is the .pov file or the page from which the picture was made; the tool reads the camera from it. The picture of
 * a .pov has an alpha channel; the picture of a page is dark on white. In each cell, the silhouettes of picture and
 * mesh may differ in fewer than 1 % of the pixels of the mesh's silhouette. A pixel whose centre is within a quarter of
 * a pixel of the outline may belong to either silhouette.
 *
 * Curves have almost no silhouette, so the mesh contains thin rods for them. No pixel on a rod may be further than two
 * pixels from the shape's pixels in the picture. Conversely, a pixel of the shape may be at most two pixels from a rod,
 * plus the radius of POV-Ray's rods for curves (half of 1/450 of the picture's width, or a pixel). In SHEET.png, grey
 * pixels belong to picture and mesh, red pixels to the picture alone, blue pixels to the mesh alone. */
#include <png.h>

#include "lattice.h"

typedef struct {
  bool parallel;
  vec eye, right, up, forward; /* eye: position of the camera. right, up: the picture's axes, of length 1 / (half the
                                * picture's width), measured at distance 1 for a perspective camera. forward: unit
                                * vector in the direction of view */
  int width, height;
} camera;

static vec unit(vec v) { return vec_scale(v, 1 / vec_length(v)); }

static bool find_vector(const char *text, const char *word, const char *form, vec *out) {
  const char *at = strstr(text, word);
  return at && sscanf(at + strlen(word), form, &out->x, &out->y, &out->z) == 3;
}

static bool camera_povray(const char *text, camera *c) {
  vec target, sky;
  double width;
  const char *at = strstr(text, "camera {"), *right = at ? strstr(at, "right -x*") : NULL;
  if (!right || !strstr(at, "orthographic") || !find_vector(at, "location ", "<%lf, %lf, %lf>", &c->eye) || !find_vector(at, "look_at ", "<%lf, %lf, %lf>", &target) ||
      !find_vector(at, "sky ", "<%lf, %lf, %lf>", &sky) || sscanf(right, "right -x*%lf", &width) != 1)
    return false;
  c->parallel = true;
  c->forward = unit(vec_sub(target, c->eye));
  vec across = unit(vec_cross(c->forward, sky));
  c->right = vec_scale(across, 2 / width);
  c->up = vec_scale(vec_cross(across, c->forward), 2 / width); /* scaled like the axis `right`, by the picture's
                                                                * width */
  return true;
}

/* Returns v rotated by the angle about the axis, a unit vector. */
static vec turned(vec v, vec axis, double angle) {
  return vec_add(vec_add(vec_scale(v, cos(angle)), vec_scale(vec_cross(axis, v), sin(angle))), vec_scale(axis, vec_dot(axis, v) * (1 - cos(angle))));
}
/* Converts v from the scene's axes to the mesh's: in the scene Y points up, in the mesh Z. */
static vec up_z(vec v) { return (vec){v.x, -v.z, v.y}; }

static bool camera_x3d(const char *text, camera *c) {
  double angle, field;
  vec axis;
  const char *at = strstr(text, "<Viewpoint"), *orientation = at ? strstr(at, "orientation='") : NULL, *view = at ? strstr(at, "fieldOfView='") : NULL;
  if (!orientation || !view || !find_vector(at, "position='", "%lf %lf %lf", &c->eye) || sscanf(orientation, "orientation='%lf %lf %lf %lf", &axis.x, &axis.y, &axis.z, &angle) != 4 ||
      sscanf(view, "fieldOfView='%lf", &field) != 1)
    return false;
  c->eye = up_z(c->eye);
  c->right = vec_scale(up_z(turned((vec){1, 0, 0}, axis, angle)), 1 / tan(field / 2)); /* the picture is square, so the
                                                                                        * field of view determines its
                                                                                        * width and height */
  c->up = vec_scale(up_z(turned((vec){0, 1, 0}, axis, angle)), 1 / tan(field / 2));
  c->forward = up_z(turned((vec){0, 0, -1}, axis, angle));
  return true;
}

/* Computes the position of a point in the picture, in pixels from its upper left corner. */
static void project(const camera *c, vec p, double *x, double *y) {
  vec d = vec_sub(p, c->eye);
  double depth = c->parallel ? 1 : vec_dot(d, c->forward);
  *x = c->width * 0.5 * (1 + vec_dot(d, c->right) / depth);
  *y = c->height * 0.5 - c->width * 0.5 * vec_dot(d, c->up) / depth;
}

/* Returns the number of the cell where a pixel's line of sight intersects the plane of the sheet, which contains the
 * origin. */
static long pixel_cell(const camera *c, const lattice *l, int x, int y) {
  double a = (x + 0.5) / c->width * 2 - 1, b = (c->height * 0.5 - (y + 0.5)) / (c->width * 0.5);
  vec side = vec_add(vec_scale(c->right, a / vec_dot(c->right, c->right)), vec_scale(c->up, b / vec_dot(c->up, c->up)));
  vec from = c->parallel ? vec_add(c->eye, side) : c->eye, along = c->parallel ? c->forward : vec_add(c->forward, side);
  vec normal = vec_cross(l->across, l->upwards);
  return lattice_cell(l, vec_sub(from, vec_scale(along, vec_dot(from, normal) / vec_dot(along, normal))));
}

/* Sets the bit in the mask of every pixel whose sample point (dx, dy) the triangle covers. */
static void fill(const camera *c, const triangle *t, double dx, double dy, uint16_t bit, uint16_t *mask) {
  double x[3], y[3];
  for (int k = 0; k < 3; k++) project(c, vec_of(t->v[k]), &x[k], &y[k]);
  int top = (int)fmax(0, ceil(fmin(fmin(y[0], y[1]), y[2]) - dy)), bottom = (int)fmin(c->height - 1, floor(fmax(fmax(y[0], y[1]), y[2]) - dy));
  for (int row = top; row <= bottom; row++) {
    double level = row + dy, from = INFINITY, to = -INFINITY;
    for (int k = 0; k < 3; k++) {
      int m = (k + 1) % 3;
      if ((y[k] < level) == (y[m] < level)) continue;
      double at = x[k] + (x[m] - x[k]) * (level - y[k]) / (y[m] - y[k]);
      from = fmin(from, at), to = fmax(to, at);
    }
    for (int column = (int)fmax(0, ceil(from - dx)); column <= (int)fmin(c->width - 1, floor(to - dx)); column++) mask[(size_t)row * (size_t)c->width + (size_t)column] |= bit;
  }
}

static bool near_any(const camera *c, const unsigned char *mask, int x, int y, int reach) {
  for (int j = y - reach; j <= y + reach; j++)
    for (int i = x - reach; i <= x + reach; i++)
      if (i >= 0 && j >= 0 && i < c->width && j < c->height && mask[(size_t)j * (size_t)c->width + (size_t)i]) return true;
  return false;
}

/* Returns true if pixel i shows a shape: it is dark, or it is translucent and not part of a smoothed edge, which is one
 * pixel wide. */
static bool page_seen(const unsigned char *picture, size_t i, size_t width, size_t pixels) {
  if (picture[4 * i + 1] < 160) return true;
  const size_t round[] = {i, i - 1, i + 1, i - width, i + width};
  if (i < width || i + width >= pixels) return false;
  for (size_t k = 0; k < 5; k++)
    if (picture[4 * round[k] + 1] > 250) return false;
  return true;
}

static char *read_text(const char *path) {
  FILE *f = fopen(path, "rb");
  size_t room = 1 << 20, used = 0, got; /* the text of the camera is near the top of the file */
  char *text = malloc(room + 1);
  while (f && text && used < room && (got = fread(text + used, 1, room - used, f)) > 0) used += got;
  if (f) fclose(f);
  if (text) text[used] = 0;
  return f ? text : NULL;
}

int main(int argc, char **argv) {
  lattice l;
  stl mesh;
  camera c = {0};
  char why[128] = "TABLE FILE.stl SCENE PICTURE.png WHAT SHEET.png, please";
  png_image image = {.version = PNG_IMAGE_VERSION};
  char *scene = argc == 7 ? read_text(argv[3]) : NULL;
  bool povray = scene && strstr(argv[3], ".pov");
  if (!scene || !lattice_read(argv[1], &l) || !stl_read(argv[2], &mesh, why) || !png_image_begin_read_from_file(&image, argv[4]) ||
      !(povray ? camera_povray(scene, &c) : camera_x3d(scene, &c))) {
    printf("not ok cross/%s\n    %s%s: no picture or no camera\n", argc == 7 ? argv[5] : "", why, image.message);
    return 2;
  }
  image.format = PNG_FORMAT_RGBA;
  c.width = (int)image.width, c.height = (int)image.height;
  size_t pixels = (size_t)image.width * image.height;
  unsigned char *picture = malloc(PNG_IMAGE_SIZE(image)), *seen = calloc(pixels, 1), *touched = calloc(pixels, 1);
  uint16_t *mask = calloc(pixels, sizeof *mask);
  if (!picture || !seen || !mask || !touched || !png_image_finish_read(&image, NULL, picture, 0, NULL)) {
    printf("not ok cross/%s\n    %s\n", argv[5], image.message);
    return 2;
  }
  for (size_t i = 0; i < pixels; i++) seen[i] = povray ? picture[4 * i + 3] > 25 : page_seen(picture, i, image.width, pixels);
  /* Sample points within a pixel: the centre, points halfway to the corners, and points near the corners. A pixel is on
   * the mesh if all sample points are, and off the mesh if none is. */
  static const double places[9][2] = {{0.5, 0.5}, {0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}, {0.02, 0.02}, {0.98, 0.02}, {0.02, 0.98}, {0.98, 0.98}};
  for (size_t i = 0; i < mesh.count; i++)
    for (int k = 0; k < 9; k++) fill(&c, &mesh.at[i], places[k][0], places[k][1], (uint16_t)(1 << k), mask);
  /* a pixel on the outline has only a part of its 9 bits set; the mesh accepts the picture's value for this pixel */
  for (size_t i = 0; i < pixels; i++) touched[i] = mask[i] != 0, mask[i] = mask[i] == 0 ? 0 : mask[i] == 511 ? 1 : seen[i];
  int rod = povray ? (int)ceil(fmax(1, c.width / 900.)) : 0;

  static long whole[CELLS_MOST], rods[CELLS_MOST], only_picture[CELLS_MOST], only_mesh[CELLS_MOST], far[CELLS_MOST];
  for (size_t i = 0; i < pixels; i++) {
    unsigned char *to = picture + 4 * i;
    int x = (int)(i % image.width), y = (int)(i / image.width);
    to[0] = to[1] = to[2] = seen[i] && mask[i] ? 190 : 255, to[3] = 255;
    if (!seen[i] && !touched[i]) continue;
    long at = pixel_cell(&c, &l, x, y);
    if (at < 0 || at >= CELLS_MOST) continue;
    whole[at] += mask[i], rods[at] += touched[i];
    if ((seen[i] && !touched[i] && !near_any(&c, touched, x, y, 2 + rod)) || (touched[i] && !seen[i] && !near_any(&c, seen, x, y, 2))) far[at]++;
    if (seen[i] == mask[i]) continue;
    if (seen[i]) only_picture[at]++, to[0] = 220, to[1] = to[2] = 0;
    else only_mesh[at]++, to[0] = to[1] = 0, to[2] = 220;
  }
  int bad = 0;
  for (size_t i = 0; i < l.count; i++) {
    long n = l.cells[i].index;
    if (n < 0 || n >= CELLS_MOST) continue;
    bool thin = strcmp(l.cells[i].class, "curve") == 0 || strcmp(l.cells[i].class, "mixed") == 0; /* whether a part of the cell is
                                                                                                   * a curve */
    bool good = (thin ? rods[n] : whole[n]) > 40 && (thin ? far[n] == 0 : (double)(only_picture[n] + only_mesh[n]) < 0.01 * (double)whole[n]);
    printf("%s cross/%s:%s\n", good ? "ok" : "not ok", argv[5], l.cells[i].name);
    if (!good) printf("    of %ld pixels %ld are only in the picture and %ld only in the mesh; %ld far from the other\n", thin ? rods[n] : whole[n], only_picture[n], only_mesh[n], far[n]);
    bad |= !good;
  }
  if (!png_image_write_to_file(&image, argv[6], 0, picture, 0, NULL)) fprintf(stderr, "sheetview: %s\n", image.message);
  free(picture), free(seen), free(mask), free(touched), free(scene), free(mesh.at), free(l.cells);
  return bad;
}
