// Compares straight skeletons with CGAL's. Reads the outlines and faces that skeletons.vs writes from standard input.
// Faces of edges on one line lie in one plane of a roof, which may be divided between them in several ways: they count
// as one face. Prints a line for each face of which the area, or the volume between roof and eaves, differs; then sums.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/create_straight_skeleton_from_polygon_with_holes_2.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Edge = std::pair<std::pair<double, double>, std::pair<double, double>>;
struct Face { double area, volume, x, y, offset; }; // volume: below a roof of 45 degrees; x, y, offset: the edge's line

static Edge edge_of(const Point &a, const Point &b) { return { { a.x(), a.y() }, { b.x(), b.y() } }; }

// Measures the face of an edge by triangles from its first corner, whose heights are the distances from the edge.
static Face measure(const std::vector<Point> &at, const Edge &e) {
  double dx = e.second.first - e.first.first, dy = e.second.second - e.first.second, length = std::hypot(dx, dy);
  Face f = { 0, 0, -dy / length, dx / length, (e.first.second * dx - e.first.first * dy) / length };
  auto height = [&](const Point &p) { return f.x * p.x() + f.y * p.y() - f.offset; };
  for (size_t i = 1; i + 1 < at.size(); i++) {
    const Point &o = at[0], &p = at[i], &q = at[i + 1];
    double area = ((p.x() - o.x()) * (q.y() - o.y()) - (q.x() - o.x()) * (p.y() - o.y())) / 2;
    f.area += area, f.volume += area * (height(o) + height(p) + height(q)) / 3;
  }
  return f;
}

// Adds a face to the faces of its line.
static void add(std::vector<Face> &all, const Face &f) {
  for (Face &g : all)
    if (std::fabs(g.x - f.x) + std::fabs(g.y - f.y) + std::fabs(g.offset - f.offset) < 1e-7) {
      g.area += f.area, g.volume += f.volume;
      return;
    }
  all.push_back(f);
}

static std::vector<Point> read_points() {
  size_t n = 0;
  double x, y;
  std::vector<Point> all;
  for (std::cin >> n; n > 0 && std::cin >> x >> y; n--) all.emplace_back(x, y);
  return all;
}

int main() {
  std::string word;
  size_t number = 0, planes = 0, faults = 0;
  while (std::cin >> word) {
    size_t n = 0;
    std::cin >> n;
    if (word == "outline") {
      number++;
      std::vector<Point> outer = read_points();
      CGAL::Polygon_with_holes_2<Kernel> shape(CGAL::Polygon_2<Kernel>(outer.begin(), outer.end()));
      for (size_t i = 1; i < n; i++) {
        std::vector<Point> hole = read_points();
        shape.add_hole(CGAL::Polygon_2<Kernel>(hole.begin(), hole.end()));
      }
      size_t of_faces = 0;
      std::cin >> word >> of_faces;
      std::vector<Face> ours, judged;
      for (size_t i = 0; i < of_faces; i++) {
        std::vector<Point> at = read_points();
        add(ours, measure(std::vector<Point>(at.begin() + 2, at.end()), edge_of(at[0], at[1])));
      }
      auto theirs = CGAL::create_interior_straight_skeleton_2(shape);
      if (!theirs) {
        std::printf("outline %zu: CGAL has no skeleton\n", number);
        faults++;
        continue;
      }
      double whole = CGAL::to_double(shape.outer_boundary().area());
      for (auto f = theirs->faces_begin(); f != theirs->faces_end(); ++f) {
        std::vector<Point> at;
        auto start = f->halfedge(), h = start;
        Edge e;
        do {
          at.push_back(h->vertex()->point());
          if (!h->is_bisector()) e = edge_of(h->opposite()->vertex()->point(), h->vertex()->point());
          h = h->next();
        } while (h != start);
        add(judged, measure(at, e));
      }
      if (judged.size() != ours.size()) {
        std::printf("outline %zu: %zu planes, CGAL has %zu\n", number, ours.size(), judged.size());
        faults++;
      }
      for (const Face &judge : judged) {
        double area = NAN, volume = NAN;
        for (const Face &g : ours)
          if (std::fabs(g.x - judge.x) + std::fabs(g.y - judge.y) + std::fabs(g.offset - judge.offset) < 1e-7)
            area = g.area, volume = g.volume;
        planes++;
        if (std::fabs(area - judge.area) < 1e-7 * whole && std::fabs(volume - judge.volume) < 1e-7 * whole * std::sqrt(whole))
          continue;
        std::printf("outline %zu: a plane with the normal %g %g has area %.9g, volume %.9g; CGAL %.9g, %.9g\n", number, judge.x,
                    judge.y, area, volume, judge.area, judge.volume);
        faults++;
      }
    }
  }
  std::printf("%zu outlines, %zu planes, %zu differ\n", number, planes, faults);
  return faults > 0 || number == 0;
}
