"""The simulated Kinect: a sensor, and a stage on which things can be put."""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np

from kille.scene import Frame, Point
from kille.sensors.sensor import At, Beside, Placed, SensorError, TablePlan
from kille.sensors.stage_commands import RELATIONS
from kille.sensors.synthetic import catalogue, obj_files, room
from kille.sensors.synthetic.address import SceneAddress, parse_address
from kille.sensors.synthetic.faults import FaultyView
from kille.sensors.synthetic.layout import SCENES, jitter_pose, objection, poses_beside
from kille.sensors.synthetic.name_recognition import recognise_name
from kille.sensors.synthetic.posed_camera import SimulatedCamera
from kille.sensors.synthetic.render import Pose, PosedToy, RenderedScene, render_scene
from kille.sensors.synthetic.specimens import specimen
from kille.sensors.synthetic.toy_model import ToyModel

FRAMES_PER_SECOND = 30.0
_POSES, _FAULTS = 0, 1


def open_synthetic(name: str) -> Synthetic:
    """The simulated Kinect that a name such as `synthetic:desk?seed=7` asks for.

    Raises SensorError for a name that is not understood.

    >>> desk = open_synthetic("synthetic:desk?seed=7")
    >>> desk.name, len(desk.things())
    ('synthetic:desk?seed=7', 10)
    """
    return Synthetic(parse_address(name), name)


