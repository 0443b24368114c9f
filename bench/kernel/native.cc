// Owns the comparison with native Manifold: evaluates a workload with the library that is linked. native FILE.sx
// As manifold.mjs does with manifold-3d: the same facets as ours, boxes and cylinders by Manifold's own constructors, sets as batches. Prints one line of JSON:
// elapsed seconds from the tree that is read to the triangles in memory, and their number.
#include <manifold/manifold.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using manifold::Manifold;
using manifold::MeshGL;

struct Node {
  std::string op, name; // name: of what a def defines, or a use uses
  std::vector<double> n;
  std::vector<std::unique_ptr<Node>> kids;
  MeshGL facets; // of curved shapes: made before the clock starts, as they are for us
};

static std::vector<std::unique_ptr<Node>> read(const char *file) {
  std::ifstream in(file);
  std::vector<std::unique_ptr<Node>> top;
  std::vector<std::unique_ptr<Node>> stack;
  std::string line, token;
  while (std::getline(in, line)) {
    std::string spaced;
    for (char c : line.substr(0, line.find(';')))
      if (c == '(' || c == ')') spaced += std::string(" ") + c + " ";
      else spaced += c;
    std::istringstream words(spaced);
    while (words >> token) {
      if (token == "(") {
        stack.push_back(std::make_unique<Node>());
      } else if (token == ")") {
        auto done = std::move(stack.back());
        stack.pop_back();
        (stack.empty() ? top : stack.back()->kids).push_back(std::move(done));
      } else if (stack.back()->op.empty()) {
        stack.back()->op = token;
      } else {
        char *end;
        double x = std::strtod(token.c_str(), &end);
        if (*end) stack.back()->name = token;
        else stack.back()->n.push_back(x);
      }
    }
  }
  return top;
}

static void corner(MeshGL &m, double x, double y, double z) { m.vertProperties.insert(m.vertProperties.end(), { (float)x, (float)y, (float)z }); }
static void face(MeshGL &m, size_t a, size_t b, size_t c) { m.triVerts.insert(m.triVerts.end(), { (uint32_t)a, (uint32_t)b, (uint32_t)c }); }

static MeshGL sphere(double r, size_t n) {
  MeshGL m;
  m.numProp = 3;
  size_t b = n / 2, top = 1 + (b - 1) * n;
  corner(m, 0, 0, -r);
  for (size_t j = 1; j < b; j++)
    for (size_t i = 0; i < n; i++) {
      double t = M_PI * (double)j / (double)b, u = 2 * M_PI * (double)i / (double)n;
      corner(m, r * std::sin(t) * std::cos(u), r * std::sin(t) * std::sin(u), -r * std::cos(t));
    }
  corner(m, 0, 0, r);
  auto v = [n](size_t j, size_t i) { return 1 + j * n + i % n; };
  for (size_t i = 0; i < n; i++) {
    face(m, 0, v(0, i + 1), v(0, i));
    face(m, top, v(b - 2, i), v(b - 2, i + 1));
    for (size_t j = 0; j + 2 < b; j++) face(m, v(j, i), v(j, i + 1), v(j + 1, i + 1)), face(m, v(j, i), v(j + 1, i + 1), v(j + 1, i));
  }
  return m;
}

static MeshGL torus(double R, double r, size_t n, size_t s) {
  MeshGL m;
  m.numProp = 3;
  auto v = [n, s](size_t i, size_t j) { return (i % n) * s + j % s; };
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < s; j++) {
      double u = 2 * M_PI * (double)i / (double)n, w = 2 * M_PI * (double)j / (double)s, d = R + r * std::cos(w);
      corner(m, d * std::cos(u), d * std::sin(u), r * std::sin(w));
      face(m, v(i, j), v(i + 1, j), v(i + 1, j + 1));
      face(m, v(i, j), v(i + 1, j + 1), v(i, j + 1));
    }
  return m;
}

