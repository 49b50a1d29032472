"""The bus: messages as values, topics, and what carries them between parts."""

from kille.bus.interface import Bus, Publisher, Subscription
from kille.bus.local import LocalBus
from kille.bus.messages import (
    Bundle,
    BusError,
    Camera,
    Facts,
    Image,
    Message,
    Text,
    Topic,
)
from kille.bus.services import Asking, Service, serve

__all__ = [
    "Asking",
    "Bundle",
    "Bus",
    "BusError",
    "Camera",
    "Facts",
    "Image",
    "LocalBus",
    "Message",
    "Publisher",
    "Service",
    "Subscription",
    "Text",
    "Topic",
    "serve",
]
