// Packs the parts of a set with libnest2d, in several configurations, and prints a line for each: bench/nesting/run.sh.
//
// Reads from standard input: width and height of the sheet, the angles in degrees (their number first), the number of
// kinds of parts; for each kind the number of copies, the number of corners, the corners. Prints the configuration, the
// sheets, the use of material in per cent, the area that parts of a sheet share in per cent of the parts, seconds.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include <libnest2d/libnest2d.hpp>

using namespace libnest2d;
using Clock = std::chrono::steady_clock;
using Paths = ClipperLib::Paths;

struct Kind {
  int copies;
  std::vector<std::pair<double, double>> corners;
};

static double width, height, scale;
static std::vector<double> angles;
static std::vector<Kind> kinds;

static std::vector<std::pair<double, double>> hull_of(std::vector<std::pair<double, double>> p) {
  std::sort(p.begin(), p.end());
  std::vector<std::pair<double, double>> h(2 * p.size());
  size_t k = 0;
  auto turn = [](auto a, auto b, auto c) {
    return (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
  };
  for (size_t i = 0; i < p.size(); h[k++] = p[i++])
    while (k >= 2 && turn(h[k - 2], h[k - 1], p[i]) <= 0) k--;
  for (size_t i = p.size() - 1, t = k + 1; i-- > 0; h[k++] = p[i])
    while (k >= t && turn(h[k - 2], h[k - 1], p[i]) <= 0) k--;
  h.resize(k - 1);
  return h;
}

// The item of a part: its corners clockwise, the first one repeated, as libnest2d's polygons have them.
static Item item_of(std::vector<std::pair<double, double>> p) {
  double area = 0;
  for (size_t i = 0; i < p.size(); i++) {
    auto a = p[i], b = p[(i + 1) % p.size()];
    area += a.first * b.second - b.first * a.second;
  }
  if (area > 0) std::reverse(p.begin(), p.end());
  PolygonImpl made;
  for (auto c : p) made.Contour.emplace_back(std::llround(c.first * scale), std::llround(c.second * scale));
  made.Contour.push_back(made.Contour.front());
  return Item(made);
}

struct Part {
  Item item;
  ClipperLib::Path outline; // the true outline, also where the item is its convex hull
};

static ClipperLib::Path placed(const Part &p) {
  PolygonImpl shape;
  shape.Contour = p.outline;
  Item whole(shape);
  whole.rotation(p.item.rotation());
  whole.translation(p.item.translation());
  return whole.transformedShape().Contour;
}

static double area_of(const Paths &p) {
  double sum = 0;
  for (auto &c : p) sum += ClipperLib::Area(c);
  return std::fabs(sum);
}

// The use of material: the area of the parts, over that of all sheets but the last and of the filled end of the last.
static void report(const std::string &name, const std::vector<Part> &parts, double seconds) {
  int sheets = 0;
  bool all = true;
  double sum = 0, shared = 0;
  for (auto &p : parts) {
    sheets = std::max(sheets, p.item.binId() + 1);
    all = all && p.item.binId() >= 0;
    sum += area_of({ placed(p) });
  }
  double low_x = INFINITY, high_x = -INFINITY, low_y = INFINITY, high_y = -INFINITY;
  for (int s = 0; s < sheets; s++) {
    Paths on;
    double single = 0;
    for (auto &p : parts)
      if (p.item.binId() == s) {
        on.push_back(placed(p));
        single += area_of({ on.back() });
        for (auto &c : on.back())
          if (s == sheets - 1) {
            low_x = std::min(low_x, double(c.X)), high_x = std::max(high_x, double(c.X));
            low_y = std::min(low_y, double(c.Y)), high_y = std::max(high_y, double(c.Y));
          }
      }
    for (auto &c : on)
      if (ClipperLib::Orientation(c) != ClipperLib::Orientation(on[0])) ClipperLib::ReversePath(c);
    ClipperLib::Clipper clipper;
    Paths united;
    clipper.AddPaths(on, ClipperLib::ptSubject, true);
    clipper.Execute(ClipperLib::ctUnion, united, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    double covered = 0; // holes count negative
    for (auto &c : united) covered += ClipperLib::Area(c);
    shared += single - std::fabs(covered);
  }
  double w = width * scale, h = height * scale, last = std::min((high_x - low_x) * h, (high_y - low_y) * w);
  std::printf("%s\t%d\t%.1f\t%.4f\t%.1f%s\n", name.c_str(), sheets, 100 * sum / ((sheets - 1) * w * h + last), 100 * shared / sum,
              seconds, all ? "" : "\tsome parts are not placed");
  std::fflush(stdout);
}

template <class Placer, class Selector> static void pack(const std::string &name, bool hulls, typename Placer::Config config) {
  std::vector<Part> parts;
  for (auto &k : kinds)
    for (int i = 0; i < k.copies; i++)
      parts.push_back({ item_of(hulls ? hull_of(k.corners) : k.corners), item_of(k.corners).rawShape().Contour });
  std::vector<Item> items;
  for (auto &p : parts) items.push_back(p.item);
  auto start = Clock::now();
  nest<Placer, Selector>(items, Box(std::llround(width * scale), std::llround(height * scale)), 0,
                         NestConfig<Placer, Selector>(config));
  double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  for (size_t i = 0; i < parts.size(); i++) parts[i].item = items[i];
  report((hulls ? "hulls, " : "outlines, ") + name, parts, seconds);
}

static NfpPlacer::Config by_fit(float accuracy) {
  NfpPlacer::Config c;
  c.rotations.clear();
  for (double a : angles) c.rotations.emplace_back(Degrees(a));
  c.alignment = c.starting_point = NfpPlacer::Config::Alignment::BOTTOM_LEFT;
  c.accuracy = accuracy;
  return c;
}

int main() {
  size_t n = 0;
  std::cin >> width >> height >> n;
  for (double a; n-- && std::cin >> a;) angles.push_back(a);
  std::cin >> n;
  for (Kind k; n-- && std::cin >> k.copies; kinds.push_back(k)) {
    size_t corners;
    std::cin >> corners;
    k.corners.resize(corners);
    for (auto &c : k.corners) std::cin >> c.first >> c.second;
  }
  if (!std::cin) return std::fprintf(stderr, "peer: the set cannot be read\n"), 1;
  scale = 1e7 / std::max(width, height);
  for (bool hulls : { false, true }) {
    pack<NfpPlacer, FirstFitSelection>("first fit", hulls, by_fit(0.65f));
    pack<NfpPlacer, FirstFitSelection>("first fit, accurate", hulls, by_fit(1));
    pack<NfpPlacer, DJDHeuristic>("DJD", hulls, by_fit(0.65f));
  }
}
