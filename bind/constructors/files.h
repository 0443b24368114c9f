/* Declares functions that read the mesh files and pictures that a program names. Implemented in files.c. */
#ifndef VS_BIND_CONSTRUCTORS_FILES_H
#define VS_BIND_CONSTRUCTORS_FILES_H

#include "model/node.h"
#include "vm/machine/native.h"
#include "geometry/light/panorama_sun.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;

/* Reads a file into a bytevector. Its name is relative to the folder of the program's file. Sets *shown to the file's
 * name without folders, owned by the store. */
vs_status vs_bind_file(vs_args *f, const vs_arg *name, vs_value *bytes, const char **shown);
/* Reads a PNG or JPEG picture. Sets *shown to the file's name without folders, and `mean` to the picture's mean
 * colour. */
vs_status vs_bind_picture(vs_args *f, vs_value name, const vs_picture **out, const char **shown, double mean[3]);
/* Reads a PNG, JPEG, EXR or HDR picture of a sky. For EXR and HDR, sets *sunless to the picture without its sun, or to
 * NULL if the picture shows no sun. */
vs_status vs_bind_sky_picture(vs_args *f, vs_value name, const vs_picture **out, const vs_picture **sunless,
                              vs_panorama_sun *sun);

/* Reads and checks a lamp file, which contains the intensities of a lamp in all directions. */
vs_status vs_bind_lamp_file(vs_args *f, vs_value name, const vs_picture **out);

#endif
