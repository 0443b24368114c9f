$fn = 24;
module wheel(r, w) { rotate([90, 0, 0]) difference() { cylinder(h = w, r = r, center = true); for (a = [0 : 60 : 300]) rotate(a) translate([r / 2, 0, -w]) cylinder(h = 2 * w, d = r / 3); } }
module twice(d) { children(); translate([d, 0, 0]) children(0); }
twice(30) { wheel(10, 4); }
intersection() { sphere(5); cube(6, center = true); }
translate([0, 40, 0]) mirror([1, 1, 0]) scale([1, 2, 0.5]) cylinder(3, 2, 0);
translate([0, -40, 0]) hull() { sphere(2); translate([5, 5, 0]) cube(1); }
if ($children == undef) echo("none"); else echo("some");
function fact(n) = n < 2 ? 1 : n * fact(n - 1);
echo(fact(10), [for (i = 0; i < 3; i = i + 1) i], let(a = 2, b = a * a) b, str("a", [1, "b"]), [1, 2, 3] * 2, "x" + 1);
w = 1; echo(w, $fn, zz);
