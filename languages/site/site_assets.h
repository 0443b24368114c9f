/* Declares the style and the script of `vs doc`'s pages. */
#ifndef VS_LANGUAGES_SITE_SITE_ASSETS_H
#define VS_LANGUAGES_SITE_SITE_ASSETS_H

extern const char know_site_style[], know_site_script[];

#endif
