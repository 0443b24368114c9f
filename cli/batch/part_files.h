/* Declares hashes of bytes, names of files for sets of parameters, and the text of contact sheets. */
#ifndef VS_CLI_BATCH_PART_FILES_H
#define VS_CLI_BATCH_PART_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#define CLI_HASH_BEGIN UINT64_C(0xcbf29ce484222325)
/* Returns the hash of the bytes (FNV-1a), continued from the hash h of the bytes before. h is CLI_HASH_BEGIN at the
 * first bytes. */
uint64_t cli_part_hash(uint64_t h, const void *bytes, size_t count);
bool cli_part_hash_file(const char *path, uint64_t *out); /* returns false if the file cannot be read */

/* Appends the text to `to`, with stem "name" for "models/name.vs". Replaces characters that a file name cannot
 * contain. */
void cli_part_put_word(char *to, size_t room, const char *text, bool stem);
/* Appends the set to a file name: "r=4,n=2". A long set, or one with characters that a name cannot contain, is replaced
 * by a number, so that names of different sets always differ. */
void cli_part_put_set(char *to, size_t room, const char *set);

void cli_part_html(FILE *to, const char *text); /* writes the text as HTML */
/* Writes the address of a file for a page: relative to the page's folder, or absolute if the file is elsewhere. */
void cli_part_link(FILE *to, const char *file, const char *page);

#endif
