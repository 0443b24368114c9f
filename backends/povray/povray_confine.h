/* Declares the confinement of POV-Ray's process. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_CONFINE_H
#define VS_BACKENDS_POVRAY_POVRAY_CONFINE_H

/* Removes from this process, permanently, the use of the network and all writing except in the folder, as far as the
 * system allows (Landlock, seccomp). Call it in a child process before exec: it allocates nothing. */
void vs_povray_confine(const char *folder);

#endif
