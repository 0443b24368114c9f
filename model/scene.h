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
  VS_VIEW_ALONG,   /* parallel projection in the direction from `eye` to `target` */
  VS_VIEW_PANORAMA /* a panorama of all directions from `eye`; `target` is in the centre of the picture */
} vs_view;

/* Whether, and where, a view cuts the model. */
typedef enum {
  VS_CUT_OWN, /* for a plan: a cut at a height that the format chooses */
  VS_CUT_NONE,
  VS_CUT_PLANE
} vs_cut;
/* A named view of a picture or a drawing. Lengths are in model units. */
typedef struct {
  const char *name;          /* name of the view, interned */
  vs_view view;
  vs_vec3 eye, target;       /* for VS_VIEW_CAMERA, VS_VIEW_ALONG and VS_VIEW_PANORAMA: position of the eye, and the
                              * point that is in the centre of the picture */
  double lens;               /* focal length in mm of an equal lens for 35 mm film */
  bool upright;              /* for VS_VIEW_CAMERA: true if vertical lines are vertical in the picture */
  double aperture;           /* for VS_VIEW_CAMERA: f-number of the lens, which blurs objects out of focus; 0:
                              * everything is in focus */
  vs_vec3 focus;             /* for VS_VIEW_CAMERA with an aperture: a point at the distance that is in focus */
  vs_cut cut;
  vs_vec3 cut_point, cut_normal; /* for VS_CUT_PLANE: a point of the cutting plane, and its unit normal towards the side
                                  * that is kept */
  double scale;              /* scale of a drawing: 100 means 1:100; 0: the largest round scale with which the drawing
                              * fits the sheet */
  const char *sheet;         /* name of the sheet from sheets.def, such as "A3"; "none": a sheet as large as the
                              * drawing, without a frame; NULL: the format chooses a sheet that fits */
  bool hidden;               /* true if the drawing shows hidden edges as dashed lines */
} vs_scene_view;

/* The notes that drawings show in addition to the model. */
typedef enum {
  VS_NOTE_DIMENSION /* a dimension, which shows the distance from point p to point q */,
  VS_NOTE_LABEL /* a label: a text at the point p */,
  VS_NOTE_LEVEL /* a level mark, which shows the height p.z at the point p */,
  VS_NOTE_AXIS /* an axis of the building's grid, from point p to point q */
} vs_note_kind;
typedef struct {
  vs_note_kind kind;
  vs_vec3 p, q;
  double offset;             /* distance of the dimension line from the points p and q, in model units; NAN if the
                              * format is to choose it */
  const char *text;          /* text of the note, interned; NULL: the text is the dimension's length or the level's
                              * height */
  const char *view;          /* name of the view that alone shows the note, interned; NULL: all suitable views show
                              * it */
} vs_scene_note;

/* A table beside the views on a sheet of drawings: rows of texts; the first row is the head. */
typedef struct {
  const char *title;         /* text above the table, interned; NULL if there is none */
  const char **cells;        /* texts of the cells: rows * columns, row by row, interned */
  size_t rows, columns;
} vs_scene_table;

/* A lamp: a point that emits light. */
typedef struct {
  vs_vec3 at, to;            /* at: position of the lamp; to: a point in its central direction, which goes downwards for
                              * a hanging lamp */
  double turn;               /* rotation in degrees about the lamp's direction, anticlockwise as seen from above a
                              * hanging lamp */
  const vs_picture *ies;     /* file (IES) with the lamp's luminous intensity in each direction; NULL: the intensity is
                              * equal in all directions */
  double lumens;             /* luminous flux in lumens, for a lamp without a file */
  double dim;                /* fraction of the luminous flux in the lamp's file that the lamp emits */
  vs_vec3 color;             /* colour of the light: linear RGB with luminance 1 */
} vs_scene_lamp;

/* The kinds of sky. All except the plain sky have luminances in cd/m2 (geometry/sky_light.h). */
typedef enum { VS_SKY_PLAIN, VS_SKY_CLEAR, VS_SKY_OVERCAST, VS_SKY_NIGHT } vs_sky_kind;

/* The look of pictures: which materials, sky and sun they show. VS_STYLE_OWN: those that the program has set. */
typedef enum {
  VS_STYLE_OWN,
#define STYLE(upper, name) VS_STYLE_##upper,
#include "model/styles.def"
#undef STYLE
  VS_STYLE_COUNT
} vs_scene_style;

/* The pen of a layer in drawings. */
typedef struct {
  const char *layer;         /* name of the layer, interned */
  bool colored;
  double color[3];           /* colour of the lines in sRGB, 0 to 1; used if `colored` is true */
  double line;               /* width of the lines in mm; 0: the width depends on the kind of each line */
} vs_scene_pen;

