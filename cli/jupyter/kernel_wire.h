/* Declares the messages of a notebook: sockets of ZeroMQ, and texts of JSON with signatures. */
#ifndef VS_CLI_JUPYTER_KERNEL_WIRE_H
#define VS_CLI_JUPYTER_KERNEL_WIRE_H

#include <pthread.h>
#include <stdio.h>

#include "cli/json_data.h"

typedef enum { WIRE_SHELL, WIRE_CONTROL, WIRE_STDIN, WIRE_IOPUB, WIRE_HEARTBEAT, WIRE_SOCKETS } wire_socket;

typedef struct {
  void *functions;            /* functions of the libraries */
  cli_data_reader json;
  void *context, *sockets[WIRE_SOCKETS];
  pthread_t heart; bool beats; /* the thread that answers the heartbeat */
  char key[200], session[40];
  unsigned long sent;         /* number of messages sent */
} kernel_wire;

/* A part of a message: bytes with a final NUL. */
typedef struct { char *at; size_t length; } wire_part;

enum { WIRE_ADDRESSES = 8 };
typedef struct {
  wire_socket from;
  wire_part address[WIRE_ADDRESSES]; size_t addresses; /* the sender */
  wire_part header;           /* the header as it came, the parent of answers */
  cli_data head, content;     /* header and content as data */
} wire_message;

/* Opens the sockets that the connection file names. Returns false after a message on standard error; *missing tells
 * whether a library is missing. In any case the caller calls wire_close. */
bool wire_open(kernel_wire *w, const char *connection_file, bool *missing);
void wire_close(kernel_wire *w);
/* Waits for a message, at most `milliseconds`. Returns false if none came, or one that is no message of ours. The
 * caller calls wire_message_free after true. */
bool wire_receive(kernel_wire *w, wire_message *m, int milliseconds);
void wire_message_free(kernel_wire *w, wire_message *m);
/* Send a message with this content, which is JSON: to the sender of m, or to all on the socket IOPUB. */
void wire_reply(kernel_wire *w, const wire_message *m, const char *type, const char *content);
void wire_publish(kernel_wire *w, const wire_message *m, const char *type, const char *content);

#endif
