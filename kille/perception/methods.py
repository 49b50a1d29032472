"""The learners by name, for comparisons: the paper's, ours, and baselines.

Each name gives a learner that has learned nothing. `kille` is the paper's own way in
both lists, `default` is what the robot uses, and `embedding` the same with a pretrained
network as one cue more. `votes` has features alone, as the paper's, but pooled: what
the literature mostly compares with. `angle` is a rule that measures one number.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from kille.perception.cues import with_embedding
from kille.perception.evidence import weighing
from kille.perception.learners import Learner
from kille.perception.objects import ObjectMemory
from kille.perception.paper_objects import PaperObjects
from kille.perception.pooled_votes import PooledVotes
from kille.perception.relations import AngleRule, PaperRelations, RelationMemory
from kille.scene import Configuration, Percept

__all__ = ["OBJECTS", "RELATIONS"]


def _with_embedding() -> Learner[Percept]:
    """Make the learner with embeddings; MissingExtraError without
    `kille[embedding]`."""
    return ObjectMemory(weighed=weighing("embedding"), cues=with_embedding())


OBJECTS: Mapping[str, Callable[[], Learner[Percept]]] = {
    "default": ObjectMemory,
    "kille": PaperObjects,
    "votes": PooledVotes,
    "embedding": _with_embedding,
}
"""The learners of words for things, by name.

>>> from kille.perception.methods import OBJECTS
>>> sorted(OBJECTS)
['default', 'embedding', 'kille', 'votes']
"""

RELATIONS: Mapping[str, Callable[[], Learner[Configuration]]] = {
    "default": RelationMemory,
    "kille": PaperRelations,
    "angle": AngleRule,
}
"""The learners of spatial words, by name.

>>> from kille.perception.methods import RELATIONS
>>> sorted(RELATIONS)
['angle', 'default', 'kille']
"""
