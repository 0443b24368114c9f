/* Compares the mesh of a sheet of shapes with its table: `sheetmesh TABLE FILE.stl` judges each cell, in the words that
 * tests/run.sh reads.
 *
 * A cell's mesh must be closed and oriented. Its volume must equal the volume by formula within the table's tolerance,
 * its area within 1 %. It must fill the bounding box that the program returns: at each side, the difference may be at
 * most that between facets and round shapes. */
#include "lattice.h"

static int judge(const cell *c, const triangle *at, size_t count) {
  char why[1000] = "";
  size_t used = 0, open = 0, degenerate = 0;
#define SAY(...) used += (size_t)snprintf(why + used, sizeof why - used, "    " __VA_ARGS__)
  if (count == 0) {
    SAY("nothing is in its cell\n");
  } else {
    double volume = stl_volume(at, count), area = stl_area(at, count);
    if (!stl_check(at, count, &open, &degenerate, NULL)) SAY("out of memory\n");
    if (open) SAY("%zu open edges\n", open);
    if (degenerate) SAY("%zu edges without length\n", degenerate);
    if (!(volume > 0)) SAY("inside out: volume %g\n", volume);
    if (isfinite(c->volume) && !(fabs(volume - c->volume) <= c->within * c->volume)) SAY("volume %.9g, must be %.9g\n", volume, c->volume);
    if (isfinite(c->area) && !(fabs(area - c->area) <= 0.01 * c->area)) SAY("area %.9g, must be %.9g\n", area, c->area);
    vec least = vec_of(at[0].v[0]), most = least;
    for (size_t i = 0; i < 3 * count; i++) {
      vec p = vec_of(at[i / 3].v[i % 3]);
      least = (vec){fmin(least.x, p.x), fmin(least.y, p.y), fmin(least.z, p.z)};
      most = (vec){fmax(most.x, p.x), fmax(most.y, p.y), fmax(most.z, p.z)};
    }
    double slack = 1.2e-3 * vec_length(vec_sub(c->most, c->least)), loose = c->loose * vec_length(vec_sub(c->most, c->least));
    const double got[] = {least.x, least.y, least.z, -most.x, -most.y, -most.z}, box[] = {c->least.x, c->least.y, c->least.z, -c->most.x, -c->most.y, -c->most.z};
    for (int i = 0; i < 6; i++) {
      if (got[i] < box[i] - slack) SAY("leaves its bounding box at %c: %.9g, the box ends at %.9g\n", "xyzXYZ"[i], fabs(got[i]), fabs(box[i]));
      if (got[i] > box[i] + loose) SAY("does not fill its bounding box at %c: %.9g, the box ends at %.9g\n", "xyzXYZ"[i], fabs(got[i]), fabs(box[i]));
    }
  }
  printf("%s cross/mesh:%s\n%s", used ? "not ok" : "ok", c->name, why);
  return used != 0;
}

static const lattice *order_lattice; /* the grid of cells; a global variable, because the comparison function of qsort
                                      * needs it */
static int compare_cells(const void *a, const void *b) {
  const triangle *s = a, *t = b;
  vec p = vec_add(vec_add(vec_of(s->v[0]), vec_of(s->v[1])), vec_of(s->v[2])), q = vec_add(vec_add(vec_of(t->v[0]), vec_of(t->v[1])), vec_of(t->v[2]));
  long i = lattice_cell(order_lattice, vec_scale(p, 1. / 3)), j = lattice_cell(order_lattice, vec_scale(q, 1. / 3));
  return i < j ? -1 : i > j;
}

int main(int argc, char **argv) {
  lattice l;
  stl mesh;
  char why[128] = "TABLE FILE.stl, please";
  if (argc != 3 || !lattice_read(argv[1], &l) || !stl_read(argv[2], &mesh, why)) {
    printf("not ok cross/mesh\n    %s\n", why);
    return 2;
  }
  order_lattice = &l;
  qsort(mesh.at, mesh.count, sizeof *mesh.at, compare_cells);
  int bad = 0;
  for (size_t i = 0; i < l.count; i++) {
    const cell *c = &l.cells[i];
    if (strcmp(c->class, "solid") != 0) continue;
    size_t from = 0, end;
    while (from < mesh.count && lattice_cell(&l, vec_of(mesh.at[from].v[0])) != c->index) from++;
    for (end = from; end < mesh.count && lattice_cell(&l, vec_of(mesh.at[end].v[0])) == c->index;) end++;
    bad |= judge(c, mesh.at + from, end - from);
  }
  free(mesh.at);
  free(l.cells);
  return bad;
}
