/* Declares the reading of XML files, implemented in xml_events.c. */
#ifndef VS_BIND_INCOMING_XML_EVENTS_H
#define VS_BIND_INCOMING_XML_EVENTS_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

/* Sets *out to a list of the events of an XML file in reverse order. An event is (line name (attribute . text) ...) for
 * the start of an element, #f for its end, and a string for text. Names are symbols, without prefixes of namespaces. */
vs_status vs_xml_events(vs_scheme *vm, vs_value path, vs_value *out);

/* Sets *out to the events of an XML text; errors name the file `path`. meshes: the elements `vertex` and `triangle`
 * of 3MF create no events of their own. Their numbers are an event before the end of `vertices` or `triangles`: a
 * bytevector of doubles, three for each vertex, five for each triangle (v1 v2 v3 pid p1; -1 for a missing
 * attribute). */
vs_status vs_xml_text_events(vs_scheme *vm, vs_value path, const vs_text *text, bool meshes, vs_value *out);

#endif
