"""Spatial words: how a target is related to a landmark, and words learned for that."""

from kille.perception.relations.configurations import configuration
from kille.perception.relations.memory import RelationMemory
from kille.perception.relations.one_number_rule import AngleRule
from kille.perception.relations.paper_relations import PaperRelations

__all__ = ["AngleRule", "PaperRelations", "RelationMemory", "configuration"]
