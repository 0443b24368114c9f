/*@
euclides.suppress_warning_unreferenced_object.io_write;
*/
function io_write(msg) { io_stdout_write(msg); }
function other(msg) { io_stdout_write(msg); }
geo_draw(geo_sphere([0, 0, 0], 1));
