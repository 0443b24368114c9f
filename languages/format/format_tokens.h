/* Declares a program's text as a row of tokens, comments among them, and the lists that they form. */
#ifndef VS_LANGUAGES_FORMAT_FORMAT_TOKENS_H
#define VS_LANGUAGES_FORMAT_FORMAT_TOKENS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
  FORMAT_TOKEN_OPEN,   /* ( [ #( #u8( */
  FORMAT_TOKEN_CLOSE,
  FORMAT_TOKEN_ATOM,   /* a name, number, string, character, or the . of a pair */
  FORMAT_TOKEN_PREFIX, /* ' ` , ,@ #; and #0= */
  FORMAT_TOKEN_LINE,   /* a comment to the end of its line; also #lang, and #! in the first line */
  FORMAT_TOKEN_BLOCK   /* #| ... |# */
} format_kind;

typedef struct {
  uint32_t from, to;       /* range of the token in the text, in bytes */
  uint32_t list;           /* the list that contains the token; for brackets, the list that they enclose */
  uint32_t lines;          /* number of line ends between the previous token and this token */
  uint32_t source_column;  /* column in the text, from 0, in characters */
  uint32_t line, column, end; /* result of the layout, all from 0: line: line of the token's beginning; column: its
                               * first column; end: the column after it */
  uint8_t kind;
  bool breaks;             /* whether a line begins with the token */
  bool leads;              /* whether the token begins an element of its list, because no prefix precedes the token */
  uint32_t nth;            /* number, from 0, of the element to which the token belongs; for a comment, that of the next
                            * element */
} format_token;

typedef struct {
  uint32_t parent, depth, elements;
  uint32_t open;           /* index of the opening bracket's token; unused for list 0, which is the whole text */
  uint32_t column, content; /* result of the layout: column: that of the opening bracket; content: that of the first
                             * element */
  uint32_t first_argument; /* result of the layout: column of the second element, if it is on the line of the first;
                            * otherwise 0 */
  uint8_t style, leading;
  bool data;               /* whether the list is quoted */
  bool flat;               /* whether all elements are atoms */
} format_list;

typedef struct {
  const char *text;
  size_t length;
  format_token *tokens; size_t count, room;
  format_list *lists; size_t list_count, list_room;
} format_tokens;

typedef enum { FORMAT_STYLE_CALL, FORMAT_STYLE_BODY, FORMAT_STYLE_NAMED, FORMAT_STYLE_DATA } format_style;

/* Reads the text into tokens and lists. Returns false when memory is out. In either case the caller frees them by
 * format_tokens_free. */
bool format_tokens_read(format_tokens *t, const char *text, size_t length);
void format_tokens_free(format_tokens *t);
/* Returns true if both texts have the same tokens in the same order. */
bool format_tokens_equal(const format_tokens *a, const format_tokens *b);

#endif
