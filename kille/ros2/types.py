"""The types of ROS 2's messages as DDS knows them, with bytes for values.

What is sent under a topic of ROS 2 is in CDR, a standard form of bytes; `rosbags`
writes and reads it with NumPy. To DDS a type is told so that readers elsewhere know it;
its own way from values to bytes, element by element, is not taken.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Any

from kille.bus import BusError

REMEDY = "pip install 'kille[ros2]'"

_PLAIN: Mapping[str, Any] = {"string": str, "bool": bool}


def module(name: str) -> ModuleType:
    """A module of the extra `ros2`; BusError where it is not installed."""
    try:
        return import_module(name)
    except ImportError as error:
        raise BusError(f"ROS 2 needs {name.partition('.')[0]}: {REMEDY}") from error


@cache
def store() -> Any:
    """The standard messages of ROS 2, as `rosbags` has them."""
    typesys = module("rosbags.typesys")
    return typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)


def to_bytes(message: Any) -> bytes:
    """A message of `rosbags` in CDR."""
    return bytes(store().serialize_cdr(message, message.__msgtype__))


def of_bytes(data: bytes, name: str) -> Any:
    """The message in these bytes; BusError if they are none of this type."""
    try:
        return store().deserialize_cdr(data, name)
    except Exception as error:
        raise BusError(f"what came is no {name} ({error})") from error


@cache
def sample_type(name: str) -> Any:
    """The class of samples of a type, `std_msgs/msg/String`; `cdr` is the bytes."""
    declared: Any = _declare_type(name)

    class Sample(declared):  # type: ignore[misc]
        """A message in its bytes."""

        def __init__(self, cdr: bytes) -> None:
            self.cdr = cdr

        def serialize(self, *args: Any, **how: Any) -> bytes:
            """The bytes as they are."""
            return self.cdr

        @classmethod
        def deserialize(cls, data: bytes, *args: Any, **how: Any) -> Any:
            """A sample of these bytes."""
            return cls(data)

    Sample.__idl__ = declared.__idl__
    return Sample


@cache
def _declare_type(name: str) -> Any:
    """The type as it is told to DDS: its name and fields."""
    package, _, short = name.partition("/msg/")
    _, fields = store().fielddefs[name]
    return module("cyclonedds.idl").make_idl_struct(
        f"{short}_",
        f"{package}.msg.dds_.{short}_",
        {label: _field(*kind) for label, kind in fields},
    )


def _field(kind: Any, of: Any) -> Any:
    """The type of a field, from how `rosbags` describes it."""
    types = module("cyclonedds.idl.types")
    forms: Mapping[str, Callable[[], Any]] = {
        "BASE": lambda: _base(types, of[0]),
        "NAME": lambda: _declare_type(of),
        "ARRAY": lambda: types.array[_field(*of[0]), of[1]],
        "SEQUENCE": lambda: types.sequence[_field(*of[0])],
    }
    return forms[kind.name]()


def _base(types: ModuleType, name: str) -> Any:
    return _PLAIN.get(name) or getattr(types, name)
