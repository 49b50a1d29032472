/* Devices and handles, as a client holds them. */
#ifndef DEVICES_H
#define DEVICES_H

#include "wire.h"

enum { MAX_PORTS = 7, MAX_CONFIGURATION = 256 };

struct device {
    struct context *context;
    struct device *parent, *next;
    int references;
    uint16_t address; /* for ever its own, so more than clients are told */
    uint8_t bus, depth, ports[MAX_PORTS];
    struct device_descriptor descriptor;
    uint16_t configuration_size;
    unsigned char configuration[MAX_CONFIGURATION];
};

struct handle {
    struct device *device;
    int32_t number;
};

/* The default context stands in where a client gives none. */
struct context *context_or_default(struct context *context);

/* A request about an open device: the result of the emulator. */
int handle_call(struct handle *handle, enum operation operation, uint32_t argument);

#endif
