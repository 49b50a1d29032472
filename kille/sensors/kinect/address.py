"""Names of Kinects: `kinect`, `kinect:SERIAL`, `kinect?tilt=-10&light=green`."""

from __future__ import annotations

from dataclasses import dataclass

from kille.sensors.kinect.motor import Light, tilt_value
from kille.sensors.sensor import SensorError

PICTURES = ("colour", "infrared")

_LIGHTS = {
    "off": Light.OFF,
    "green": Light.GREEN,
    "red": Light.RED,
    "yellow": Light.YELLOW,
    "blinking": Light.BLINKING_GREEN,
}
_OPTIONS = ("tilt", "light", "picture")


@dataclass(frozen=True)
class KinectAddress:
    """Which Kinect, and how it is to be set; None leaves a thing as it is."""

    serial: str | None = None
    tilt: float | None = None
    light: Light | None = None
    picture: str = "colour"


def parse_address(name: str) -> KinectAddress:
    """The address that a name gives; SensorError for what is not known.

    >>> parse_address("kinect:A0033?tilt=-10").tilt
    -10.0
    """
    source, _, query = name.strip().partition("?")
    _, _, serial = source.partition(":")
    given = [_option(text) for text in query.split("&") if text]
    options = dict(given)
    for option in options:
        if [name for name, _ in given].count(option) > 1:
            raise SensorError(f"option '{option}' is given twice: give it once")
    tilt, light = options.get("tilt"), options.get("light")
    return KinectAddress(
        serial or None,
        None if tilt is None else _degrees(tilt),
        None
        if light is None
        else _LIGHTS[_check_known("light", light, tuple(_LIGHTS))],
        _check_known("picture", options.get("picture", PICTURES[0]), PICTURES),
    )


def _option(text: str) -> tuple[str, str]:
    option, equals, value = text.partition("=")
    _check_known("option", option, _OPTIONS)
    if not equals or not value:
        raise SensorError(f"option '{option}' has no value: write {option}=...")
    return option, value


def _check_known(what: str, word: str, known: tuple[str, ...]) -> str:
    if word not in known:
        raise SensorError(
            f"a Kinect has no {what} '{word}'; there are {', '.join(known)}"
        )
    return word


def _degrees(text: str) -> float:
    try:
        degrees = float(text)
        tilt_value(degrees)
    except (ValueError, SensorError):
        raise SensorError(
            f"tilt={text}: a tilt is degrees from -31 (down) to 31, such as tilt=-10"
        ) from None
    return degrees
