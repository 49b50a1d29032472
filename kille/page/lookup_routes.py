"""What a browser may look at besides the events: GET requests, which change nothing.

| address | has |
| --- | --- |
| `/inside/F/L` | what the exchanges from F to before L did |
| `/beside/F/L` | what the two robots made of them, side by side |
| `/unfired/F/L` | the rules that did not fire in them, and why |
| `/picture/F.jpg` | what was in view in the turn that began with F |
| `/words/N` | the words that were taught, from number N on |
| `/word/KIND/NAME` | what a word was learned from |
| `/hindsight/NAME` | whether it would have been right before each lesson in a noun |
| `/example/KEY` | what was seen in a lesson |
| `/export/F/L/dlg` `log` `tex` | the turn as a file |
| `/export/dlg` `log` `tex` | the dialogue as a file |

All but pictures is worked out in the robot's thread, when nothing is to be answered. If
too much of it waits, the status is 503.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from kille.agent.agent import Agent
from kille.memory.pictures import JPEG
from kille.page.exports import FORMATS, file_name, log_text, state_as_latex, story_text
from kille.page.robot_thread import RobotThread
from kille.page.side_by_side import comparison_report
from kille.page.state_changes import Json, inside_report
from kille.page.unfired_rules import unfired_report
from kille.page.word_shelf import EXAMPLES, example_picture, shelf_page, word_report
from ttr import TTRError

_TOGETHER = 8
"""Exchanges of one turn, at most."""

_LARGEST_KEY = 2**63 - 1

_MISSING = Response(status_code=404)


def lookup_routes(robot: RobotThread) -> list[Route]:
    """The addresses at which a robot is looked into."""
    reads = _Reads(robot)
    return [
        Route("/inside/{first:int}/{last:int}", reads.inside),
        Route("/beside/{first:int}/{last:int}", reads.beside),
        Route("/unfired/{first:int}/{last:int}", reads.unfired),
        Route("/picture/{first:int}.jpg", reads.picture),
        Route("/words/{start:int}", reads.words),
        Route("/word/{kind}/{name:path}", reads.word),
        Route("/hindsight/{name:path}", reads.hindsight),
        Route("/example/{key:int}", reads.example),
        Route("/export/{first:int}/{last:int}/{kind}", reads.export),
        Route("/export/{kind}", reads.export),
    ]


class _Reads:
    """The answers to these requests."""

    def __init__(self, robot: RobotThread) -> None:
        self._robot = robot
        self._working_out = asyncio.Semaphore(1)  # one thread besides the robot's

    async def _read(self, work: Callable[[Agent], Any]) -> Any:
        """What is worked out in the robot's thread."""
        return await asyncio.wrap_future(self._robot.read(work))

    async def inside(self, request: Request) -> Response:
        if (span := _span(request)) is None:
            return _MISSING
        first, last = span

        def look(robot: Agent) -> Json | None:
            turns, earlier = robot.exchanges[first:last], robot.exchanges[:first]
            if not turns:
                return None
            return inside_report(turns, self._robot.insight, earlier)

        try:
            found = await self._read(look)
        except TTRError as error:
            found = {"lines": [["", str(error)]], "steps": [], "state": []}
        return _MISSING if found is None else JSONResponse(found)

    async def beside(self, request: Request) -> Response:
        second, insight = self._robot.second, self._robot.insight
        if second is None or (span := _span(request)) is None:
            return _MISSING

        def compare(robot: Agent) -> Json:
            turns = robot.exchanges[slice(*span)]
            return comparison_report(turns, second.turns(span[0]), insight)

        try:
            return JSONResponse(await self._read(compare))
        except TTRError as error:
            return JSONResponse({"error": str(error)})

    async def unfired(self, request: Request) -> Response:
        if (span := _span(request)) is None:
            return _MISSING
        try:
            found = await self._read(
                lambda it: unfired_report(it.game, it.exchanges[slice(*span)])
            )
        except TTRError as error:
            return JSONResponse({"error": str(error), "events": []})
        return JSONResponse({"error": "", "events": found})

    async def picture(self, request: Request) -> Response:
        jpeg = self._robot.history.picture(request.path_params["first"])
        if jpeg is None:
            return _MISSING
        return Response(jpeg, media_type="image/jpeg")

    async def words(self, request: Request) -> Response:
        start = request.path_params["start"]
        return JSONResponse(await self._read(lambda it: shelf_page(it, start)))

    async def word(self, request: Request) -> Response:
        kind, name = request.path_params["kind"], request.path_params["name"]
        found = await self._read(lambda it: word_report(it, kind, name))
        return _MISSING if found is None else JSONResponse(found)

    async def hindsight(self, request: Request) -> Response:
        """It takes a while, so the robot's thread only says what is known."""
        name = request.path_params["name"]
        lessons = await self._read(lambda it: it.hindsight(name, EXAMPLES))
        async with self._working_out:
            return JSONResponse(await asyncio.to_thread(list, lessons))

    async def example(self, request: Request) -> Response:
        key = request.path_params["key"]
        if key > _LARGEST_KEY:
            return _MISSING
        found = await self._read(lambda it: example_picture(it, key))
        if found is None:
            return _MISSING
        kind = "image/jpeg" if found.startswith(JPEG) else "image/png"
        return Response(found, media_type=kind)

    async def export(self, request: Request) -> Response:
        kind, whole = request.path_params["kind"], "first" not in request.path_params
        span = None if whole else _span(request)
        if kind not in FORMATS or (span is None and not whole):
            return _MISSING
        try:
            name, text = await self._read(lambda it: self._export(it, kind, span))
        except TTRError as error:
            return Response(f"{error}\n", 422, media_type="text/plain")
        headers = {"Content-Disposition": f'attachment; filename="{name}"'}
        return Response(text, headers=headers, media_type="text/plain; charset=utf-8")

    def _export(
        self, robot: Agent, kind: str, span: tuple[int, int] | None
    ) -> tuple[str, str]:
        """The name of a file and its text."""
        insight, history = self._robot.insight, self._robot.history
        first, last = span or (0, len(robot.exchanges) + 1)
        turns = robot.exchanges[first:last]
        name = file_name(robot, kind, None if span is None else first + 1)
        if kind == "dlg":
            events = history.events(first, last)
            return name, story_text(robot, events, self._robot.began)
        if kind == "log":
            return name, log_text(turns, insight)
        steps = [step for turn in turns for step in turn.steps]
        state = steps[-1].after if steps else robot.state
        return name, state_as_latex(state, insight)


def _span(request: Request) -> tuple[int, int] | None:
    """The exchanges that are asked for; None if they are not those of a turn."""
    first, last = request.path_params["first"], request.path_params["last"]
    return (first, last) if 0 <= first < last <= first + _TOGETHER else None
