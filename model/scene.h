/* Owns what a back-end is handed: the drawn references and how to look at them. Plain data. */
#ifndef VS_MODEL_SCENE_H
#define VS_MODEL_SCENE_H

#include "model/node.h"

typedef enum {
  VS_VIEW_EXTENTS,
  VS_VIEW_CAMERA,
  VS_VIEW_TOP,
  VS_VIEW_BOTTOM,
  VS_VIEW_FRONT,
  VS_VIEW_BACK,
  VS_VIEW_LEFT,
  VS_VIEW_RIGHT,
  VS_VIEW_ISO,
  VS_VIEW_ALONG,   /* parallel, from eye towards target */
  VS_VIEW_PANORAMA /* all round from eye, target in the middle */
} vs_view;

/* A view that the program named: how a picture or a drawing is looked at. Lengths in model units. */
typedef enum { VS_CUT_OWN /* of a plan alone: where the drawing finds best */, VS_CUT_NONE, VS_CUT_PLANE } vs_cut;
typedef struct {
  const char *name;          /* interned */
  vs_view view;
  vs_vec3 eye, target;       /* VS_VIEW_CAMERA, VS_VIEW_ALONG, VS_VIEW_PANORAMA */
  double lens;               /* mm, 35 mm equivalent */
  bool upright;              /* VS_VIEW_CAMERA: what is vertical stays so on the picture */
  double aperture;           /* VS_VIEW_CAMERA: the lens's f-number; 0: all is sharp */
  vs_vec3 focus;             /* with an aperture: what is as far away as this point is sharp */
  vs_cut cut;
  vs_vec3 cut_point, cut_normal; /* VS_CUT_PLANE: what lies on the normal's side is kept; unit */
  double scale;              /* of a drawing: 100 is 1:100; 0: a round one that fits */
  const char *sheet;         /* "A3", one of sheets.def; NULL: one that fits */
  bool hidden;               /* a drawing has its hidden edges dashed */
} vs_scene_view;

/* The things that drawings show besides the model. */
typedef enum {
  VS_NOTE_DIMENSION /* p to q */,
  VS_NOTE_LABEL /* at p */,
  VS_NOTE_LEVEL /* of height p.z */,
  VS_NOTE_AXIS /* p to q */
} vs_note_kind;
typedef struct {
  vs_note_kind kind;
  vs_vec3 p, q;
  double offset;             /* of a dimension: how far beside p and q its line runs; NAN: as the sheet finds best */
  const char *text;          /* interned, or NULL: the length, the height */
  const char *view;          /* interned: the one view that shows it; NULL: all that can */
} vs_scene_note;

/* A lamp: a point that shines. */
typedef struct {
  vs_vec3 at, to;            /* its middle direction, down of one that hangs, goes from at to to */
  double turn;               /* degrees round that direction, anticlockwise as seen from above a lamp that hangs */
  const vs_picture *ies;     /* the file of its intensities by direction; NULL: as bright all round */
  double lumens;             /* without a file */
  double dim;                /* with a file: the part of its light */
  vs_vec3 color;             /* of its light, linear, of luminance 1 */
} vs_scene_lamp;

typedef struct {
  vs_store *store;           /* retained */
  vs_ref *drawn;             /* in drawing order; nodes retained */
  size_t drawn_count, drawn_room;
  const char *title;         /* interned; the model file's name without folder, or "model" */
  bool looked;               /* the program said how: camera, view-from, zoom-extents */
  vs_view view;
  vs_vec3 eye, target;       /* VS_VIEW_CAMERA, VS_VIEW_PANORAMA */
  double lens;               /* mm, 35 mm equivalent; 35 by default */
  bool upright;              /* VS_VIEW_CAMERA: verticals stay vertical */
  double aperture;           /* VS_VIEW_CAMERA: f-number; 0: all is sharp */
  vs_vec3 focus;             /* with an aperture: a point as far away as what is sharp */
  vs_scene_view *views;      /* in the order they were named */
  size_t view_count, view_room;
  vs_scene_note *notes;
  size_t note_count, note_room;
  vs_scene_lamp *lamps;
  size_t lamp_count, lamp_room;
  bool has_sun;              /* else each back-end's pleasant default */
  double sun_azimuth, sun_altitude; /* degrees; azimuth clockwise from +Y */
  bool has_sky;
  double sky[3];             /* sRGB */
  double turbidity;          /* of the physical sky (geometry/sky_light.h); 0: none */
  const vs_picture *sky_image; /* the whole sky, twice as wide as high; NULL: none */
  const vs_picture *sky_sunless; /* the same without its sun; NULL: it has none */
  vs_vec3 picture_sun, picture_sun_light; /* unit, towards it; a surface square to it gets so much, in the picture's
                                           * numbers times solid angles */
  double fog_visibility;     /* so far away a dark thing has a twentieth of its contrast left; 0: no fog */
  double fog_height;         /* above the ground, from which on it thins out; INFINITY: never */
  const vs_material *fog_color; /* or NULL: as the sky at the horizon */
  bool has_ground;
  double ground_z;
  const vs_material *ground_material; /* or NULL */
  const char *units;         /* "m", "mm", "cm", "in", "ft" */
  double tolerance;          /* chord height in model units; 0: by the rule of geometry/tessellate.h */
  int segments;              /* 0: by tolerance; --segments */
} vs_scene;

void vs_scene_init(vs_scene *scene, vs_store *store); /* retains the store */
bool vs_scene_draw(vs_scene *scene, vs_ref ref);      /* retains; false: out of memory */
double vs_scene_metres(const vs_scene *scene);        /* how many metres a length of 1 is */
void vs_scene_free(vs_scene *scene);
/* Names a view; one of that name is replaced. The view's texts are interned in the store. False: out of memory. */
bool vs_scene_add_view(vs_scene *scene, const vs_scene_view *view);
bool vs_scene_add_lamp(vs_scene *scene, const vs_scene_lamp *lamp); /* false: out of memory */
bool vs_scene_add_note(vs_scene *scene, const vs_scene_note *note); /* false: out of memory */
/* The view of that name, or NULL. */
const vs_scene_view *vs_scene_find_view(const vs_scene *scene, const char *name);
/* The view that a picture without a word on it is taken by: the first that is a perspective or an axonometry, else the
 * first; NULL where the program said how to look, or named no view. */
const vs_scene_view *vs_scene_own_view(const vs_scene *scene);
/* Makes the scene look as the view says; its cut is the caller's to make. */
void vs_scene_look(vs_scene *scene, const vs_scene_view *view);

#endif
