#include "wire.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

enum { KIND_CALLS = 0, KIND_EVENTS = 1 };

int wire_read(int socket, void *bytes, size_t size)
{
    char *next = bytes;
    while (size > 0) {
        ssize_t came = read(socket, next, size);
        if (came < 0 && errno == EINTR)
            continue;
        if (came <= 0)
            return -1;
        next += came;
        size -= (size_t)came;
    }
    return 0;
}

static int wire_write(int socket, const void *bytes, size_t size)
{
    const char *next = bytes;
    while (size > 0) {
        ssize_t went = send(socket, next, size, MSG_NOSIGNAL);
        if (went < 0 && errno == EINTR)
            continue;
        if (went <= 0)
            return -1;
        next += went;
        size -= (size_t)went;
    }
    return 0;
}

/* One connection; the token tells the emulator which two belong together. */
static int connect_one(const char *path, uint32_t kind, uint64_t token)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    if (strlen(path) >= sizeof address.sun_path)
        return -1;
    strcpy(address.sun_path, path);
    int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (fd < 0)
        return -1;
    uint64_t hello[2] = {kind, token};
    if (connect(fd, (struct sockaddr *)&address, sizeof address) < 0 ||
        wire_write(fd, hello, sizeof hello) < 0) {
        close(fd);
        return -1;
    }
    return fd;
}

int wire_open(struct context *context)
{
    static uint32_t contexts;
    const char *path = getenv("KINECT_EMULATOR");
    uint64_t token = (uint64_t)getpid() << 32 | __sync_add_and_fetch(&contexts, 1);
    pthread_mutex_init(&context->calling, NULL);
    pthread_mutex_init(&context->handling, NULL);
    context->calls = path ? connect_one(path, KIND_CALLS, token) : -1;
    context->events = path ? connect_one(path, KIND_EVENTS, token) : -1;
    context->wake[0] = context->wake[1] = -1;
    if (context->calls >= 0 && context->events >= 0 && pipe(context->wake) == 0)
        return OK;
    wire_close(context);
    return ERROR_OTHER;
}

static void close_one(int fd)
{
    if (fd >= 0)
        close(fd);
}

void wire_close(struct context *context)
{
    close_one(context->calls);
    close_one(context->events);
    close_one(context->wake[0]);
    close_one(context->wake[1]);
    pthread_mutex_destroy(&context->calling);
    pthread_mutex_destroy(&context->handling);
}

/* The bytes behind a response; what there is no room for is read and dropped. */
static int read_answer(int socket, uint32_t size, void *answer, uint32_t *room)
{
    uint32_t kept = room && *room < size ? *room : room ? size : 0;
    char rest[256];
    if (kept && wire_read(socket, answer, kept) < 0)
        return -1;
    if (room)
        *room = kept;
    for (uint32_t left = size - kept; left > 0;) {
        uint32_t part = left < sizeof rest ? left : sizeof rest;
        if (wire_read(socket, rest, part) < 0)
            return -1;
        left -= part;
    }
    return 0;
}

int wire_call(struct context *context, struct request request, const void *data,
              void *answer, uint32_t *room)
{
    struct response response = {ERROR_NO_DEVICE, 0};
    int fd = context->calls;
    pthread_mutex_lock(&context->calling);
    int failed = wire_write(fd, &request, sizeof request) < 0 ||
                 (request.size && wire_write(fd, data, request.size) < 0) ||
                 wire_read(fd, &response, sizeof response) < 0 ||
                 read_answer(fd, response.size, answer, room) < 0;
    pthread_mutex_unlock(&context->calling);
    return failed ? ERROR_NO_DEVICE : response.result;
}
