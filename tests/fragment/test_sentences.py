"""Sentences: read, given a content, judged in a model; and what is outside."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ttr import Ind, Model, Theory, TTRError, load
from ttr.semantics.fragment import (
    OutsideFragmentError,
    english,
    follows,
    lexicon,
    pronoun_antecedents,
    understand,
)
from ttr.semantics.quantifiers import UndefinedError, every
from ttr.types.objects import FiniteSet

CONTENTS = {
    "Fido barks.": "bark(fido)",
    "Fido does not bark.": "absent(bark(fido))",
    "Rex is a brown dog.": "[c1 : brown(rex), c2 : dog(rex)]",
    "Kim is a skilful vet.": "[c1 : vet(kim), c2 : skilful(kim, \\x:Ind. vet(x))]",
    "There is a dog.": "exist(\\x:Ind. dog(x), \\x:Ind. dog(x))",
    "Most dogs bark.": "most(\\x:Ind. dog(x), \\x:Ind. bark(x))",
    "More than two dogs bark.": "at_least(3, \\x:Ind. dog(x), \\x:Ind. bark(x))",
    "A dog that Kim likes barks.": (
        "exist(\\x:Ind. [c1 : dog(x), c2 : like(kim, x)], \\x:Ind. bark(x))"
    ),
    "Every dog hugs a boy.": (
        "every(\\x:Ind. dog(x), \\x1:Ind. exist(\\x:Ind. boy(x), \\x:Ind. hug(x1, x)))"
    ),
    "Kim is Sam.": "(Ind@kim)@sam",
}


@pytest.mark.parametrize("text", CONTENTS)
def test_a_sentence_has_a_content(text):
    content = understand(text).content
    assert Theory.of(content).parse(CONTENTS[text]) is content


@pytest.mark.parametrize("text", CONTENTS)
def test_a_content_reads_back_as_the_same_type(text):
    content = understand(text).content
    assert Theory.of(content).parse(str(content)) is content


@pytest.fixture
def M():
    """The dogs fido and rex, the boys kim and sam; who hugs whom; kim smiles."""
    words = english()
    M = Model(words.theory)
    for name in ("fido", "rex", "kim", "sam"):
        M = M.given(name, Ind)
    dog, boy = words.meaning("NOUN", "dog"), words.meaning("NOUN", "boy")
    hug, smile = words.meaning("TV", "hug"), words.meaning("IV", "smile")
    M = M.given("d1", dog("fido")).given("d2", dog("rex"))
    M = M.given("b1", boy("kim")).given("b2", boy("sam"))
    M = M.given("h1", hug("fido", "kim")).given("h2", hug("rex", "sam"))
    return M.given("s1", smile("kim"))


TRUE = """
Every dog hugs a boy.
Both dogs hug a boy.
Kim smiles.
Exactly one boy smiles.
No dog smiles.
Neither dog smiles.
Every animal hugs a boy.
Some boy that a dog hugs smiles.
Not every boy smiles.
A dog hugs Kim.
Fido is not Rex.
Sam does not smile.
There are two boys.
There are no cats.
At most one boy smiles and Sam is a boy.
It is not the case that Sam smiles.
The dogs hug a boy.
Few dogs smile.
"""

FALSE = """
Every boy smiles.
A boy hugs a dog.
Kim is a dog.
Most dogs smile.
Every dog hugs Kim.
There is a cat.
Both boys smile.
The cats hug a boy.
"""


@pytest.mark.parametrize("text", [it for it in TRUE.split("\n") if it])
def test_what_is_true_in_the_model(M, text):
    assert understand(text).judge(M).p == (1, 1)


@pytest.mark.parametrize("text", [it for it in FALSE.split("\n") if it])
def test_what_is_false_in_the_model(M, text):
    found = understand(text).judge(M)
    assert found.p == (0, 0)
    assert "✗" in str(found.why)


def test_most_of_nothing_is_neither(M):
    with pytest.raises(UndefinedError, match="cat"):
        understand("Most cats smile.").judge(M)


def test_every_dog_hugs_a_boy_and_what_a_pronoun_picks_up(M):
    dogs, boys = pronoun_antecedents(M, understand("Every dog hugs a boy."))
    assert dogs is FiniteSet("fido", "rex")
    assert boys is FiniteSet("kim", "sam")
    about_boys = understand("They smile.", picked=[boys])
    assert about_boys.judge(M).p == (0, 0)
    one = pronoun_antecedents(M, understand("Exactly one boy smiles."))
    assert understand("He smiles.", picked=one).judge(M).p == (1, 1)
    assert pronoun_antecedents(M, understand("Kim hugs a boy.")) == ()


def test_a_pronoun_after_a_dog_picks_up_those_that_bark_alone(M):
    bark = english().meaning("IV", "bark")
    barking = M.given("w", bark("fido"))
    assert pronoun_antecedents(barking, understand("A dog barks.")) == (
        FiniteSet("fido"),
    )


def test_a_donkey_pronoun_is_strong_after_every(M):
    words = english()
    donkey, farmer = words.meaning("NOUN", "donkey"), words.meaning("NOUN", "farmer")
    own, beat = words.meaning("TV", "own"), words.meaning("TV", "beat")
    M = M.given("f", farmer("sam"))
    for name in ("kim", "rex"):
        M = M.given(f"k{name}", donkey(name)).given(f"o{name}", own("sam", name))
    M = M.given("b", beat("sam", "rex"))
    every = understand("Every farmer who owns a donkey beats it.")
    assert every.judge(M).p == (0, 0)
    assert understand("Some farmer who owns a donkey beats it.").judge(M).p == (1, 1)
    assert every.judge(M.given("c", beat("sam", "kim"))).p == (1, 1)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("Every pupy barks.", "no word 'pupy'\nhelp: did you mean puppy\\?"),
        ("Every xylophone barks.", "no word 'xylophone'$"),
        ("Fido and Rex bark.", "no construction with 'and' after 'Fido'"),
        ("Every dog", "something is missing at its end"),
        ("", "this text is empty"),
        ("It barks.", "'It' has nothing to stand for"),
        ("Fido is every dog.", "after is stands an adjective"),
        ("There is every dog.", "takes no noun phrase with every"),
        ("There are few dogs.", "needs to say of which share"),
        ("Fido is fake.", "fake needs a noun after it"),
        ("Kim is " + "very " * 9 + "good.", "at most 8 adverbs"),
        ("Kim likes " + "very " * 80 + "good dogs.", "at most 300 characters"),
    ],
)
def test_what_is_outside_is_told_in_one_line(text, why):
    with pytest.raises(OutsideFragmentError, match=why) as told:
        understand(text)
    assert "\n" not in told.value.message


# --- lexicons ------------------------------------------------------------------------


def test_a_lexicon_can_be_extended(tmp_path):
    more = tmp_path / "more.ttr"
    more.write_text(
        "basic Ind\npred wug(Ind), blick(Ind)\nobject zed : Ind\n"
        'nouns := ["wug"]\nintransitives := [["blick", "blacked"]]\nnames := ["Zed"]\n'
        "wug(x) <: blick(x)\n"
    )
    words = english().extend(more)
    content = understand("Every wug blicks.", words).content
    assert content is every(load(more).wug, load(more).blick)
    assert str(understand("Zed blacked.", words).content) == "blick(zed)"
    M = Model(words.theory).given("zed", Ind)
    M = M.given("s", load(more).predicates["wug"]("zed"))
    assert understand("Zed blicks.", words).judge(M).p == (1, 1)
    assert understand("Fido barks.", words).content is understand("Fido barks.").content


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (
            'basic Ind\nnouns := ["dog"]',
            r"<text>: .*no predicate dog\(Ind\) is declared",
        ),
        ('basic Ind\npred dgo(Ind)\nnouns := ["dog"]', "did you mean dgo"),
        ('basic Ind\npred dog(Ind)\ntransitives := ["dog"]', r"dog\(Ind, Ind\)"),
        ('basic Ind\nnames := ["Zed"]', "no object zed is declared"),
        ("basic Ind\nnouns := [[]]", "each a text or a list of texts"),
    ],
)
def test_a_word_without_a_meaning_is_a_mistake(text, why):
    with pytest.raises(TTRError, match=why):
        lexicon(Theory.parse(text))


CLASSES = [
    *("nouns", "names", "intersectives", "subsectives", "privatives", "intensifiers"),
    *("intransitives", "transitives", "adverbs", "modals", "attitudes"),
    "prepositions",
]


@pytest.mark.parametrize("left_out", CLASSES)
def test_a_lexicon_without_a_class_of_words_has_no_such_sentences(left_out):
    shipped = english().theory
    definitions = {k: v for k, v in shipped.definitions.items() if k != left_out}
    words = lexicon(replace(shipped, definitions=definitions))
    if left_out in ("nouns", "intransitives"):
        with pytest.raises(OutsideFragmentError, match="no word"):
            understand("Every dog smiles.", words)
    else:
        assert understand("Every dog smiles.", words).content


def test_a_lexicon_of_one_word_is_one():
    words = lexicon(Theory.parse('basic Ind\npred dog(Ind)\nnouns := ["dog"]'))
    assert str(understand("There is a dog.", words).content).startswith("exist(")
    with pytest.raises(OutsideFragmentError, match="no construction with 'dogs'"):
        understand("Every dog dogs.", words)
    with pytest.raises(OutsideFragmentError, match="no word 'dog'"):
        understand("There is a dog.", lexicon(Theory.parse("basic Ind")))


def test_regular_forms_are_known():
    words = english()
    for terminal, form, name in [
        ("NOUN", "cities", "city"),
        ("NOUN", "boys", "boy"),
        ("NOUN", "Committee  Members", "committee_member"),
        ("TV", "carries", "carry"),
        ("TV", "liked", "like"),
        ("IV", "takes part", "take_part"),
    ]:
        assert words.meaning(terminal, form).name == name


def test_what_excludes_each_other_is_kept_in_a_lexicon_of_several_files(tmp_path):
    more = tmp_path / "more.ttr"
    more.write_text(
        "basic Ind\npred wug(Ind), blick(Ind)\n"
        'nouns := ["wug", "blick"]\nwug(x) <: ~blick(x)\n'
    )
    words = english().extend(more)
    wug, blick = words.meaning("NOUN", "wug"), words.meaning("NOUN", "blick")
    with pytest.raises(TTRError, match="cannot have the probability 1"):
        Model(words.theory).given("s", wug("fido")).given("s", blick("fido"))
    assert follows([], "No wug is a blick.", words).verdict == "yes"
    assert follows([], "Some wug is a blick.", words).verdict == "no"


@pytest.mark.parametrize("text", ["", "  ", "...", "?!"])
def test_an_empty_text_is_no_sentence(text):
    with pytest.raises(OutsideFragmentError, match="this text is empty"):
        understand(text)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: understand(3), "a sentence is a text, found 3"),
        (lambda: understand("Fido barks.", 3), "expected a lexicon, found 3"),
        (lambda: understand("It barks.", picked=3), "sets of things, found 3"),
        (lambda: understand("It barks.", picked=["fido"]), "sets of things, found"),
        (
            lambda: follows("Every dog barks.", "Fido barks."),
            "list of sentences",
        ),
        (lambda: follows([3], "Fido barks."), "a sentence is a text, found 3"),
        (lambda: follows([], None), "a sentence is a text, found None"),
        (lambda: follows([], "Fido barks.", 3), "expected a lexicon, found 3"),
        (lambda: lexicon(3), "a lexicon is made of theories, found 3"),
        (lambda: english().word("NOUN", "puppie"), "did you mean puppies"),
        (lambda: english().word("VERB", "bark"), "no class of words is called 'VERB'"),
    ],
)
def test_what_is_asked_of_the_fragment_is_checked(ask, message):
    with pytest.raises(TTRError, match=message):
        ask()
