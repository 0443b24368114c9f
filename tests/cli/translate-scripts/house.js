// A house, as a student writes it.
var storeys = gui_number(3, 1, 9, 1, "storeys");
var height = 3.2;
function sq(x) { return x * x; }
function slab(z) {
  if (z > 6) return geo_box([0, 0, z], [10, 8, z + 0.3]);
  else if (z == 0) { var t = 0.5; return geo_box([0, 0, -t], [10, 8, 0.3]); }
  return geo_box([0, 0, z], [10, 8, z + 0.2]);
}
for (var s = 0; s <= storeys; s++) {
  var z = s * height;
  geo_draw(slab(z));
  if (s < storeys) geo_draw(geo_move(geo_cylinder([0, 0, 0], [0, 0, height], sq(0.5)), [1, 1, z]));
}
geo_draw(geo_color(geo_difference(geo_sphere([20, 0, 0], 3), geo_cylinder([20, 0, -4], [20, 0, 4], 1)), 0.5, 0.2, 0.1));
geo_draw(geo_rotate(geo_scale(geo_tetrahedron([0,0,0],[1,0,0],[0,1,0],[0,0,1]), 2), [0,0,0], [0,0,1], Math.PI / 3));

function fibonacci(index) {
  switch (index) {
    case 0:
    case 1:
      return 1;
    default:
      return fibonacci(index - 2) + fibonacci(index - 1);
  }
}
// the paper's switch falls through
function foo(n) {
  switch (n) {
    case 1: return 1;
    case 3:
    case 2: return 2;
  }
  return 0;
}
[0, 2].map(function (i) { return fibonacci(i); }).forEach(function (h) { geo_draw(geo_box([30, 4 * h, 0], [31, 4 * h + 1, h + foo(3)])); });

function bar(n) {
  var more = 1;
  switch (n) { case 1: break; default: return 5; case 2: case 4: return 2 * more; }
  return n > 3 ? more : -more;
}
if (bar(1) == -1 && bar(4) === 2 && bar(9) != 4) geo_draw(geo_cone([40, 0, 0], [40, 0, 3], 2));
if (!bar(2) || storeys) geo_draw(geo_extrude([[50, 0], [52, 0], [51, 2]], [0, 0, 3]), geo_torus([60, 0, 0], 3, 1));
