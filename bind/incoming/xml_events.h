/* Declares the reading of XML files, implemented in xml_events.c. */
#ifndef VS_BIND_INCOMING_XML_EVENTS_H
#define VS_BIND_INCOMING_XML_EVENTS_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

/* Returns the list of an XML file's events in reverse order: (line name (attribute . text) ...) for the start of an
 * element, #f for its end, and a string for text. Names are symbols, without their namespaces. */
vs_status vs_xml_events(vs_scheme *vm, vs_value path, vs_value *out);

/* Returns the events of a text, for errors from the file `path`. meshes: true if the elements `vertex` and `triangle`
 * of 3MF make no events. Their numbers are then events before the end of `vertices` and `triangles`: a bytevector of
 * doubles, three for each vertex, and five for each triangle (v1 v2 v3 pid p1; -1: no such attribute). */
vs_status vs_xml_text_events(vs_scheme *vm, vs_value path, const vs_text *text, bool meshes, vs_value *out);

#endif
