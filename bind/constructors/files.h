/* Owns the interface of files.c: the reading of a program's files for geometry and looks. */
#ifndef VS_BIND_CONSTRUCTORS_FILES_H
#define VS_BIND_CONSTRUCTORS_FILES_H

#include "model/node.h"
#include "vm/machine/native.h"
#include "geometry/light/panorama_sun.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;

/* Reads a file, named relative to the program, into a bytevector. *shown: its name without folders, owned by the
 * store. */
vs_status vs_bind_file(vs_args *f, const vs_arg *name, vs_value *bytes, const char **shown);
/* Reads the PNG or JPEG picture of this name. *shown: its name without folders; mean: its mean colour. */
vs_status vs_bind_picture(vs_args *f, vs_value name, const vs_picture **out, const char **shown, double mean[3]);
/* Reads a PNG, JPEG, EXR or HDR picture of a sky. *sunless: an EXR or HDR picture without its sun; NULL if it has
 * none. */
vs_status vs_bind_sky_picture(vs_args *f, vs_value name, const vs_picture **out, const vs_picture **sunless,
                              vs_panorama_sun *sun);

/* Reads and checks the file of a lamp. */
vs_status vs_bind_lamp_file(vs_args *f, vs_value name, const vs_picture **out);

#endif
