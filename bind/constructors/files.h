/* Declares the reading of files that a program names for its geometry and its looks. */
#ifndef VS_BIND_CONSTRUCTORS_FILES_H
#define VS_BIND_CONSTRUCTORS_FILES_H

#include "model/node.h"
#include "vm/machine/native.h"
#include "geometry/light/panorama_sun.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;

/* All of a file beside the program that names it, as a bytevector; *shown: its name without folders, the store's. */
vs_status vs_bind_file(vs_args *f, const vs_arg *name, vs_value *bytes, const char **shown);
/* The PNG or JPEG picture of such a name, its name without folders, and its colour from afar. */
vs_status vs_bind_picture(vs_args *f, vs_value name, const vs_picture **out, const char **shown, double mean[3]);
/* A PNG, JPEG, EXR or HDR picture of a sky; *sunless: of the latter two, without the sun; NULL: there is none. */
vs_status vs_bind_sky_picture(vs_args *f, vs_value name, const vs_picture **out, const vs_picture **sunless,
                              vs_panorama_sun *sun);

/* The file of a lamp, checked. */
vs_status vs_bind_lamp_file(vs_args *f, vs_value name, const vs_picture **out);

#endif
