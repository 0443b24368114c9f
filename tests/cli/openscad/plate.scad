n = 3; // [1:5]
function f(a, b = 2) = a * b;
module post(h, r = 1) { cylinder(h = h, r = r, $fn = 16); if (h > 2) translate([0, 0, h]) sphere(r); }
difference() { cube([10, 10, 3], center = true); for (i = [0 : n]) translate([i * 2 - 3, 0, -2]) post(f(2), 0.5); }
echo(f(3), [for (i = [0 : 2]) i * i], sin(30), 1/3, n);
