// no node
print(geo_volume(geo_box([0, 0, 0], [1, 2, 3])), geo_area(geo_box([0, 0, 0], [1, 2, 3])));
print(geo_volume(geo_sphere([0, 0, 0], 1)), geo_volume(geo_cylinder([0, 0, 0], [0, 0, 2], 1)), geo_volume(geo_cone([0, 0, 0], [0, 0, 3], 1)));
print(geo_volume(geo_cone([0, 0], [0, 0, 3], 1, 1)).toFixed(9), geo_volume(geo_torus([0, 0, 0], 3, 1)));
var cube = geo_box([0, 0, 0], [2, 2, 2]), hole = geo_cylinder([1, 1, -1], [1, 1, 3], 0.5);
print(geo_volume(geo_difference(cube, hole)).toFixed(3), geo_volume(geo_intersection(cube, geo_move(cube, [1, 1, 1]))), geo_volume(geo_union([cube, [geo_move(cube, [3, 0, 0])]])));
print(geo_volume(geo_scale(cube, 2)), geo_volume(geo_scale(cube, [1, 2, 3])), geo_centroid(geo_move(cube, [1, 2, 3])));
print(geo_centroid(geo_rotate(cube, [0, 0, 0], [0, 0, 1], Math.PI)).join().replace("-1,-1", "turned"));
print(geo_volume(geo_tetrahedron([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1])) * 6, geo_volume(geo_hull([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])) * 6);
print(geo_volume(geo_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])) * 6);
print(geo_volume(geo_extrude([[0, 0], [2, 0], [2, 1], [0, 1]], 3)), geo_volume(geo_extrude(geo_polygon([[0, 0], [1, 0], [0, 1]]), [0, 0, 2])));
try { geo_sphere([0, 0, 0], -1); } catch (e) { print(e.message); }
try { geo_sphere("here", 1); } catch (e) { print(e.message); }
try { geo_box([0, 0, 0], [1, "a", 2]); } catch (e) { print(e.message); }
print(math_add([1, 2, 3], [1, 1, 1]), math_subtract([1, 2], [1, 1]), math_scale([1, 2, 3], 2), math_mix([0, 0, 0], [2, 4, 6], 0.5), math_dot([1, 2, 3], [4, 5, 6]));
print(math_length([3, 4]), math_normalize([0, 0, 2]), math_cross([1, 0, 0], [0, 1, 0]), math_radians(180), math_degrees(Math.PI));
print(utl_range(0, 3), utl_range(1, 2, 0.5), utl_fill(3, "x"), utl_is_array([]), utl_is_array({ length: 0 }));
var original = [1, [2]], copy = utl_copy(original); copy[0] = 5; print(original, copy);
try { utl_assert(1 == 2, "no"); } catch (e) { print(e.message); }
var depth = gui_number(3, 1, 9), kind = gui_choice("flat", ["flat", "round"]), label = gui_text("house");
print(depth + 1, typeof depth, kind, label);

// the Sierpinski tetrahedron
function divide(depth, a, b, c, d, parts) {
  if (depth == 0) { parts.push(geo_tetrahedron(a, b, c, d)); return; }
  var ab = math_mix(a, b, .5), ac = math_mix(a, c, .5), ad = math_mix(a, d, .5), bc = math_mix(b, c, .5), bd = math_mix(b, d, .5), cd = math_mix(c, d, .5);
  divide(depth - 1, a, ab, ac, ad, parts);
  divide(depth - 1, ab, b, bc, bd, parts);
  divide(depth - 1, ac, bc, c, cd, parts);
  divide(depth - 1, ad, bd, cd, d, parts);
}
function sierpinski(depth) { var parts = []; divide(depth, [1, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1], parts); return parts; }
var parts = sierpinski(5), whole = geo_volume(sierpinski(0)[0]);
print(parts.length, (geo_volume(geo_union(parts)) / whole * 32).toFixed(9));
function native_sum(list) {
  /*% (for/fold ([s 0]) ([x '(1 2 3)]) (+ s x)) %*/
}
print(native_sum([]) + 1);
function native_list() { /*% (list 1 "two" (list 3)) %*/ }
print(native_list().length, native_list());
