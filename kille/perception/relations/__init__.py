"""Spatial words: how a target stands to a landmark, and the words learned for it."""

from kille.perception.relations.angle import AngleRule
from kille.perception.relations.configurations import configuration
from kille.perception.relations.memory import RelationMemory
from kille.perception.relations.paper_relations import PaperRelations

__all__ = ["AngleRule", "PaperRelations", "RelationMemory", "configuration"]
