"""A fragment of English: sentences, their contents, and what follows from what.

An example of what the theory is for, and no product. The grammar and the lexicon are
data, `grammars/fragment.en.lark` and `grammars/fragment.en.ttr`; `understand` gives the
content of a sentence as a type, which a model judges, and `follows` says whether one
sentence follows from others.
"""

from ttr.semantics.fragment.inference import Inference, follows
from ttr.semantics.fragment.lexicon import Lexicon, english, lexicon
from ttr.semantics.fragment.sentence_parsing import OutsideFragment
from ttr.semantics.fragment.sentences import Sentence, picked_up, understand

__all__ = [
    "Inference",
    "Lexicon",
    "OutsideFragment",
    "Sentence",
    "english",
    "follows",
    "lexicon",
    "picked_up",
    "understand",
]
