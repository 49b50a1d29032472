"""Attributes: words of the tutor's own for how things are, such as "big" or "striped".

What a word describes is inferred from its lessons; its name is never looked at.
"""

from kille.perception.attributes.aspects import ASPECTS, Aspect
from kille.perception.attributes.memory import AttributeMemory

__all__ = ["ASPECTS", "Aspect", "AttributeMemory"]
