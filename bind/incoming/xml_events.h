/* Declares the reading of XML files, implemented in xml_events.c. */
#ifndef VS_BIND_INCOMING_XML_EVENTS_H
#define VS_BIND_INCOMING_XML_EVENTS_H

#include "vm/machine/native.h"

/* Returns the list of an XML file's events in reverse order: (line name (attribute . text) ...) for the start of an
 * element, #f for its end, and a string for text. Names are symbols, without their namespaces. */
vs_status vs_xml_events(vs_scheme *vm, vs_value path, vs_value *out);

#endif
