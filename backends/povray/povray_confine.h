/* Owns the interface of povray_confine.c: the permissions of POV-Ray's process. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_CONFINE_H
#define VS_BACKENDS_POVRAY_POVRAY_CONFINE_H

/* Takes from this process, for good, the network and all writing except of files in the folder, as far as the system
 * can (Landlock, seccomp). Call it in a child before it becomes POV-Ray: it allocates nothing. */
void vs_povray_confine(const char *folder);

#endif
