/* Declares the drawing that a format receives: the drawn references, views, lamps, notes and settings. */
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
  VS_VIEW_ALONG,   /* parallel projection in the direction from eye to target */
  VS_VIEW_PANORAMA /* all directions from eye; target is in the centre of the picture */
} vs_view;

/* A named view of a picture or a drawing. Lengths are in model units. */
typedef enum { VS_CUT_OWN /* of a plan: the format chooses its height */, VS_CUT_NONE, VS_CUT_PLANE } vs_cut;
typedef struct {
  const char *name;          /* name of the view, interned */
  vs_view view;
  vs_vec3 eye, target;       /* for VS_VIEW_CAMERA, VS_VIEW_ALONG and VS_VIEW_PANORAMA */
  double lens;               /* focal length in mm, for film of 35 mm */
  bool upright;              /* VS_VIEW_CAMERA: whether vertical lines are vertical in the picture */
  double aperture;           /* VS_VIEW_CAMERA: f-number of the lens; 0: everything is in focus */
  vs_vec3 focus;             /* a point at the distance that is in focus; used if aperture is not 0 */
  vs_cut cut;
  vs_vec3 cut_point, cut_normal; /* VS_CUT_PLANE: a point of the plane, and the unit normal towards the kept side */
  double scale;              /* scale of a drawing: 100 is 1:100; 0: a round scale that fits */
  const char *sheet;         /* name from sheets.def, such as "A3"; "none": as large as the drawing, without a frame;
                              * NULL: a sheet that fits */
  bool hidden;               /* whether the drawing shows hidden edges as dashed lines */
} vs_scene_view;

/* The notes that drawings show in addition to the model. */
typedef enum {
  VS_NOTE_DIMENSION /* a dimension: the distance from p to q */,
  VS_NOTE_LABEL /* a label: a text at p */,
  VS_NOTE_LEVEL /* level mark of the height p.z */,
  VS_NOTE_AXIS /* a grid axis from p to q */
} vs_note_kind;
typedef struct {
  vs_note_kind kind;
  vs_vec3 p, q;
  double offset;             /* distance of the dimension line from p and q; NAN: chosen when the sheet is drawn */
  const char *text;          /* interned text; NULL: the length or the height as text */
  const char *view;          /* name of the only view that shows the note, interned; NULL: all views that can */
} vs_scene_note;

/* A lamp: a point that emits light. */
typedef struct {
  vs_vec3 at, to;            /* the direction of the lamp's centre goes from `at` to `to`; it is downwards for a hanging
                              * lamp */
  double turn;               /* rotation in degrees about the lamp's direction, anticlockwise as seen from above a
                              * hanging lamp */
  const vs_picture *ies;     /* file of the intensities by direction; NULL: equal in all directions */
  double lumens;             /* luminous flux of a lamp without a file */
  double dim;                /* fraction of the light of its file that the lamp emits */
  vs_vec3 color;             /* colour of the light: linear RGB, of luminance 1 */
} vs_scene_lamp;

/* The pen of a layer in drawings. */
typedef struct {
  const char *layer;         /* interned */
  bool colored;
  double color[3];           /* sRGB, 0 to 1, if colored */
  double line;               /* the width in mm; 0: by the kind of line */
} vs_scene_pen;

typedef struct {
  vs_store *store;           /* the store of the nodes, retained */
  vs_ref *drawn;             /* drawn references in drawing order; their nodes are retained */
  size_t drawn_count, drawn_room;
  const char *title;         /* name of the model file without its folder, or "model"; interned */
  bool looked;               /* whether the program set the view: by camera, view-from or zoom-extents */
  vs_view view;
  vs_vec3 eye, target;       /* used by VS_VIEW_CAMERA and VS_VIEW_PANORAMA */
  double lens;               /* focal length in mm, for film of 35 mm; 35 by default */
  bool upright;              /* VS_VIEW_CAMERA: whether vertical lines are vertical in the picture */
  double aperture;           /* VS_VIEW_CAMERA: f-number of the lens; 0: everything is in focus */
  vs_vec3 focus;             /* a point at the distance that is in focus; used if aperture is not 0 */
  vs_scene_view *views;      /* named views in the order of their definitions */
  size_t view_count, view_room;
  vs_scene_note *notes;
  size_t note_count, note_room;
  vs_scene_pen *pens;        /* one for a layer at most */
  size_t pen_count, pen_room;
  vs_scene_lamp *lamps;
  size_t lamp_count, lamp_room;
  bool has_sun;              /* whether the program set the sun; if not, each format chooses a default */
  double sun_azimuth, sun_altitude; /* in degrees; azimuth clockwise from +Y */
  bool has_sky;
  double sky[3];             /* sRGB colour of the sky */
  double turbidity;          /* turbidity of the physical sky (geometry/sky_light.h); 0: no physical sky */
  const vs_picture *sky_image; /* picture of the whole sky, twice as wide as high; NULL: none */
  const vs_picture *sky_sunless; /* the sky picture without its sun; NULL if it shows no sun */
  vs_vec3 picture_sun, picture_sun_light; /* unit vector towards the sky picture's sun; its light on a surface
                                           * perpendicular to it, as picture values times solid angle */
  double fog_visibility;     /* distance at which a dark object has 5 percent of its contrast; 0: no fog */
  double fog_height;         /* height above the ground from which the fog thins; INFINITY: nowhere */
  const vs_material *fog_color; /* NULL: the colour of the sky at the horizon */
  bool has_ground;
  double ground_z;
  const vs_material *ground_material; /* material of the ground; NULL if none was set */
  const char *units;         /* the model's unit: "m", "mm", "cm", "in" or "ft" */
  double tolerance;          /* greatest deviation of facets from curves, in model units; 0: by the rule of
                              * geometry/tessellate.h */
  int segments;              /* facets of a full turn, set by --segments; 0: by the tolerance; below 0: the same, and
                              * -segments is the least number */
} vs_scene;

void vs_scene_init(vs_scene *scene, vs_store *store); /* Sets the defaults of an empty drawing; retains the store. */
bool vs_scene_draw(vs_scene *scene, vs_ref ref);      /* Adds ref and retains its node. Returns false when memory is
                                                       * out. */
double vs_scene_metres(const vs_scene *scene);        /* Returns the length of a model unit in metres. */
void vs_scene_free(vs_scene *scene);
/* Adds a view, or replaces the view of the same name. The store interns the view's texts. Returns false when memory is
 * out. */
bool vs_scene_add_view(vs_scene *scene, const vs_scene_view *view);
bool vs_scene_add_lamp(vs_scene *scene, const vs_scene_lamp *lamp); /* Adds a lamp. Returns false when memory is out. */
bool vs_scene_add_note(vs_scene *scene, const vs_scene_note *note); /* Adds a note. Returns false when memory is out. */
/* Adds a pen, which replaces that of the same layer. Returns false when memory is out. */
bool vs_scene_add_pen(vs_scene *scene, const vs_scene_pen *pen);
/* Returns the pen of the layer, or NULL. */
const vs_scene_pen *vs_scene_find_pen(const vs_scene *scene, const char *layer);
/* Returns the view of that name, or NULL. */
const vs_scene_view *vs_scene_find_view(const vs_scene *scene, const char *name);
/* Returns the default view of a picture: the first perspective, panorama or axonometry, else the first view. Returns
 * NULL if the program set the camera or defined no view. */
const vs_scene_view *vs_scene_own_view(const vs_scene *scene);
/* Sets the scene's camera to that of the view. The caller applies the view's cut. */
void vs_scene_look(vs_scene *scene, const vs_scene_view *view);

#endif
