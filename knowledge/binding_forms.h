/* Owns what each form of the language does with the names in it. */
#ifndef VS_KNOWLEDGE_BINDING_FORMS_H
#define VS_KNOWLEDGE_BINDING_FORMS_H

#include "knowledge/name_walk.h"

/* 1 + the row of the language's form of that name; 0: there is none. */
uint16_t know_form_row(const char *name);
/* Does the form define names where it stands, or structure the program: is it for bodies to look at first? */
bool know_form_defines(uint16_t row);
bool know_form_splices(uint16_t row); /* begin: its parts stand where it stands */
/* A defining form in a body: its names are bound in scope, and what it evaluates is left for later. */
void know_form_declare(know_walk *w, know_index node, know_index scope, uint16_t row);
/* Any other form: binds and goes on with its parts. */
void know_form_walk(know_walk *w, know_index node, know_index scope, uint16_t row);

#endif
