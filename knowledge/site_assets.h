/* Owns the style and the script of `vs doc`'s pages. */
#ifndef VS_KNOWLEDGE_SITE_ASSETS_H
#define VS_KNOWLEDGE_SITE_ASSETS_H

extern const char know_site_style[], know_site_script[];

#endif
