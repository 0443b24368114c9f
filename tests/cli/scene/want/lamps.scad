// lamps: a program for OpenSCAD, made by VisualScheme

module part1() {
  union() {
    cylinder(h = 2, r = 0.05, $fn = 32);
    multmatrix([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 2], [0, 0, 0, 1]]) cylinder(h = 0.3, r1 = 0.2, r2 = 0, $fn = 32);
  }
}

translate([-1, -1, -0.1]) cube([9, 2, 0.1]);
part1();
translate([3, 0, 0])
  part1();
multmatrix([[2, 0, 0, 6], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]])
  part1();
