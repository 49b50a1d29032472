"""Where the robot looks: its sensor, what the tutor points at, and numbered things."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np

from kille.perception.look import SCANS, Sighting, look
from kille.perception.pointing import region_at
from kille.perception.segment import nearness, overlap, region_of
from kille.perception.shown_looks import view_shown
from kille.scene import Box, Frame, Look, Mask, Percept, Region
from kille.sensors.sensor import Sensor, SensorError
from kille.sensors.sources import open_sensor
from kille.sensors.stage_commands import perform
from ttr.showing import NotebookValue, Part

THAT = "that"
"""Before a target: it is a second thing, beside the one that was pointed at."""

_NUMBER = re.compile(r"[0-9]{1,6}")
_SAME = 0.5  # overlap of a thing with itself in another look
_LEAST = 64  # pixels of a box: less is a click by a hand that shakes


@dataclass(frozen=True, eq=False)
class NumberedLook(NotebookValue):
    """A look whose things are numbered from 1, and the one in focus.

    At first the nearest has the lowest number. A thing keeps its number from look to
    look while it is in view; a new thing gets the number of one that is gone, or the
    next. Later ones move up only when more things go than come. `focus` is the number
    of what the tutor points at, or else of the nearest thing. It stays while the same
    things are in view, even if noise makes another one nearer now and then; it is None
    when nothing is in view. `kept` are the numbers of the things that had them before,
    and `pointed` says whether the tutor has pointed at the focus since the last look;
    `second` is then what they have pointed at after it, as "that".
    """

    look: Look
    focus: int | None
    kept: tuple[int, ...] = ()
    pointed: bool = False
    second: int | None = None

    @property
    def roles(self) -> dict[int, str]:
        """What the words "this" and "that" are about, by their numbers."""
        both = ((self.focus, "this"), (self.second, THAT))
        return {number: word for number, word in both if number is not None}

    def _shown_as_(self) -> Part:
        return view_shown(self.look, roles=self.roles)


@dataclass(frozen=True, eq=False)
class Attention:
    """What the tutor points at, if at anything, and the latest view of the scene.

    `anew` says whether they have pointed since that view. `second` is what they have
    pointed at as "that", beside the first; it holds for what they say next.
    """

    pointed: Sighting | None = None
    view: NumberedLook | None = None
    anew: bool = False
    second: Sighting | None = None


@runtime_checkable
class LookingSensor(Protocol):
    """A sensor that takes looks itself, such as one on another machine."""

    def look(self, scans: int, pointed: Sighting | None) -> Look:
        """A look as `kille.perception.look.look` takes it."""
        ...


class AttentiveSensor:
    """A sensor, and what is attended to in its looks.

    Pointing holds until the tutor points elsewhere or the scene changes. `attention`
    may be put back to an earlier value.
    """

    def __init__(self, sensor: str | Sensor, scans: int = SCANS) -> None:
        self.sensor = open_sensor(sensor) if isinstance(sensor, str) else sensor
        self.attention = Attention()
        self._scans = scans

    def look(self) -> NumberedLook:
        """Look at the scene as it is now. SensorError as the sensor raises it."""
        pointed, before = self.attention.pointed, self.attention.view
        seen = _look(self.sensor, self._scans, pointed)
        order = _in_order(seen.percepts, before)
        focus = _focus(order, before) if pointed is None else _first(order, seen)
        second = _number_of(self.attention.second, order)
        second = None if second == focus else second
        view = NumberedLook(
            replace(seen, percepts=tuple(order)),
            focus,
            _kept_numbers(order, before),
            self.attention.anew and focus is not None,
            second,
        )
        both = None if second is None else self.attention.second
        self.attention = Attention(pointed, view, both is not None, both)
        return view

    def glimpse(self) -> None:
        """Look, and leave what the tutor has pointed at as new as it is."""
        before = self.attention
        self.look()
        now = self.attention
        self.attention = replace(now, anew=before.anew, second=before.second)

    def point(self, target: str) -> None:
        """Point at a thing by its number, a pixel, a box or its outline's name.

        Pixels are `320 240`, boxes `90 60 210 200`: left, top, right and bottom.
        Numbers are those of the latest view. After `that` it is a second thing, beside
        the one that was pointed at before: `that 2`. SensorError if there is nothing
        like it.
        """
        word, _, rest = target.strip().partition(" ")
        if word != THAT or not rest or self.attention.pointed is None:
            pointed = self._target(rest if word == THAT and rest else target)
            self.attention = Attention(pointed, self.attention.view, anew=True)
            return
        things = (self.attention.view or self.look()).look.percepts
        second, first = self._target(rest), self.attention.pointed
        number = _number_of(second, things)
        if number is None:
            raise SensorError(
                f"`point {target[:40]}`: a second thing is one of those in view: point "
                "at it by its number"
            )
        if number == _number_of(first, things):
            raise SensorError(
                f"#{number} is pointed at as “this” already: point at another thing"
            )
        self.attention = replace(self.attention, anew=True, second=second)

    def settle(self) -> None:
        """What was said has been taken in: a second thing is pointed at no more."""
        at = self.attention
        if at.view is not None and at.view.second is not None:
            self.attention = Attention(at.pointed, at.view)

    def _target(self, target: str) -> Sighting:
        """What is pointed at, in the frame in which it is."""
        words = target.replace("#", " ").replace(",", " ").split()
        numbers = [int(word) for word in words if _NUMBER.fullmatch(word)]
        if len(numbers) == len(words) == 1:
            return self._thing_with_number(numbers[0])
        frame = self.sensor.frame()
        if len(numbers) == len(words) == 2:
            return frame, _thing_at_pixel(frame, (numbers[0], numbers[1]))
        if len(numbers) == len(words) == 4:
            return frame, region_of(frame, _pixels_of(frame, Box(*numbers)))
        return frame, region_of(frame, _outline(frame, target))

    def _thing_with_number(self, number: int) -> Sighting:
        """The thing that has this number in the latest view."""
        view = self.attention.view or self.look()
        things = view.look.percepts
        if not 1 <= number <= len(things):
            raise SensorError(
                f"there is no thing #{number} to point at: "
                + (f"there are {len(things)}" if things else "nothing is in view")
            )
        return view.look.frame, things[number - 1].region

    def change(self, command: str) -> None:
        """Change the scene, as `kille.sensors.stage_commands.perform` does."""
        perform(self.sensor, command)
        self.attention = Attention()

    def switch_sensor(self, name: str) -> None:
        """Look through another sensor from now on; the old one stays if it fails."""
        sensor = open_sensor(name)
        self.sensor.close()
        self.sensor, self.attention = sensor, Attention()

    def close(self) -> None:
        """Let go of the sensor."""
        self.sensor.close()


def _look(sensor: Sensor, scans: int, pointed: Sighting | None) -> Look:
    if isinstance(sensor, LookingSensor):
        return sensor.look(scans, pointed)
    return look(sensor, scans, pointed)


def _in_order(
    percepts: Sequence[Percept], before: NumberedLook | None
) -> list[Percept]:
    """The things in their earlier order; new ones where others are gone."""
    places = _match_earlier(percepts, before)
    known = {id(percept) for percept in places}
    new = iter(sorted((it for it in percepts if id(it) not in known), key=_nearness))
    kept = (next(new, None) if percept is None else percept for percept in places)
    return [percept for percept in kept if percept is not None] + list(new)


def _match_earlier(
    percepts: Sequence[Percept], before: NumberedLook | None
) -> list[Percept | None]:
    """For each thing of the earlier view the same thing now, or None."""
    left = list(percepts)
    found = []
    for then in () if before is None else before.look.percepts:
        again = next((now for now in left if is_same_thing(now, then)), None)
        left = [percept for percept in left if percept is not again]
        found.append(again)
    return found


def _kept_numbers(
    order: Sequence[Percept], before: NumberedLook | None
) -> tuple[int, ...]:
    """The numbers of the things that had them before."""
    found = zip(order, _match_earlier(order, before), strict=False)
    return tuple(n for n, (it, again) in enumerate(found, start=1) if it is again)


def _focus(order: Sequence[Percept], before: NumberedLook | None) -> int | None:
    """The number of the nearest thing; unchanged while the things are the same."""
    found = _match_earlier(order, before)
    if before is not None and len(found) == len(order) and None not in found:
        return before.focus
    nearest = min(order, key=_nearness, default=None)
    return None if nearest is None else order.index(nearest) + 1


def _first(order: Sequence[Percept], seen: Look) -> int | None:
    """The number of what is pointed at, which a look puts first."""
    return order.index(seen.percepts[0]) + 1 if order else None


def _number_of(sighting: Sighting | None, things: Sequence[Percept]) -> int | None:
    """The number of the thing that was sighted, if it is still there."""
    if sighting is None:
        return None
    found = (
        number
        for number, it in enumerate(things, start=1)
        if overlap(it.region, sighting[1]) >= _SAME
    )
    return next(found, None)


def is_same_thing(one: Percept, other: Percept) -> bool:
    """Whether things of two looks stand at one place."""
    return overlap(one.region, other.region) >= _SAME


def _nearness(percept: Percept) -> float:
    return nearness(percept.region)


def _thing_at_pixel(frame: Frame, pixel: tuple[int, int]) -> Region:
    """The thing at a pixel (u, v)."""
    region = region_at(frame, pixel)
    if region is None:
        height, width = frame.colour.shape[:2]
        raise SensorError(
            f"there is nothing at {pixel[0]} {pixel[1]} to point at: give a pixel of a "
            f"thing, right and down from the upper left corner of {width}x{height}"
        )
    return region


def _pixels_of(frame: Frame, box: Box) -> Mask:
    """The pixels in a box that a tutor has drawn."""
    height, width = frame.colour.shape[:2]
    mask = np.zeros((height, width), bool)
    mask[box.top : box.bottom, box.left : box.right] = True
    if np.count_nonzero(mask) < _LEAST:
        raise SensorError(
            f"the box from {box.left} {box.top} to {box.right} {box.bottom} is too "
            "small to point at: give left, top, right and bottom in pixels of the "
            f"picture of {width}x{height}"
        )
    return mask


def _outline(frame: Frame, name: str) -> Mask:
    """The outline that a labelled recording or a simulation has under this name."""
    wanted = _normalise_name(name)
    for known, mask in frame.outlines.items():
        if _normalise_name(known) == wanted:
            return mask
    names = ", ".join(sorted(frame.outlines)) or "no named outlines"
    raise SensorError(
        f"`point {name[:40]}`: point by number, by pixel (`point 320 240`) or by the "
        f"name of an outline; here there are {names}"
    )


def _normalise_name(name: str) -> str:
    return re.sub(r"[\W_]+", " ", name.lower()).strip()