static MeshGL star(double ro, double ri, size_t points, double h, double twist, size_t s) {
  MeshGL m;
  m.numProp = 3;
  size_t k = 2 * points, low = (s + 1) * k;
  auto v = [k](size_t l, size_t i) { return l * k + i % k; };
  for (size_t l = 0; l <= s; l++)
    for (size_t i = 0; i < k; i++) {
      double a = M_PI / 180 * (180 * (double)i / (double)points + twist * (double)l / (double)s), q = i % 2 ? ri : ro;
      corner(m, q * std::cos(a), q * std::sin(a), h * (double)l / (double)s);
    }
  corner(m, 0, 0, 0);
  corner(m, 0, 0, h);
  for (size_t i = 0; i < k; i++) {
    face(m, low, v(0, i + 1), v(0, i));
    face(m, low + 1, v(s, i), v(s, i + 1));
    for (size_t l = 0; l < s; l++) face(m, v(l, i), v(l, i + 1), v(l + 1, i + 1)), face(m, v(l, i), v(l + 1, i + 1), v(l + 1, i));
  }
  return m;
}

static void prepare(Node &x) {
  if (x.op == "sphere") x.facets = sphere(x.n[0], (size_t)x.n[1]);
  if (x.op == "torus") x.facets = torus(x.n[0], x.n[1], (size_t)x.n[2], (size_t)x.n[3]);
  if (x.op == "startwist") x.facets = star(x.n[0], x.n[1], (size_t)x.n[2], x.n[3], x.n[4], (size_t)x.n[5]);
  for (auto &kid : x.kids) prepare(*kid);
}

static std::map<std::string, Manifold> defined;

static Manifold make(const Node &x) { // chains are hundreds deep, not more
  const std::vector<double> &n = x.n;
  if (x.op == "use") return defined.at(x.name);
  std::vector<Manifold> kids;
  for (auto &kid : x.kids) kids.push_back(make(*kid));
  if (x.op == "box") return Manifold::Cube({ n[0], n[1], n[2] });
  if (x.op == "cbox") return Manifold::Cube({ n[0], n[1], n[2] }, true);
  if (x.op == "cyl") return Manifold::Cylinder(n[0], n[1], n[2], (int)n[3]);
  if (x.op == "sphere" || x.op == "torus" || x.op == "startwist") return Manifold(x.facets);
  if (x.op == "translate") return kids[0].Translate({ n[0], n[1], n[2] });
  if (x.op == "rotate") return kids[0].Rotate(n[0], n[1], n[2]);
  if (x.op == "scale") return kids[0].Scale({ n[0], n[1], n[2] });
  if (x.op == "multmatrix") return kids[0].Transform(manifold::mat3x4({ n[0], n[4], n[8] }, { n[1], n[5], n[9] }, { n[2], n[6], n[10] }, { n[3], n[7], n[11] }));
  if (x.op == "union") return Manifold::BatchBoolean(kids, manifold::OpType::Add);
  if (x.op == "difference") return kids.size() > 1 ? Manifold::BatchBoolean(kids, manifold::OpType::Subtract) : kids[0];
  if (x.op == "intersection") return Manifold::BatchBoolean(kids, manifold::OpType::Intersect);
  std::fprintf(stderr, "unknown operation: %s\n", x.op.c_str());
  std::exit(1);
}

int main(int argc, char **argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: native FILE.sx\n"), 1;
  auto program = read(argv[1]);
  for (auto &form : program) prepare(*form);
  auto begin = std::chrono::steady_clock::now();
  Manifold result;
  for (auto &form : program) {
    if (form->op == "def") defined[form->name] = make(*form->kids.at(0));
    else result = make(*form);
  }
  MeshGL out = result.GetMeshGL();
  std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  std::printf("{\"seconds\": %.4f, \"triangles\": %zu}\n", spent.count(), (size_t)out.NumTri());
}
