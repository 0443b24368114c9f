/* Declares the start of a browser for a live view. */
#ifndef VS_LIVE_OPEN_BROWSER_H
#define VS_LIVE_OPEN_BROWSER_H

/* Opens an address in a browser. Tries the commands of $BROWSER, separated by colons, and uses the first that exists.
 * Without $BROWSER it uses xdg-open if there is a screen. */
void live_open_browser(const char *address);

#endif