class Synthetic:
    """A Kinect before a table, both simulated.

    All chance comes from the address's seed: the n-th frame of a seed and a sequence of
    changes is always the same. The frames of an unchanged scene differ by noise alone.

    >>> desk = open_synthetic("synthetic:desk?seed=7")
    >>> desk.frame().colour.shape
    (480, 640, 3)
    """

    def __init__(self, address: SceneAddress, name: str = "synthetic") -> None:
        self._name = name
        self._address = address
        self._meshes = obj_files.find_meshes(address.meshes) if address.meshes else {}
        self._camera = SimulatedCamera()
        self._frames = 0
        self._changes = 0
        self._closed = False
        self._drawn: tuple[RenderedScene, FaultyView] | None = None
        rng = np.random.default_rng([address.seed, _POSES])
        self._bodies = {
            thing: PosedToy(self._model(thing), jitter_pose(pose, rng, 0.012, 6))
            for thing, pose in SCENES[address.scene].items()
        }

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._name

    @property
    def camera(self) -> SimulatedCamera:
        """The true pose of the camera over the table."""
        return self._camera

    @property
    def bodies(self) -> Mapping[str, PosedToy]:
        """What stands on the table now, in the true poses."""
        return MappingProxyType(self._bodies)

    def frame(self) -> Frame:
        """The next frame, a thirtieth of a second after the one before.

        Its arrays may be shared with other frames and cannot be written.
        Raises SensorError after `close`.
        """
        if self._closed:
            raise SensorError(f"{self._name} is closed: open it again")
        image, view = self._look()
        seed = (self._address.seed, _FAULTS, self._frames)
        frame = Frame(
            colour=view.colour(seed),
            depth=view.depth(seed),
            intrinsics=self._camera.intrinsics,
            time=self._frames / FRAMES_PER_SECOND,
            outlines=image.outlines,
        )
        self._frames += 1
        return frame

    def _look(self) -> tuple[RenderedScene, FaultyView]:
        """The scene as it is now, drawn once for all frames until it is changed."""
        if self._drawn is None:
            image = render_scene(self._camera, self._bodies)
            focal, faults = self._camera.intrinsics.fx, self._address.faults
            self._drawn = image, FaultyView(image.colour, image.depth, focal, faults)
        return self._drawn

    def close(self) -> None:
        """Let go of the source; a second call does nothing."""
        self._closed = True

    def things(self) -> tuple[str, ...]:
        """The names of all that can be shown: the ten objects, and the meshes found.

        A mesh that has the name of one of the ten is shown in its stead.
        """
        return tuple(dict.fromkeys([*catalogue.TOY_NAMES, *self._meshes]))

    def show(self, name: str) -> None:
        """Show only this object, near the table's middle, in a new pose each time.

        The pose is up to 5 cm off the middle each way, and turned by at most 25 degrees
        from the object's front. Raises SensorError for a name not known.
        """
        thing = self._recognise(name)
        model = self._model(thing)
        pose = jitter_pose(Pose(0, 0), self._chance(thing), 0.05, 25)
        self._change({thing: PosedToy(model, pose)})

    def place(self, name: str, spot: At | Beside) -> None:
        """Put the object there and leave the others where they are.

        A name may be the path of a mesh. Raises SensorError, the scene being as it was,
        for a name or relation not known, a landmark not on the table, and a spot where
        the object would be off the table, out of view, hidden, or in another.
        """
        thing = self._recognise(name)
        match spot:
            case At():
                pose = Pose(spot.right, spot.away, spot.turn)
                self._place_at(thing, pose)
            case Beside():
                self._place_beside(thing, spot)

    def remove(self, name: str) -> None:
        """Take the object away. Raises SensorError when it is not on the table."""
        thing = self._find_on_table(name)
        self._change(
            {other: body for other, body in self._bodies.items() if other != thing}
        )

    def plan(self) -> TablePlan:
        """The table from above, in the true poses."""
        placed = (
            Placed(
                name,
                At(body.pose.right, body.pose.away, body.pose.turn),
                tuple((float(x), float(y)) for x, y in body.model.footprint),
            )
            for name, body in self._bodies.items()
        )
        edges = (room.TABLE_LEFT, room.TABLE_NEAR, room.TABLE_RIGHT, room.TABLE_END)
        return TablePlan(edges, tuple(placed))

    def true_place(self, name: str) -> Point:
        """The middle of the box around an object on the table, in camera axes."""
        body = self._bodies[self._find_on_table(name)]
        pose, height = body.pose, float(body.model.size[2])
        return self._camera.point(np.array([pose.right, pose.away, height / 2]))

    def _place_at(self, thing: str, pose: Pose) -> None:
        after = self._bodies_with(thing, PosedToy(self._model(thing), pose))
        if reason := objection(self._camera, thing, after):
            raise SensorError(
                f"cannot place the {thing} at {pose.right:.2f} {pose.away:.2f}: "
                f"{reason}; "
                "choose another spot (metres right and away of the table's middle)"
            )
        self._change(after)

    def _place_beside(self, thing: str, spot: Beside) -> None:
        phrase = recognise_name("relation", spot.relation, RELATIONS)
        landmark = self._find_on_table(spot.landmark)
        if landmark == thing:
            raise SensorError(f"cannot place the {thing} {phrase} itself")
        model, rng = self._model(thing), self._chance(thing)
        reason = None
        around = poses_beside(model, RELATIONS[phrase], self._bodies[landmark], rng)
        for pose in around:
            after = self._bodies_with(thing, PosedToy(model, pose))
            reason = objection(self._camera, thing, after)
            if reason is None:
                self._change(after)
                return
        raise SensorError(
            f"no room for the {thing} {phrase} the {landmark}: {reason}; "
            f"move the {landmark} or take something away"
        )

    def _bodies_with(self, thing: str, body: PosedToy) -> dict[str, PosedToy]:
        others = {name: each for name, each in self._bodies.items() if name != thing}
        return {**others, thing: body}

    def _change(self, bodies: dict[str, PosedToy]) -> None:
        self._bodies = bodies
        self._drawn = None
        self._changes += 1

    def _chance(self, thing: str) -> np.random.Generator:
        """The chance in the next change, which depends on the thing and on how many
        changes there were."""
        label = zlib.crc32(thing.encode())
        return np.random.default_rng([self._address.seed, _POSES, label, self._changes])

    def _model(self, thing: str) -> ToyModel:
        mesh = self._meshes.get(thing)
        if mesh is not None:
            return obj_files.load_scan(mesh)
        return specimen(thing, self._address.specimen)

    def _recognise(self, name: str) -> str:
        """The object that is meant; a path of a mesh makes it known by its name."""
        path = Path(name).expanduser()
        if "/" in name or path.suffix.lower() == ".obj":
            found = obj_files.find_meshes(path)
            if len(found) > 1:
                raise SensorError(f"{name} holds {len(found)} meshes: name one of them")
            self._meshes |= found
            return next(iter(found))
        return recognise_name("object", name, self.things(), catalogue.ALSO_CALLED)

    def _find_on_table(self, name: str) -> str:
        thing = self._recognise(name)
        if thing in self._bodies:
            return thing
        present = ", ".join(self._bodies) or "nothing"
        raise SensorError(f"the {thing} is not on the table: there is {present}")
