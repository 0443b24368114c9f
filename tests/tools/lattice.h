/* Reads the output of `tests/cross/sheet.vs -D task=table`: a regular grid of shapes on a sheet, with the expected
 * volume and area of the shape in each cell. */
#ifndef TESTS_TOOLS_LATTICE_H
#define TESTS_TOOLS_LATTICE_H

#include "stl.h"

enum { CELLS_MOST = 2000 };

typedef struct {
  long index;            /* number of the cell: its column + its row * number of columns */
  char name[120], class[16]; /* class of the object: solid, region, surface, curve or mixed */
  double volume, area;   /* expected volume and area of the cell's shape; NAN if unknown */
  vec least, most;       /* least, most: corners of the bounding box that the program returns */
  double within, loose;  /* within: relative tolerance of the volume. loose: tolerance of a side of the bounding box, as
                          * a fraction of its diagonal */
} cell;

typedef struct {
  int columns;
  vec across, upwards; /* across: vector from a cell to the next cell in its row. upwards: vector from a row to the next
                        * row */
  cell *cells;
  size_t count;
} lattice;

static inline double lattice_number(const char *text) { return strcmp(text, "-") == 0 ? NAN : strtod(text, NULL); }

static inline bool lattice_read(const char *path, lattice *out) {
  FILE *f = fopen(path, "r");
  char line[2000];
  *out = (lattice){.cells = calloc(CELLS_MOST, sizeof *out->cells)};
  vec *a = &out->across, *b = &out->upwards;
  bool good = f && out->cells && fgets(line, sizeof line, f) &&
              sscanf(line, "lattice %d %lf %lf %lf %lf %lf %lf", &out->columns, &a->x, &a->y, &a->z, &b->x, &b->y, &b->z) == 7;
  while (good && out->count < CELLS_MOST && fgets(line, sizeof line, f)) {
    cell *c = &out->cells[out->count++];
    char volume[40], area[40];
    good = sscanf(line, "%ld\t%119[^\t]\t%15[^\t]\t%39[^\t]\t%39[^\t]\t%lf %lf %lf %lf %lf %lf\t%lf\t%lf", &c->index, c->name, c->class, volume, area, &c->least.x,
                  &c->least.y, &c->least.z, &c->most.x, &c->most.y, &c->most.z, &c->within, &c->loose) == 13;
    c->volume = lattice_number(volume), c->area = lattice_number(area);
    if (!good) fprintf(stderr, "%s: cannot read: %s", path, line);
  }
  if (f) fclose(f);
  return good && out->count > 0;
}

/* Returns the number of the cell that contains p, or -1 if p is outside all cells. The grid's points are the centres of
 * the cells. */
static inline long lattice_cell(const lattice *l, vec p) {
  double column = floor(vec_dot(p, l->across) / vec_dot(l->across, l->across) + 0.5), row = floor(vec_dot(p, l->upwards) / vec_dot(l->upwards, l->upwards) + 0.5);
  return column < 0 || column >= l->columns || row < 0 || row > 1e6 ? -1 : (long)column + (long)row * l->columns;
}

#endif
