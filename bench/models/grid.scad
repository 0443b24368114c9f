// The same grid for OpenSCAD.
count = 50;
for (j = [0 : count - 1]) for (i = [0 : count - 1]) translate([3 * i, 3 * j, 0]) cylinder(h = 2, r = 1);
