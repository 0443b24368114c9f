// The Sierpinski tetrahedron of Euclides: each tetrahedron gives way to four of half its size, as often as `depth` says.
// vs sierpinski.js -D depth=3 -o sierpinski.stl

var depth = gui_number(5, 0, 7, 1, "subdivision depth");

function middle(a, b) { return math_mix(a, b, 0.5); }

function divide(depth, a, b, c, d, parts) {
  if (depth == 0) {
    parts.push(geo_tetrahedron(a, b, c, d));
    return;
  }
  var ab = middle(a, b), ac = middle(a, c), ad = middle(a, d), bc = middle(b, c), bd = middle(b, d), cd = middle(c, d);
  divide(depth - 1, a, ab, ac, ad, parts);
  divide(depth - 1, ab, b, bc, bd, parts);
  divide(depth - 1, ac, bc, c, cd, parts);
  divide(depth - 1, ad, bd, cd, d, parts);
}

function sierpinski(depth) {
  var parts = [];
  divide(depth, [1, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1], parts);
  return parts;
}

var parts = sierpinski(depth), whole = geo_volume(sierpinski(0)[0]), sum = 0;
for (var i = 0; i < parts.length; i++) sum += geo_volume(parts[i]);
io_stdout_writeln(parts.length + " tetrahedra with " + sum / whole + " of the volume");
geo_draw(geo_color(geo_union(parts), "goldenrod"));
