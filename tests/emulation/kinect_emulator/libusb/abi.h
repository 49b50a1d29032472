/* What a client of libusb 1.0 and the library agree on: layouts and numbers.
 *
 * Only what a client of the emulated Kinect needs is here.
 */
#ifndef ABI_H
#define ABI_H

#include <stdint.h>
#include <sys/time.h>
#include <sys/types.h>

enum {
    OK = 0,
    ERROR_IO = -1,
    ERROR_INVALID = -2,
    ERROR_ACCESS = -3,
    ERROR_NO_DEVICE = -4,
    ERROR_NOT_FOUND = -5,
    ERROR_BUSY = -6,
    ERROR_TIMEOUT = -7,
    ERROR_OVERFLOW = -8,
    ERROR_PIPE = -9,
    ERROR_INTERRUPTED = -10,
    ERROR_NO_MEM = -11,
    ERROR_NOT_SUPPORTED = -12,
    ERROR_OTHER = -99
};

enum { DESCRIPTOR_CONFIG = 2, DESCRIPTOR_STRING = 3 };
enum { DESCRIPTOR_INTERFACE = 4, DESCRIPTOR_ENDPOINT = 5 };
enum { TRANSFER_ISOCHRONOUS = 1 };
enum { SPEED_HIGH = 3 };

struct device_descriptor {
    uint8_t bLength, bDescriptorType;
    uint16_t bcdUSB;
    uint8_t bDeviceClass, bDeviceSubClass, bDeviceProtocol, bMaxPacketSize0;
    uint16_t idVendor, idProduct, bcdDevice;
    uint8_t iManufacturer, iProduct, iSerialNumber, bNumConfigurations;
};

struct endpoint_descriptor {
    uint8_t bLength, bDescriptorType, bEndpointAddress, bmAttributes;
    uint16_t wMaxPacketSize;
    uint8_t bInterval, bRefresh, bSynchAddress;
    const unsigned char *extra;
    int extra_length;
};

struct interface_descriptor {
    uint8_t bLength, bDescriptorType, bInterfaceNumber, bAlternateSetting;
    uint8_t bNumEndpoints, bInterfaceClass, bInterfaceSubClass, bInterfaceProtocol;
    uint8_t iInterface;
    struct endpoint_descriptor *endpoint;
    const unsigned char *extra;
    int extra_length;
};

struct interface {
    struct interface_descriptor *altsetting;
    int num_altsetting;
};

struct config_descriptor {
    uint8_t bLength, bDescriptorType;
    uint16_t wTotalLength;
    uint8_t bNumInterfaces, bConfigurationValue, iConfiguration, bmAttributes;
    uint8_t MaxPower;
    struct interface *interface;
    const unsigned char *extra;
    int extra_length;
};

struct iso_packet {
    unsigned int length, actual_length;
    int status;
};

struct handle;
struct transfer;
typedef void (*transfer_callback)(struct transfer *);

struct transfer {
    struct handle *dev_handle;
    uint8_t flags;
    unsigned char endpoint, type;
    unsigned int timeout;
    int status, length, actual_length;
    transfer_callback callback;
    void *user_data;
    unsigned char *buffer;
    int num_iso_packets;
    struct iso_packet iso_packet_desc[];
};

struct version {
    const uint16_t major, minor, micro, nano;
    const char *rc, *describe;
};

#endif
