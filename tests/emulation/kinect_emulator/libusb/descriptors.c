/* The configuration of a device as the tree of structures that clients read. */
#include "devices.h"
#include <stdlib.h>
#include <string.h>

enum { MAX_INTERFACES = 4, MAX_SETTINGS = 8, MAX_ENDPOINTS = 8 };

/* One block holds it all, so that one free lets go of it. */
struct tree {
    struct config_descriptor configuration;
    struct interface interfaces[MAX_INTERFACES];
    struct interface_descriptor settings[MAX_INTERFACES][MAX_SETTINGS];
    struct endpoint_descriptor endpoints[MAX_INTERFACES][MAX_SETTINGS][MAX_ENDPOINTS];
};

/* One setting more of an interface: where its endpoints go. */
static struct endpoint_descriptor *add_setting(struct tree *tree,
                                               const unsigned char *bytes)
{
    int number = bytes[2] % MAX_INTERFACES;
    struct interface *interface = &tree->interfaces[number];
    int place = interface->num_altsetting++ % MAX_SETTINGS;
    struct interface_descriptor *setting = &tree->settings[number][place];
    memcpy(setting, bytes, 9);
    setting->endpoint = tree->endpoints[number][place];
    interface->altsetting = tree->settings[number];
    return setting->endpoint;
}

static void add_endpoint(struct endpoint_descriptor *endpoint, const unsigned char *bytes)
{
    memcpy(endpoint, bytes, 4);
    endpoint->wMaxPacketSize = (uint16_t)(bytes[4] | bytes[5] << 8);
    endpoint->bInterval = bytes[6];
}

static void read_tree(struct tree *tree, const unsigned char *bytes, int size)
{
    struct endpoint_descriptor *next = NULL;
    for (int at = 0; at < size && bytes[at]; at += bytes[at]) {
        if (bytes[at + 1] == DESCRIPTOR_INTERFACE)
            next = add_setting(tree, bytes + at);
        if (bytes[at + 1] == DESCRIPTOR_ENDPOINT && next)
            add_endpoint(next++, bytes + at);
    }
}

int libusb_get_config_descriptor(struct device *device, uint8_t index,
                                 struct config_descriptor **configuration)
{
    if (index)
        return ERROR_NOT_FOUND;
    struct tree *tree = calloc(1, sizeof *tree);
    if (!tree)
        return ERROR_NO_MEM;
    const unsigned char *bytes = device->configuration;
    struct config_descriptor *head = &tree->configuration;
    memcpy(head, bytes, 2);
    head->wTotalLength = device->configuration_size;
    memcpy(&head->bNumInterfaces, bytes + 4, 5);
    head->interface = tree->interfaces;
    read_tree(tree, bytes, device->configuration_size);
    *configuration = head;
    return OK;
}

int libusb_get_active_config_descriptor(struct device *device,
                                        struct config_descriptor **configuration)
{
    return libusb_get_config_descriptor(device, 0, configuration);
}

int libusb_get_config_descriptor_by_value(struct device *device, uint8_t value,
                                          struct config_descriptor **configuration)
{
    return libusb_get_config_descriptor(device, value - 1, configuration);
}

void libusb_free_config_descriptor(struct config_descriptor *configuration)
{
    free(configuration);
}

/* The size of the endpoint's packets in the first setting that has it, or an error. */
static int endpoint_size(struct device *device, unsigned char address)
{
    for (int at = 0; at < device->configuration_size; at += device->configuration[at]) {
        const unsigned char *bytes = device->configuration + at;
        if (bytes[1] == DESCRIPTOR_ENDPOINT && bytes[2] == address)
            return bytes[4] | bytes[5] << 8;
    }
    return ERROR_NOT_FOUND;
}

int libusb_get_max_packet_size(struct device *device, unsigned char endpoint)
{
    int size = endpoint_size(device, endpoint);
    return size < 0 ? size : size & 0x7ff;
}

int libusb_get_max_iso_packet_size(struct device *device, unsigned char endpoint)
{
    int size = endpoint_size(device, endpoint);
    return size < 0 ? size : (size & 0x7ff) * (1 + (size >> 11 & 3));
}
