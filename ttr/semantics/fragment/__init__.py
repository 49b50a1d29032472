"""A fragment of English: sentences, their contents, and what follows from what.

An example of what the theory is for, not a product. The grammar and the lexicon are
data: `grammars/fragment.en.lark` and `grammars/fragment.en.ttr`. `understand` gives
the content of a sentence as a type, which a model judges; `follows` answers whether one
sentence follows from others. Contents follow Cooper 2023; inference counts the things
in the regions of a Venn diagram.

Read `sentences` first; then how a sentence gets its content: `lexicon`,
`sentence_parsing`, `composing_contents` (with `content_types`, `determiner_meanings`);
then what follows from it: `inference`, `formulas`, `venn_regions`,
`integer_feasibility`; `fracas` runs a problem set. May import: quantifiers,
parametric_content, theories and all below.
"""

from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.semantics.fragment.inference import follows
from ttr.semantics.fragment.lexicon import Lexicon, english, lexicon
from ttr.semantics.fragment.sentence_parsing import OutsideFragmentError
from ttr.semantics.fragment.sentences import Sentence, pronoun_antecedents, understand

__all__ = [
    "Lexicon",
    "OutsideFragmentError",
    "Sentence",
    "english",
    "follows",
    "lexicon",
    "pronoun_antecedents",
    "understand",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)
