#include "devices.h"
#include <stdlib.h>
#include <string.h>

static struct context *default_context;

struct context *context_or_default(struct context *context)
{
    return context ? context : default_context;
}

int libusb_init(struct context **context)
{
    if (!context && default_context)
        return OK;
    struct context *made = calloc(1, sizeof *made);
    if (!made)
        return ERROR_NO_MEM;
    int result = wire_open(made);
    if (result < 0) {
        free(made);
        return result;
    }
    if (context)
        *context = made;
    if (!default_context)
        default_context = made;
    return OK;
}

int libusb_init_context(struct context **context, const void *options, int count)
{
    (void)options, (void)count;
    return libusb_init(context);
}

struct device *libusb_ref_device(struct device *device)
{
    __sync_add_and_fetch(&device->references, 1);
    return device;
}

void libusb_unref_device(struct device *device)
{
    if (!device || __sync_sub_and_fetch(&device->references, 1) > 0)
        return;
    libusb_unref_device(device->parent);
    free(device);
}

void libusb_exit(struct context *context)
{
    context = context_or_default(context);
    if (!context)
        return;
    while (context->known) {
        struct device *device = context->known;
        context->known = device->next;
        libusb_unref_device(device);
    }
    if (context == default_context)
        default_context = NULL;
    wire_close(context);
    free(context);
}

static struct device *known(struct context *context, uint16_t address)
{
    struct device *device = context->known;
    while (device && device->address != address)
        device = device->next;
    return device;
}

/* What the emulator tells of each device; its parent comes before it. */
struct told {
    uint16_t address, parent;
    uint8_t depth, ports[MAX_PORTS];
    struct device_descriptor descriptor;
    uint16_t size;
    unsigned char configuration[MAX_CONFIGURATION];
} __attribute__((packed));

static struct device *remember(struct context *context, const struct told *told)
{
    struct device *device = known(context, told->address);
    if (device || !(device = calloc(1, sizeof *device)))
        return device;
    device->context = context;
    device->references = 1;
    device->bus = 1;
    device->address = told->address;
    device->depth = told->depth;
    memcpy(device->ports, told->ports, sizeof device->ports);
    device->descriptor = told->descriptor;
    device->configuration_size = told->size;
    memcpy(device->configuration, told->configuration, told->size);
    struct device *parent = known(context, told->parent);
    device->parent = parent ? libusb_ref_device(parent) : NULL;
    device->next = context->known;
    context->known = device;
    return device;
}

ssize_t libusb_get_device_list(struct context *context, struct device ***list)
{
    static const uint32_t most = 64;
    context = context_or_default(context);
    uint32_t size = most * sizeof(struct told);
    struct told *told = malloc(size);
    struct request request = {OP_LIST, 0, {0}, 0};
    int result = told ? wire_call(context, request, NULL, told, &size) : ERROR_NO_MEM;
    *list = NULL;
    if (result >= 0 && !(*list = calloc(most + 1, sizeof **list)))
        result = ERROR_NO_MEM;
    if (result > (int)(size / sizeof *told))
        result = (int)(size / sizeof *told);
    for (int each = 0; each < result; each++)
        (*list)[each] = libusb_ref_device(remember(context, &told[each]));
    free(told);
    return result;
}

void libusb_free_device_list(struct device **list, int unreference)
{
    for (int each = 0; unreference && list && list[each]; each++)
        libusb_unref_device(list[each]);
    free(list);
}

struct device *libusb_get_parent(struct device *device) { return device->parent; }
uint8_t libusb_get_bus_number(struct device *device) { return device->bus; }

uint8_t libusb_get_device_address(struct device *device)
{
    return (uint8_t)device->address;
}

int libusb_get_device_speed(struct device *device)
{
    (void)device;
    return SPEED_HIGH;
}

uint8_t libusb_get_port_number(struct device *device)
{
    return device->depth ? device->ports[device->depth - 1] : 0;
}

int libusb_get_port_numbers(struct device *device, uint8_t *ports, int room)
{
    if (room < device->depth)
        return ERROR_OVERFLOW;
    memcpy(ports, device->ports, device->depth);
    return device->depth;
}

int libusb_get_device_descriptor(struct device *device, struct device_descriptor *to)
{
    *to = device->descriptor;
    return OK;
}

int handle_call(struct handle *handle, enum operation operation, uint32_t argument)
{
    struct request request = {operation, handle->number, {argument}, 0};
    return wire_call(handle->device->context, request, NULL, NULL, NULL);
}

int libusb_open(struct device *device, struct handle **handle)
{
    struct request request = {OP_OPEN, device->address, {0}, 0};
    int result = wire_call(device->context, request, NULL, NULL, NULL);
    *handle = NULL;
    if (result < 0)
        return result;
    if (!(*handle = calloc(1, sizeof **handle)))
        return ERROR_NO_MEM;
    (*handle)->device = libusb_ref_device(device);
    (*handle)->number = result;
    return OK;
}

struct handle *libusb_open_device_with_vid_pid(struct context *context, uint16_t vendor,
                                               uint16_t product)
{
    struct device **list;
    struct handle *handle = NULL;
    ssize_t count = libusb_get_device_list(context, &list);
    for (ssize_t each = 0; each < count && !handle; each++)
        if (list[each]->descriptor.idVendor == vendor &&
            list[each]->descriptor.idProduct == product)
            libusb_open(list[each], &handle);
    libusb_free_device_list(list, 1);
    return handle;
}

void libusb_close(struct handle *handle)
{
    if (!handle)
        return;
    handle_call(handle, OP_CLOSE, 0);
    libusb_unref_device(handle->device);
    free(handle);
}

struct device *libusb_get_device(struct handle *handle) { return handle->device; }

int libusb_claim_interface(struct handle *handle, int interface)
{
    return interface ? ERROR_NOT_FOUND : handle_call(handle, OP_CLAIM, 0);
}

int libusb_release_interface(struct handle *handle, int interface)
{
    return interface ? ERROR_NOT_FOUND : handle_call(handle, OP_RELEASE, 0);
}

int libusb_set_interface_alt_setting(struct handle *handle, int interface, int setting)
{
    if (interface)
        return ERROR_NOT_FOUND;
    return handle_call(handle, OP_ALTERNATE, (uint32_t)setting);
}

int libusb_kernel_driver_active(struct handle *handle, int interface)
{
    return interface ? ERROR_NOT_FOUND : handle_call(handle, OP_DRIVEN, 0);
}

int libusb_detach_kernel_driver(struct handle *handle, int interface)
{
    return interface ? ERROR_NOT_FOUND : handle_call(handle, OP_DETACH, 0);
}

int libusb_attach_kernel_driver(struct handle *handle, int interface)
{
    return interface ? ERROR_NOT_FOUND : handle_call(handle, OP_ATTACH, 0);
}

int libusb_set_auto_detach_kernel_driver(struct handle *handle, int enable)
{
    (void)handle, (void)enable;
    return ERROR_NOT_SUPPORTED;
}

int libusb_get_configuration(struct handle *handle, int *configuration)
{
    (void)handle;
    *configuration = 1;
    return OK;
}

int libusb_set_configuration(struct handle *handle, int configuration)
{
    (void)handle;
    return configuration == 1 ? OK : ERROR_NOT_FOUND;
}

int libusb_reset_device(struct handle *handle)
{
    (void)handle;
    return OK;
}

int libusb_clear_halt(struct handle *handle, unsigned char endpoint)
{
    (void)handle, (void)endpoint;
    return OK;
}
