/* Control transfers, which wait; isochronous transfers, which are called back. */
#include "devices.h"
#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WAIT_SECONDS = 60 };

int libusb_control_transfer(struct handle *handle, uint8_t kind, uint8_t what,
                            uint16_t value, uint16_t index, unsigned char *data,
                            uint16_t length, unsigned int timeout)
{
    (void)timeout;
    uint32_t setup = (uint32_t)kind | (uint32_t)what << 8;
    uint32_t in = kind & 0x80, room = length;
    struct request request = {OP_CONTROL, handle->number,
                              {setup, value, index, length}, in ? 0 : length};
    return wire_call(handle->device->context, request, data, data, in ? &room : NULL);
}

int libusb_get_string_descriptor_ascii(struct handle *handle, uint8_t index,
                                       unsigned char *text, int room)
{
    unsigned char bytes[255];
    uint16_t value = (uint16_t)(DESCRIPTOR_STRING << 8 | index);
    int size = index ? libusb_control_transfer(handle, 0x80, 6, value, 0x409, bytes,
                                               sizeof bytes, 1000)
                     : ERROR_INVALID;
    if (size < 0)
        return size;
    int written = 0;
    for (int at = 2; at + 1 < size && written + 1 < room; at += 2)
        text[written++] = bytes[at + 1] || bytes[at] > 0x7f ? '?' : bytes[at];
    text[written] = 0;
    return written;
}

int libusb_bulk_transfer(struct handle *handle, unsigned char endpoint,
                         unsigned char *data, int length, int *transferred,
                         unsigned int timeout)
{
    (void)handle, (void)endpoint, (void)data, (void)length, (void)timeout;
    if (transferred)
        *transferred = 0;
    return ERROR_NOT_SUPPORTED;
}

int libusb_interrupt_transfer(struct handle *handle, unsigned char endpoint,
                              unsigned char *data, int length, int *transferred,
                              unsigned int timeout)
{
    return libusb_bulk_transfer(handle, endpoint, data, length, transferred, timeout);
}

struct transfer *libusb_alloc_transfer(int packets)
{
    return calloc(1, sizeof(struct transfer) + (size_t)packets * sizeof(struct iso_packet));
}

void libusb_free_transfer(struct transfer *transfer) { free(transfer); }

/* A request about a transfer; the emulator knows it by its address here. */
static int transfer_call(struct transfer *transfer, struct request request)
{
    uint64_t cookie = (uintptr_t)transfer;
    request.size = sizeof cookie;
    struct context *context = transfer->dev_handle->device->context;
    int result = wire_call(context, request, &cookie, NULL, NULL);
    return result < 0 ? result : OK;
}

int libusb_submit_transfer(struct transfer *transfer)
{
    if (transfer->type != TRANSFER_ISOCHRONOUS)
        return ERROR_NOT_SUPPORTED;
    if (transfer->num_iso_packets <= 0)
        return ERROR_INVALID;
    struct request request = {OP_SUBMIT, transfer->dev_handle->number,
                              {transfer->endpoint, (uint32_t)transfer->num_iso_packets,
                               transfer->iso_packet_desc[0].length, 0}, 0};
    return transfer_call(transfer, request);
}

int libusb_cancel_transfer(struct transfer *transfer)
{
    struct request request = {OP_CANCEL, transfer->dev_handle->number, {0}, 0};
    return transfer_call(transfer, request);
}

/* Put the packets where they belong: each at the start of its own stride. */
static void fill(struct transfer *transfer, const struct event *event,
                 const uint32_t *lengths, const unsigned char *data)
{
    unsigned char *to = transfer->buffer;
    transfer->actual_length = 0;
    for (uint32_t each = 0; each < event->packets; each++) {
        struct iso_packet *packet = &transfer->iso_packet_desc[each];
        uint32_t kept = lengths[each] < packet->length ? lengths[each] : packet->length;
        memcpy(to, data, kept);
        packet->actual_length = kept;
        packet->status = event->packet_status;
        to += packet->length;
        data += lengths[each];
    }
}

/* Take one event and call back; OK, or ERROR_NO_DEVICE if the emulator is gone. */
static int handle_one(struct context *context)
{
    struct event event;
    if (wire_read(context->events, &event, sizeof event) < 0)
        return ERROR_NO_DEVICE;
    uint32_t lengths_size = event.packets * sizeof(uint32_t);
    unsigned char *came = malloc(lengths_size + event.size + 1);
    if (!came || wire_read(context->events, came, lengths_size + event.size) < 0) {
        free(came);
        return ERROR_NO_DEVICE;
    }
    struct transfer *transfer = (struct transfer *)(uintptr_t)event.cookie;
    fill(transfer, &event, (uint32_t *)came, came + lengths_size);
    free(came);
    transfer->status = event.status;
    transfer->callback(transfer);
    return OK;
}

/* Wait for an event or to be woken; whether there is an event, or an error. */
static int wait_for_event(struct context *context, int milliseconds)
{
    struct pollfd ready[2] = {{context->events, POLLIN, 0},
                              {context->wake[0], POLLIN, 0}};
    char woken;
    int count = poll(ready, 2, milliseconds);
    if (count < 0)
        return errno == EINTR ? ERROR_INTERRUPTED : ERROR_IO;
    if (ready[1].revents && read(context->wake[0], &woken, 1) < 0)
        return ERROR_IO;
    return ready[0].revents != 0;
}

static int handle_all(struct context *context, int milliseconds, const int *completed)
{
    int ready = wait_for_event(context, milliseconds);
    while (ready > 0) {
        int result = handle_one(context);
        if (result < 0 || (completed && *completed))
            return result;
        ready = wait_for_event(context, 0);
    }
    return ready;
}

int libusb_handle_events_timeout_completed(struct context *context,
                                           struct timeval *timeout, int *completed)
{
    context = context_or_default(context);
    int milliseconds = (int)(timeout->tv_sec * 1000 + (timeout->tv_usec + 999) / 1000);
    if (completed && *completed)
        return OK;
    pthread_mutex_lock(&context->handling);
    int result = handle_all(context, milliseconds, completed);
    pthread_mutex_unlock(&context->handling);
    return result;
}

int libusb_handle_events_timeout(struct context *context, struct timeval *timeout)
{
    return libusb_handle_events_timeout_completed(context, timeout, NULL);
}

int libusb_handle_events_completed(struct context *context, int *completed)
{
    struct timeval timeout = {WAIT_SECONDS, 0};
    return libusb_handle_events_timeout_completed(context, &timeout, completed);
}

int libusb_handle_events(struct context *context)
{
    return libusb_handle_events_completed(context, NULL);
}

void libusb_interrupt_event_handler(struct context *context)
{
    context = context_or_default(context);
    if (write(context->wake[1], "", 1) < 0)
        return;
}
