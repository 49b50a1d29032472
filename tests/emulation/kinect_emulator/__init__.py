"""A Kinect v1 made of software, down to the packets on its USB cable.

It answers the same control transfers and sends the same isochronous packets as the real
thing. It takes nothing from the product but frames to show, and has encoders of its
own, so that driver and emulator check each other. `host.Host` is the bus with what is
plugged in; a client reaches it in process (`inside`) or through a `libusb-1.0.so.0`
that talks to `server.Server`.
"""
