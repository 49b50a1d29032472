"""From text to readings: moves, ambiguity, forms of words, whatever may be typed."""

from __future__ import annotations

import subprocess
import sys
import time

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from kille.dialogue.grammars import GrammarError
from kille.dialogue.language import LANGUAGES, Sentence, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import (
    adjective,
    noun,
    predicate_at,
    record_type,
    set_to,
    theory,
    word_of,
)
from kille.dialogue.parsing import Grammar
from ttr import Ind, Pred, rectype, this
from ttr.errors import IllFormedError

MOVES = {
    "en": {
        "This is a cup. What is this?": ["instruct", "ask_name"],
        "The cup is red. No, it is blue!": ["describe", "correct"],
        "Hello, this is a cup.": ["greet", "instruct"],
        "Thanks! And where is the book?": ["thank", "ask_place"],
        "Yes. That is correct. Goodbye.": ["affirm", "affirm", "leave"],
        "Hello robot, what do you see?": ["greet", "ask_view"],
    },
    "sv": {
        "Det här är en kopp. Vad är det här?": ["instruct", "ask_name"],
        "Hej, det här är en kopp.": ["greet", "instruct"],
        "Tack! Och var är boken?": ["thank", "ask_place"],
        "Ja. Det stämmer. Hej då.": ["affirm", "affirm", "leave"],
    },
}


def moves(said: tuple[Sentence, ...]) -> list[str]:
    return [predicate_at(it.readings[0].type, "e").name for it in said]


def forms(text: str, language: str = "en") -> list[list[tuple[str, str]]]:
    """The words of each reading, with their articles."""
    (said,) = understand(text, language)
    return [[(it.form, it.article) for it in one.signs] for one in said.readings]


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [(lang, *case) for lang, cases in MOVES.items() for case in cases.items()],
)
def test_a_turn_may_be_several_moves(
    language: str, text: str, expected: list[str]
) -> None:
    assert moves(understand(text, language)) == expected


@pytest.mark.parametrize(
    "text",
    [
        "Det här är stort.",
        "Den här är stor.",
        "Det här är stor.",
        "Det här är boken.",
        "Det där är lådan.",
        "Det här är hus.",
        "De här är blå.",
    ],
)
def test_what_is_said_of_one_thing_is_no_lesson_about_all(text: str) -> None:
    [said] = understand(text, "sv")
    assert not any(it.type <= record_type("InstructSeveral") for it in said.readings)


@pytest.mark.parametrize(
    ("text", "language", "form"),
    [
        ("What is the other car?", "en", "car"),
        ("Show me the second car.", "en", "car"),
        ("Vad är boken?", "sv", "bok"),
        ("Vad är skon?", "sv", "sko"),
        ("Vad är skor?", "sv", "sko"),
    ],
)
def test_a_word_for_a_thing_is_first_taken_to_be_a_noun(
    text: str, language: str, form: str
) -> None:
    [said] = understand(text, language)
    [word] = said.readings[0].signs
    assert (word.form, word.kind) == (form, "noun")
    assert word.article in ("", lexicon(language).articles.of(form))


def test_a_parse_is_a_judgement_of_the_whole_event() -> None:
    (said,) = understand("This is a cup.")
    (reading,) = said.readings
    assert reading.type <= record_type("Heard")
    assert reading.type <= record_type("Instruct")
    assert str(reading.type["spkr"]) == "Ind@tutor"
    assert reading.type["text"].value == "This is a cup."


def test_ambiguity_is_kept_the_simplest_way_first() -> None:
    assert forms("Where is the teddy bear?") == [
        [("teddy bear", "")],
        [("teddy", ""), ("bear", "")],
    ]
    assert forms("Var är boken?", "sv") == [[("bok", "en")], [("boke", "en")]]


def test_setting_a_field_gives_the_record_type_that_has_it() -> None:
    dog = Pred("dog", Ind)
    T = rectype(x=Ind, c=dog(this.x))
    assert set_to(T, x=Ind @ "o1") is rectype(x=Ind @ "o1", c=dog(this.x))
    assert set_to(T, a=Ind, d=dog(this.y), y=Ind) is rectype(
        a=Ind, x=Ind, y=Ind, c=dog(this.x), d=dog(this.y)
    )
    with pytest.raises(IllFormedError, match="leads nowhere"):
        set_to(T, c=dog(this.z))
    with pytest.raises(IllFormedError):
        set_to(T, x=theory()["Text"])


@pytest.mark.parametrize("text", ["left of", "on the left of", "to the left of"])
def test_variants_of_a_relation_are_one_word(text: str) -> None:
    assert [it[1] for it in forms(f"The book is {text} the box.")[:1]] == [
        ("to the left of", "")
    ]


def test_the_article_is_what_the_tutor_said() -> None:
    assert forms("This is an hotel.")[0] == [("hotel", "an")]
    assert forms("Det här är ett blick.", "sv")[0] == [("blick", "ett")]
    assert lexicon().article(noun("hotel", "an")) == "an"
    assert lexicon().article(noun("hotel")) == "a"


