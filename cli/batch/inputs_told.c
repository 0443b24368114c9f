/* Passes messages between `vs render` and the processes that it starts, one for each run of a model. */
#define _GNU_SOURCE /* declares memfd_create */
#include "cli/batch/inputs_told.h"

#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static const char variable[] = "VS_BATCH_INPUTS", set_variable[] = "VS_BATCH_SET",
                  frames_variable[] = "VS_BATCH_FRAMES";

int cli_inputs_begin(void) {
  char number[24];
  int list = memfd_create("visualscheme-inputs", 0);
  if (list < 0) return -1;
  fcntl(list, F_SETFL, O_APPEND); /* appends each name at the end of the file, whose position all processes share */
  snprintf(number, sizeof number, "%d", list);
  if (setenv(variable, number, 1) == 0) return list;
  close(list);
  return -1;
}

void cli_inputs_hear(int list, vs_scheme *s) {
  struct stat is;
  if (list < 0 || fstat(list, &is) != 0 || is.st_size == 0) return;
  const char *names = mmap(NULL, (size_t)is.st_size, PROT_READ, MAP_SHARED, list, 0);
  if (names == MAP_FAILED) return;
  for (const char *at = names; at < names + is.st_size; at += strlen(at) + 1) vs_note_input(s, at);
  munmap((void *)(uintptr_t)names, (size_t)is.st_size);
}

void cli_inputs_say_typed(const char *set, const char *frames) {
  if (set) setenv(set_variable, set, 1);
  if (frames) setenv(frames_variable, frames, 1);
}

void cli_inputs_typed(const char *parameter, char *to, size_t room) {
  const char *set = getenv(set_variable), *frames = getenv(frames_variable);
  size_t length = strlen(parameter);
  snprintf(to, room, "-D %s", parameter);
  if (frames && !strcmp(frames, parameter)) snprintf(to, room, "--frames, parameter %s", parameter);
  for (const char *at = set; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL)
    if (!strncmp(at, parameter, length) && at[length] == '=') snprintf(to, room, "--set %s", set);
}

int cli_inputs_find(void) {
  const char *number = getenv(variable);
  int list = number ? atoi(number) : -1;
  unsetenv(variable);
  return list > STDERR_FILENO && fcntl(list, F_SETFD, FD_CLOEXEC) == 0 ? list : -1;
}

void cli_inputs_tell(int list, const vs_scheme *s) {
  const char *name;
  for (size_t i = 0; list >= 0 && (name = vs_input_name(s, i)) != NULL; i++)
    if (write(list, name, strlen(name) + 1) < 0) return;
}
