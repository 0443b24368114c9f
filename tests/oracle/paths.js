// a hollow block, a hull of points in the air, and a mesh
geo_draw(geo_difference(geo_box([-2, -2, 0], [2, 2, 2]), geo_cylinder([0, 0, -1], [0, 0, 3], 1)));
geo_draw(geo_move(geo_hull([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]]), [-1, -1, 3]));
geo_draw(geo_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]));
geo_draw(geo_rotate(geo_extrude(geo_polygon([[3, 0], [4, 0], [3, 1]]), [0, 0, 2]), [0, 0, 0], [0, 0, 1], 0.5));