typedef struct {
  vs_store *store;           /* the store of the nodes, to which the scene holds a reference */
  vs_ref *drawn;             /* drawn references in drawing order; the scene holds a reference to each of their nodes */
  size_t drawn_count, drawn_room;
  const char *title;         /* name of the model file without its folder, or "model"; interned */
  bool looked;               /* true if the program set the camera by the procedure camera, view-from or zoom-extents */
  vs_view view;
  vs_vec3 eye, target;       /* for VS_VIEW_CAMERA and VS_VIEW_PANORAMA: position of the eye, and the point that is in
                              * the centre of the picture */
  double lens;               /* focal length in mm of an equal lens for 35 mm film; 35 by default */
  bool upright;              /* for VS_VIEW_CAMERA: true if vertical lines are vertical in the picture */
  double aperture;           /* for VS_VIEW_CAMERA: f-number of the lens, which blurs objects out of focus; 0:
                              * everything is in focus */
  vs_vec3 focus;             /* for VS_VIEW_CAMERA with an aperture: a point at the distance that is in focus */
  vs_scene_view *views;      /* named views in the order of their definitions */
  size_t view_count, view_room;
  vs_scene_note *notes;
  size_t note_count, note_room;
  vs_scene_table *tables;    /* tables on the sheet of drawings, from top to bottom */
  size_t table_count, table_room;
  vs_ref *faults;            /* objects that break a rule of the design: pictures show them in red, no format of solids
                              * contains them; the scene holds a reference to each of their nodes */
  size_t fault_count, fault_room;
  vs_scene_pen *pens;        /* pens of layers, at most one for each layer */
  size_t pen_count, pen_room;
  vs_scene_lamp *lamps;
  size_t lamp_count, lamp_room;
  bool has_sun;              /* true if the program set the sun; otherwise each format chooses a default */
  bool no_sun;               /* true if (sun #f) in the program turned the sun off */
  double sun_azimuth, sun_altitude; /* direction of the sun in degrees; azimuth clockwise from +Y, altitude above the
                                     * horizon */
  bool has_sky;
  double sky[3];             /* sRGB colour of the plain sky */
  vs_scene_style style;
  bool sky_given;            /* true if the program called the procedure sky */
  vs_sky_kind sky_kind;
  double turbidity;          /* haze of the air if sky_kind is VS_SKY_CLEAR, as turbidity (geometry/sky_light.h) */
  const vs_picture *sky_image; /* picture of the entire sky, twice as wide as high; NULL if there is none */
  const vs_picture *sky_sunless; /* the sky picture without its sun; NULL if the sky picture shows no sun */
  vs_vec3 picture_sun, picture_sun_light; /* picture_sun: unit vector towards the sun of the sky picture;
                                           * picture_sun_light: the sun's light on a surface perpendicular to it, as
                                           * picture values times solid angle */
  double fog_visibility;     /* distance, in model units, at which fog leaves a dark object 5 percent of its contrast;
                              * 0: no fog */
  double fog_height;         /* height above the ground, in model units, above which the fog becomes thinner; INFINITY:
                              * it is equally dense everywhere */
  const vs_material *fog_color; /* colour of the fog; NULL: the colour of the sky at the horizon */
  bool has_ground;
  double ground_z;
  const vs_material *ground_material; /* material of the ground; NULL if the program has set none */
  const char *units;         /* the model's unit: "m", "mm", "cm", "in" or "ft" */
  bool units_set;            /* whether the program has set the unit */
  double tolerance;          /* greatest distance of facets from curves, in model units; 0: geometry/tessellate.h
                              * computes it from the size of the object */
  int segments;              /* number of facets of a full turn, set by --segments; 0: the tolerance determines the
                              * number; below 0: the tolerance determines it, and -segments is its minimum */
} vs_scene;

void vs_scene_init(vs_scene *scene, vs_store *store); /* Sets a scene to an empty drawing with default settings. Retains
                                                       * the store. */
bool vs_scene_draw(vs_scene *scene, vs_ref ref);      /* Adds ref to the drawn references, and retains its node. Returns
                                                       * false when memory is out. */
double vs_scene_metres(const vs_scene *scene);        /* Returns the length of a model unit in metres. */
double vs_unit_metres(const char *unit);              /* Returns the length of a unit in metres; NAN if there is none
                                                       * with this name. */
/* Returns the static name of the unit of length at this index, or NULL at the end of the table. */
const char *vs_unit_at(size_t index);
void vs_scene_free(vs_scene *scene);
/* Adds a view, or replaces the view with the same name. The store interns the view's texts. Returns false when memory
 * is out. */
bool vs_scene_add_view(vs_scene *scene, const vs_scene_view *view);
bool vs_scene_add_lamp(vs_scene *scene, const vs_scene_lamp *lamp); /* Adds a lamp. Returns false when memory is out. */
bool vs_scene_add_note(vs_scene *scene, const vs_scene_note *note); /* Adds a note. Returns false when memory is out. */
/* Adds a copy of a table. Returns false when memory is out. */
bool vs_scene_add_table(vs_scene *scene, const vs_scene_table *table);
/* Adds a row of texts below the table with this title, which the scene contains. Returns false when memory is out. */
bool vs_scene_add_row(vs_scene *scene, const char *title, const char *const *cells);
/* Adds an object that breaks a rule, unless an equal one is there, and retains its node. Returns false when memory is
 * out. */
bool vs_scene_add_fault(vs_scene *scene, vs_ref ref);
/* Adds a pen, or replaces the pen of the same layer. Returns false when memory is out. */
bool vs_scene_add_pen(vs_scene *scene, const vs_scene_pen *pen);
/* Returns the pen of the layer, or NULL if the layer has no pen. */
const vs_scene_pen *vs_scene_find_pen(const vs_scene *scene, const char *layer);
/* Returns the view with the name, or NULL if there is none. */
const vs_scene_view *vs_scene_find_view(const vs_scene *scene, const char *name);
/* Returns the view that a picture shows by default: the first perspective, panorama or axonometry; if there is none,
 * the first view. Returns NULL if the program has set the camera or defined no view. */
const vs_scene_view *vs_scene_own_view(const vs_scene *scene);
/* Returns the name of a look of pictures, or NULL for VS_STYLE_OWN. */
const char *vs_scene_style_name(vs_scene_style style);
/* Returns the look of pictures with this name; VS_STYLE_OWN if there is none. */
vs_scene_style vs_scene_style_find(const char *name);
/* Sets the look of the scene, and the sky that belongs to this look: plain, overcast or night. */
void vs_scene_set_style(vs_scene *scene, vs_scene_style style);
/* Sets the scene's camera to that of the view. The cut of the view is left to the caller. */
void vs_scene_look(vs_scene *scene, const vs_scene_view *view);

#endif
