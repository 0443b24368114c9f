/* Declares the processing of POV-Ray's picture: joining its parts, and writing them as .exr or .png. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_PICTURE_H
#define VS_BACKENDS_POVRAY_POVRAY_PICTURE_H

#include "backends/povray/povray_plan.h"

/* folder: folder that contains the pictures of all runs (processes) of POV-Ray. tone: conversion of light to the values
 * of a .png. */
typedef struct { const char *folder; const vs_povray_plan *plan; const vs_tone *tone; } vs_povray_result;

/* Joins the plan's picture and writes it as an EXR to the existing file `to`, without a date, with the layers that the
 * options select. */
bool vs_povray_take_picture(vs_emitter *e, const vs_povray_result *r, const char *to);
/* Joins the plan's picture and writes it as a PNG, converted by r->tone. */
bool vs_povray_develop_picture(vs_emitter *e, const vs_povray_result *r, const char *to);
/* Computes the exposure of the whole picture from the small picture of the plan's first pass. */
bool vs_povray_meter(vs_emitter *e, const char *folder, const vs_povray_plan *plan, vs_tone_curve curve, double *stops);

#endif
