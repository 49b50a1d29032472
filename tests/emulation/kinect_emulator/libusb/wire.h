/* The socket to the emulator: calls that wait for an answer, events that come by
 * themselves. All numbers are little-endian, as on the machines this runs on.
 */
#ifndef WIRE_H
#define WIRE_H

#include "abi.h"
#include <pthread.h>

enum operation {
    OP_LIST = 1,
    OP_OPEN,
    OP_CLOSE,
    OP_CLAIM,
    OP_RELEASE,
    OP_ALTERNATE,
    OP_DRIVEN,
    OP_DETACH,
    OP_CONTROL,
    OP_SUBMIT,
    OP_CANCEL,
    OP_ATTACH
};

struct request {
    uint32_t operation;
    int32_t number; /* a handle or an address */
    uint32_t argument[4];
    uint32_t size; /* of what follows */
};

struct response {
    int32_t result;
    uint32_t size; /* of what follows */
};

/* A transfer has ended: this, `packets` lengths and `size` bytes of data. */
struct event {
    uint64_t cookie;
    int32_t status, packet_status;
    uint32_t packets, size;
};

struct device;

struct context {
    int calls, events, wake[2];
    pthread_mutex_t calling, handling;
    struct device *known;
};

/* Connect both sockets; OK or ERROR_OTHER if there is no emulator. */
int wire_open(struct context *context);
void wire_close(struct context *context);

/* Send a request and wait for its answer. The result is the emulator's, the bytes that
 * came with it are in `answer`, `*room` becomes how many they are. */
int wire_call(struct context *context, struct request request, const void *data,
              void *answer, uint32_t *room);

/* Read just so many bytes; 0, or -1 if the emulator is gone. */
int wire_read(int socket, void *bytes, size_t size);

#endif
