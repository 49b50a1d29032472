/* What a client may ask of the library itself. */
#include "abi.h"
#include <stddef.h>

struct context;

static const struct {
    int code;
    const char *name, *text;
} errors[] = {
    {OK, "LIBUSB_SUCCESS", "Success"},
    {ERROR_IO, "LIBUSB_ERROR_IO", "Input/Output Error"},
    {ERROR_INVALID, "LIBUSB_ERROR_INVALID_PARAM", "Invalid parameter"},
    {ERROR_ACCESS, "LIBUSB_ERROR_ACCESS", "Access denied (insufficient permissions)"},
    {ERROR_NO_DEVICE, "LIBUSB_ERROR_NO_DEVICE", "No such device"},
    {ERROR_NOT_FOUND, "LIBUSB_ERROR_NOT_FOUND", "Entity not found"},
    {ERROR_BUSY, "LIBUSB_ERROR_BUSY", "Resource busy"},
    {ERROR_TIMEOUT, "LIBUSB_ERROR_TIMEOUT", "Operation timed out"},
    {ERROR_OVERFLOW, "LIBUSB_ERROR_OVERFLOW", "Overflow"},
    {ERROR_PIPE, "LIBUSB_ERROR_PIPE", "Pipe error"},
    {ERROR_INTERRUPTED, "LIBUSB_ERROR_INTERRUPTED", "System call interrupted"},
    {ERROR_NO_MEM, "LIBUSB_ERROR_NO_MEM", "Insufficient memory"},
    {ERROR_NOT_SUPPORTED, "LIBUSB_ERROR_NOT_SUPPORTED", "Operation not supported"},
    {ERROR_OTHER, "LIBUSB_ERROR_OTHER", "Other error"},
};

static size_t place_of(int code)
{
    size_t last = sizeof errors / sizeof *errors - 1, place = 0;
    while (place < last && errors[place].code != code)
        place++;
    return place;
}

const char *libusb_error_name(int code) { return errors[place_of(code)].name; }
const char *libusb_strerror(int code) { return errors[place_of(code)].text; }

const struct version *libusb_get_version(void)
{
    static const struct version version = {1, 0, 26, 0, "", "emulated Kinect"};
    return &version;
}

/* Hot plugging is not among what this library can tell; clients list again. */
int libusb_has_capability(uint32_t capability) { return capability == 0; }

void libusb_set_debug(struct context *context, int level) { (void)context, (void)level; }

int libusb_set_option(struct context *context, int option, ...)
{
    (void)context, (void)option;
    return OK;
}