@pytest.mark.parametrize(
    ("word", "definite", "plural"),
    [
        ("bok", "boken", "böcker"),
        ("hus", "huset", "hus"),
        ("äpple", "äpplet", "äpplen"),
        ("penna", "pennan", "pennor"),
        ("pojke", "pojken", "pojkar"),
        ("nyckel", "nyckeln", "nycklar"),
        ("fönster", "fönstret", "fönster"),
        ("nallebjörn", "nallebjörnen", "nallebjörnar"),
        ("skåp", "skåpet", "skåp"),
        ("burk med färg", "burken med färg", "burkar med färg"),
    ],
)
def test_swedish_nouns(word: str, definite: str, plural: str) -> None:
    swedish = lexicon("sv")
    article = swedish.article(noun(word))
    assert swedish.inflect(word, "DEFINITE", article) == definite
    assert swedish.inflect(word, "PLURAL", article) == plural
    assert [(word, article)] in forms(f"Var är {definite}?", "sv")


@pytest.mark.parametrize(
    ("word", "neuter", "weak"),
    [
        ("röd", "rött", "röda"),
        ("blå", "blått", "blå"),
        ("stor", "stort", "stora"),
        ("liten", "litet", "lilla"),
        ("svart", "svart", "svarta"),
        ("rund", "runt", "runda"),
        ("vit", "vitt", "vita"),
        ("prickad", "prickat", "prickade"),
        ("vacker", "vackert", "vackra"),
        ("öppen", "öppet", "öppna"),
        ("rosa", "rosa", "rosa"),
        ("grön", "grönt", "gröna"),
        ("randig", "randigt", "randiga"),
        ("fin", "fint", "fina"),
        ("tunn", "tunt", "tunna"),
        ("kort", "kort", "korta"),
        ("hård", "hårt", "hårda"),
        ("mjuk", "mjukt", "mjuka"),
        ("tjock", "tjockt", "tjocka"),
        ("gul", "gult", "gula"),
    ],
)
def test_swedish_adjectives(word: str, neuter: str, weak: str) -> None:
    swedish = lexicon("sv")
    assert swedish.inflect(word, "NEUTER", "ett") == neuter
    assert swedish.inflect(word, "WEAK", "en") == weak
    assert forms(f"Huset är {neuter}.", "sv")[0][-1][0] == word
    assert any(it[0][0] == word for it in forms(f"Var är den {weak} koppen?", "sv"))


@pytest.mark.parametrize("weak", ["stora", "gula", "fina", "sura", "lila"])
def test_an_e_is_left_out_only_after_a_consonant(weak: str) -> None:
    found = lexicon("sv").inflections["WEAK"]
    words = [word for one in found for word in one.words(weak)]
    assert words == [weak[:-1], weak]


def test_a_colour_means_the_same_in_every_language() -> None:
    (said,) = understand("Koppen är röd.", "sv")
    red = said.readings[0].signs[-1]
    assert red.form == "röd"
    assert word_of(red) is word_of(adjective("red"))


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_examples_of_the_lexicon_are_understood(language: str) -> None:
    for text in lexicon(language).examples:
        assert all(it.readings for it in understand(text, language)), text


@pytest.mark.parametrize("language", LANGUAGES)
@given(st.text(max_size=300))
@example("\x00")
@example("the " * 60)
@example("it's" * 70)
@example("det här är en kopp " * 20)
def test_any_text_is_understood_or_refused(language: str, text: str) -> None:
    for said in understand(text, language):
        assert isinstance(said.text, str)
        assert all(one.type <= record_type("Heard") for one in said.readings)


SMALL = (
    "this that it is not a an the red cup book left of to behind on other one first "
    "what where why no yes please show me how many cups are there you do see"
)


@given(st.lists(st.sampled_from(SMALL.split()), max_size=40))
@settings(max_examples=60)
def test_small_words_in_any_order_are_read_in_time(some: list[str]) -> None:
    text = " ".join(some)
    begun = time.thread_time()
    understand(text)
    assert time.thread_time() - begun < 2.0


def test_a_long_turn_is_understood_sentence_by_sentence() -> None:
    sentences = [f"This is a thingummy{n}." for n in range(400)]
    text = " ".join(sentences)
    assert len(text) > 8_000
    said = understand(text)
    assert [it.text for it in said] == sentences
    assert all(it.readings for it in said)


@pytest.mark.parametrize("text", ["x" * 10_000, "a " * 5_000, "🙂" * 10_000])
def test_nonsense_of_any_length_is_refused(text: str) -> None:
    assert not any(said.readings for said in understand(text))


def test_a_rule_that_begins_with_itself_is_refused() -> None:
    with pytest.raises(GrammarError, match="the rule phrase begins with itself"):
        Grammar('start: phrase\nphrase: phrase "x" | "y"')
    with pytest.raises(GrammarError):
        Grammar("start: (")


def test_lark_is_imported_when_something_is_said() -> None:
    code = (
        "import sys, kille.dialogue.language; assert not "
        "[m for m in sys.modules if m == 'lark']"
    )
    done = subprocess.run([sys.executable, "-c", code], check=False)
    assert done.returncode == 0
