/* Runs the measure of OpenCASCADE handing the same meshes to a host: handover_occt FILE, of handover.c.
 * A triangulation for each distinct mesh stands in a compound once for each place. Its places do not scale: a mesh that
 * is placed in several sizes has a triangulation for each. One line: meshes, places, MB of arrays, processor seconds to
 * fill the compound, MB that it takes, processor seconds to hand over: arrays of doubles with normals, as ours. */
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Trsf.hxx>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <map>
#include <sys/resource.h>
#include <unordered_map>
#include <vector>

struct mesh {
  std::vector<double> points, normals, places; // three, three and twelve numbers each
  std::vector<unsigned> corners;
};

static double seconds() { return (double)clock() / CLOCKS_PER_SEC; }
static double megabytes() {
  rusage r;
  getrusage(RUSAGE_SELF, &r);
  return (double)r.ru_maxrss * 1024 / 1e6;
}

static bool read_mesh(FILE *from, mesh &m) {
  uint64_t n[3];
  if (fread(n, sizeof n, 1, from) != 1) return false;
  m.points.resize(3 * n[0]), m.corners.resize(3 * n[1]), m.places.resize(12 * n[2]);
  return fread(m.points.data(), 8, 3 * n[0], from) == 3 * n[0] &&
         fread(m.corners.data(), 4, 3 * n[1], from) == 3 * n[1] &&
         fread(m.places.data(), 8, 12 * n[2], from) == 12 * n[2];
}

static TopoDS_Face face_of(const mesh &m, const double scale[3]) {
  int points = (int)m.points.size() / 3, triangles = (int)m.corners.size() / 3;
  Handle(Poly_Triangulation) t = new Poly_Triangulation(points, triangles, Standard_False);
  for (int i = 0; i < points; i++) {
    const double *p = &m.points[3 * (size_t)i];
    t->SetNode(i + 1, gp_Pnt(p[0] * scale[0], p[1] * scale[1], p[2] * scale[2]));
  }
  for (int i = 0; i < triangles; i++) {
    const unsigned *c = &m.corners[3 * (size_t)i];
    t->SetTriangle(i + 1, Poly_Triangle((int)c[0] + 1, (int)c[1] + 1, (int)c[2] + 1));
  }
  TopoDS_Face face;
  BRep_Builder().MakeFace(face, t);
  return face;
}

/* The scales along the mesh's axes; a mirrored place has the first below 0. */
static void scales_of(const double *a, double s[3]) {
  for (int k = 0; k < 3; k++) s[k] = sqrt(a[k] * a[k] + a[4 + k] * a[4 + k] + a[8 + k] * a[8 + k]);
  double turn = a[0] * (a[5] * a[10] - a[6] * a[9]) - a[1] * (a[4] * a[10] - a[6] * a[8]) +
                a[2] * (a[4] * a[9] - a[5] * a[8]);
  if (turn < 0) s[0] = -s[0];
}

static size_t add_places(const mesh &m, TopoDS_Compound &whole) {
  std::map<std::array<long, 3>, TopoDS_Face> made; // by scale
  BRep_Builder b;
  for (size_t i = 0; i < m.places.size(); i += 12) {
    const double *a = &m.places[i];
    double s[3];
    scales_of(a, s);
    std::array<long, 3> key = { lround(s[0] * 1e7), lround(s[1] * 1e7), lround(s[2] * 1e7) };
    auto it = made.find(key);
    if (it == made.end()) it = made.emplace(key, face_of(m, s)).first;
    gp_Trsf g;
    g.SetValues(a[0] / s[0], a[1] / s[1], a[2] / s[2], a[3], a[4] / s[0], a[5] / s[1], a[6] / s[2], a[7], a[8] / s[0],
                a[9] / s[1], a[10] / s[2], a[11]);
    b.Add(whole, it->second.Located(TopLoc_Location(g), Standard_False));
  }
  return m.places.size() / 12;
}

static void copy(const Handle(Poly_Triangulation) & t, mesh &to) {
  t->ComputeNormals();
  for (int i = 1; i <= t->NbNodes(); i++) {
    gp_Pnt p = t->Node(i);
    gp_Vec3f n;
    t->Normal(i, n);
    to.points.insert(to.points.end(), { p.X(), p.Y(), p.Z() });
    to.normals.insert(to.normals.end(), { n.x(), n.y(), n.z() });
  }
  for (int i = 1; i <= t->NbTriangles(); i++) {
    int x, y, z;
    t->Triangle(i).Get(x, y, z);
    to.corners.insert(to.corners.end(), { (unsigned)x - 1, (unsigned)y - 1, (unsigned)z - 1 });
  }
}

int main(int count, char **words) {
  FILE *from = count == 2 ? fopen(words[1], "rb") : nullptr;
  if (!from) return 1;
  std::vector<mesh> all;
  for (mesh m; read_mesh(from, m); m = mesh()) all.push_back(m);
  double before = megabytes(), began = seconds();
  TopoDS_Compound whole;
  BRep_Builder().MakeCompound(whole);
  size_t places = 0, bytes = 0;
  for (const mesh &m : all) places += add_places(m, whole);
  double filled = seconds(), grew = megabytes() - before;
  std::unordered_map<Poly_Triangulation *, mesh> got;
  for (TopExp_Explorer e(whole, TopAbs_FACE); e.More(); e.Next()) {
    TopLoc_Location at;
    const Handle(Poly_Triangulation) &t = BRep_Tool::Triangulation(TopoDS::Face(e.Current()), at);
    mesh &to = got[t.get()];
    if (to.points.empty()) copy(t, to);
    gp_Trsf g = at.Transformation();
    for (int r = 1; r <= 3; r++)
      for (int k = 1; k <= 4; k++) to.places.push_back(g.Value(r, k));
  }
  double handed = seconds() - filled;
  for (const auto &g : got) {
    const mesh &m = g.second;
    bytes += 8 * (m.points.size() + m.normals.size() + m.places.size()) + 4 * m.corners.size();
  }
  printf("%zu %zu %.1f %.3f %.0f %.3f\n", got.size(), places, (double)bytes / 1e6, filled - began, grew, handed);
}
