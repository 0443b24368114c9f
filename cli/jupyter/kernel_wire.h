/* Declares the messages of a notebook: sockets of ZeroMQ, and texts of JSON with signatures. */
#ifndef VS_CLI_JUPYTER_KERNEL_WIRE_H
#define VS_CLI_JUPYTER_KERNEL_WIRE_H

#include <pthread.h>
#include <stdio.h>

#include "cli/json_data.h"

typedef enum { WIRE_SHELL, WIRE_CONTROL, WIRE_STDIN, WIRE_IOPUB, WIRE_HEARTBEAT, WIRE_SOCKETS } wire_socket;

typedef struct {
  void *functions;            /* functions of the libraries libzmq and libnettle */
  cli_data_reader json;
  void *context, *sockets[WIRE_SOCKETS];
  pthread_t heart; bool beats; /* the thread that answers the notebook's heartbeat */
  char key[200], session[40];
  unsigned long sent;         /* number of messages sent */
} kernel_wire;

/* A part of a message: bytes with a final NUL. */
typedef struct { char *at; size_t length; } wire_part;

enum { WIRE_ADDRESSES = 8 };
typedef struct {
  wire_socket from;
  wire_part address[WIRE_ADDRESSES]; size_t addresses; /* the parts that address the sender of the message */
  wire_part header;           /* the header as received, which answers contain as their parent header */
  cli_data head, content;     /* header and content of the message as JSON values */
} wire_message;

/* Opens the sockets that the connection file names. Returns false after a message on standard error; *missing becomes
 * true if a library is missing. The caller calls wire_close in any case. */
bool wire_open(kernel_wire *w, const char *connection_file, bool *missing);
void wire_close(kernel_wire *w);
/* Waits at most `milliseconds` for a message. Returns false if no valid message came. After true, the caller calls
 * wire_message_free. */
bool wire_receive(kernel_wire *w, wire_message *m, int milliseconds);
void wire_message_free(kernel_wire *w, wire_message *m);
/* Sends a message to the sender of m. `content` is JSON. */
void wire_reply(kernel_wire *w, const wire_message *m, const char *type, const char *content);
/* Sends a message to all programs that listen to the kernel, on the socket IOPUB. */
void wire_publish(kernel_wire *w, const wire_message *m, const char *type, const char *content);

#endif
