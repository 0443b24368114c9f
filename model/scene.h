/* Owns the drawing that a back-end receives: the drawn references and the views. Plain data. */
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
  VS_VIEW_PANORAMA /* all directions from eye, target in the centre */
} vs_view;

/* A named view of a picture or a drawing. Lengths in model units. */
typedef enum { VS_CUT_OWN /* only of a plan: the drawing chooses the height */, VS_CUT_NONE, VS_CUT_PLANE } vs_cut;
typedef struct {
  const char *name;          /* interned */
  vs_view view;
  vs_vec3 eye, target;       /* VS_VIEW_CAMERA, VS_VIEW_ALONG, VS_VIEW_PANORAMA */
  double lens;               /* mm, 35 mm equivalent */
  bool upright;              /* VS_VIEW_CAMERA: verticals remain vertical on the picture */
  double aperture;           /* VS_VIEW_CAMERA: the lens's f-number; 0: everything is in focus */
  vs_vec3 focus;             /* with an aperture: a point at the distance that is in focus */
  vs_cut cut;
  vs_vec3 cut_point, cut_normal; /* VS_CUT_PLANE: the side of the normal is kept; the normal is unit */
  double scale;              /* of a drawing: 100 is 1:100; 0: a round one that fits */
  const char *sheet;         /* "A3", a name of sheets.def; NULL: one that fits */
  bool hidden;               /* the drawing has hidden edges as dashed lines */
} vs_scene_view;

/* The notes that drawings show in addition to the model. */
typedef enum {
  VS_NOTE_DIMENSION /* p to q */,
  VS_NOTE_LABEL /* at p */,
  VS_NOTE_LEVEL /* of height p.z */,
  VS_NOTE_AXIS /* p to q */
} vs_note_kind;
typedef struct {
  vs_note_kind kind;
  vs_vec3 p, q;
  double offset;             /* of a dimension: the distance of its line from p and q; NAN: the sheet chooses */
  const char *text;          /* interned, or NULL: the length or the height */
  const char *view;          /* interned: the only view that shows it; NULL: all that can */
} vs_scene_note;

/* A lamp: a point that emits light. */
typedef struct {
  vs_vec3 at, to;            /* its centre direction, downwards for a hanging lamp, goes from `at` to `to` */
  double turn;               /* degrees around that direction, anticlockwise as seen from above a hanging lamp */
  const vs_picture *ies;     /* the file of its intensities by direction; NULL: equal in all directions */
  double lumens;             /* without a file */
  double dim;                /* with a file: the fraction of its light */
  vs_vec3 color;             /* of its light, linear, of luminance 1 */
} vs_scene_lamp;

typedef struct {
  vs_store *store;           /* retained */
  vs_ref *drawn;             /* in drawing order; nodes retained */
  size_t drawn_count, drawn_room;
  const char *title;         /* interned; the model file's name without folder, or "model" */
  bool looked;               /* the program set the view: camera, view-from, zoom-extents */
  vs_view view;
  vs_vec3 eye, target;       /* VS_VIEW_CAMERA, VS_VIEW_PANORAMA */
  double lens;               /* mm, 35 mm equivalent; 35 by default */
  bool upright;              /* VS_VIEW_CAMERA: verticals stay vertical */
  double aperture;           /* VS_VIEW_CAMERA: f-number; 0: everything is in focus */
  vs_vec3 focus;             /* with an aperture: a point at the distance that is in focus */
  vs_scene_view *views;      /* in the order of their definitions */
  size_t view_count, view_room;
  vs_scene_note *notes;
  size_t note_count, note_room;
  vs_scene_lamp *lamps;
  size_t lamp_count, lamp_room;
  bool has_sun;              /* else each back-end chooses a default */
  double sun_azimuth, sun_altitude; /* degrees; azimuth clockwise from +Y */
  bool has_sky;
  double sky[3];             /* sRGB */
  double turbidity;          /* of the physical sky (geometry/sky_light.h); 0: none */
  const vs_picture *sky_image; /* the whole sky, twice as wide as high; NULL: none */
  const vs_picture *sky_sunless; /* the same without its sun; NULL: it has no sun */
  vs_vec3 picture_sun, picture_sun_light; /* unit vector towards it; the light on a surface perpendicular to it, in the
                                           * picture's numbers times solid angles */
  double fog_visibility;     /* the distance at which a dark object has a twentieth of its contrast; 0: no fog */
  double fog_height;         /* the height above the ground at which the fog begins to thin; INFINITY: never */
  const vs_material *fog_color; /* or NULL: that of the sky at the horizon */
  bool has_ground;
  double ground_z;
  const vs_material *ground_material; /* or NULL */
  const char *units;         /* "m", "mm", "cm", "in", "ft" */
  double tolerance;          /* chord height in model units; 0: by the rule of geometry/tessellate.h */
  int segments;              /* 0: by tolerance; --segments */
} vs_scene;

void vs_scene_init(vs_scene *scene, vs_store *store); /* retains the store */
bool vs_scene_draw(vs_scene *scene, vs_ref ref);      /* retains; false: out of memory */
double vs_scene_metres(const vs_scene *scene);        /* the length of a model unit in metres */
void vs_scene_free(vs_scene *scene);
/* Adds a view, which replaces one of the same name. The store interns the view's texts. Returns false when memory is
 * out. */
bool vs_scene_add_view(vs_scene *scene, const vs_scene_view *view);
bool vs_scene_add_lamp(vs_scene *scene, const vs_scene_lamp *lamp); /* false: out of memory */
bool vs_scene_add_note(vs_scene *scene, const vs_scene_note *note); /* false: out of memory */
/* Returns the view of that name, or NULL. */
const vs_scene_view *vs_scene_find_view(const vs_scene *scene, const char *name);
/* Returns the default view of a picture: the first that is a perspective, a panorama or an axonometry, else the first;
 * NULL if the program set the camera, or named no view. */
const vs_scene_view *vs_scene_own_view(const vs_scene *scene);
/* Sets the scene's camera to that of the view; the caller makes the view's cut. */
void vs_scene_look(vs_scene *scene, const vs_scene_view *view);

#endif
