"""What the robot makes of what tutors really say, and what it learns of it.

    python benchmarks/tutors.py [--language en|sv] [--held] [--idioms] [--unjudged]
        [--all] [--only NUMBERS]

Each utterance of `tests/kille/dialogue/tutors/utterances_*.tsv` is said in its scene:
the things that the scene names lie from left to right, those that it calls known were
taught, and the robot has said what the scene has it say, where a lesson and a question
bring it to that: it was taught that a book is red, and is asked whether it is. What the
robot answers, and which lessons are new, gives the class:

    wrong      it learned a word, or denied one, that `lessons_*.tsv` does not allow
    helpful    it did not understand, and says what could be said instead
    refused    it did not understand, and says no more than that
    understood it was understood, and `judged_*.tsv` calls the answer sensible
    odd        it was understood, and `judged_*.tsv` calls the answer none that helps
    unjudged   nobody has judged this answer yet

`judged_*.tsv` is about answers, word for word: another answer has to be judged anew.
With `--idioms`, how many of the idioms teach anything, in front of one thing. With
`--held`, the lists of the folder `held`, which were written by somebody who knew only
their form. They are no measure any more once somebody has read them who then changes
the grammar: whoever does so writes others.
"""

from __future__ import annotations

import argparse
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from kille.agent.agent import Agent
from kille.dialogue.language import LANGUAGES
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import is_denial, noun
from kille.dialogue.phrases import noun_phrase
from kille.dialogue.reference import thing_at
from kille.dialogue.word_lists import word_lists
from kille.scene import Look
from kille.sensors.sensor import SensorError
from ttr import Record

DATA = Path(__file__).resolve().parent.parent / "tests/kille/dialogue/tutors"
CLASSES = ("understood", "helpful", "refused", "odd", "wrong", "unjudged")
TOYS = ("cup", "book", "banana", "car", "apple", "can of paint", "teddy bear", "cap")
LOOKS_LIKE = {
    "box": "shoe-box", "mug": "cup", "teddy": "teddy bear", "glass": "cup",
    "kopp": "cup", "mugg": "cup", "bok": "book", "äpple": "apple", "bil": "car",
    "leksaksbil": "car", "nalle": "teddy bear", "låda": "shoe-box", "banan": "banana",
    "böcker": "book", "pärm": "book", "glas": "cup",
}  # fmt: skip
COUNTS = {
    "two": 2, "three": 3, "four": 4, "five": 5, "både": 2, "två": 2, "tre": 3,
    "fem": 5, "x2": 2,
}  # fmt: skip
NO_THING = re.compile(
    r"^(empty|no scene|robot|tutor|visitor|session|mistake|relation|several|unknown"
    r"|tomt|inget|ingenting|besökare|slut|ny session|roboten|läraren|kollega"
    r"|oklart|avbruten|okänt|flera)\b"
)
ALONE = re.compile(r"\b(alone|known|ensam\w*|känd\w*|both|båda|gap|held|lärd|lärt)\b.*")
BETWEEN = re.compile(
    r",| and | och | on | in | under | beside | behind | left of | right of | near "
    r"| by | with | round | between | across | in front of | far from | på | i | bakom "
    r"| bredvid | under | vänster om | till höger om | runt | långt från "
)
AMID = re.compile(
    r"(?P<amid>.+) (?:between|mellan) (?P<left>.+) (?:and|och) (?P<right>.+)"
)
POINTED = re.compile(r"(?:points at|pekar på|utpekad)\s*(?:the )?(\w+)?")
ROBOT = r"(?:robot|roboten) (?:asked|said|frågade|sade): (?:kanske )?"
A, THIS = (
    r"(?:an?|en|ett|ingen|inget)",
    r"(?:it|this|that|(?:det|den)(?: här| där)?|detta)",
)
CLAIMED = re.compile(
    rf"{ROBOT}(?:(?:(?:Is {THIS}|{THIS} is|Är {THIS}|{THIS} är) )?{A} )?"
    r"(?!OK$|I do|vet|left|till|vänster)([^\W\d_]+)(?: too)?\??$",
    re.I,
)
ASKED = re.compile(
    rf"{ROBOT}(?:What is|Vad är) {THIS}\??$|{ROBOT}(?:I do not|vet inte)", re.I
)
ASKED_WHICH = re.compile(
    rf"{ROBOT}(?:(?:Is it|Är det) )?(?:{A} )?(\w+) (?:or|eller) (?:{A} )?(\w+)", re.I
)
ASKED_COLOUR = re.compile(rf"{ROBOT}(?:What colour is|Vilken färg har) ", re.I)
ASKED_PLACE = re.compile(rf"{ROBOT}(Where is the \w+|Var är \w+)", re.I)
SAID_OF_SIDE = re.compile(
    r"(?:robot|roboten) (?:asked|said|frågade|sade): (?:Is |Är )?(?:the |den |det )?"
    r"(left|right|vänstra|högra)(?: one| thing)? (?:is |är )?(?:an?|en|ett) (\w+)",
    re.I,
)
SAID_KIND = re.compile(rf"{ROBOT}A (\w+) is a (\w+)", re.I)
SAID_PLACE = re.compile(
    rf"{ROBOT}(?:The (?P<of>\w+) is )?(?P<place>behind|left of|till höger|vänster)\b"
    r"(?: the (?P<by>\w+))?$",
    re.I,
)
SAID_QUALITY = re.compile(
    rf"{ROBOT}(?:the |är )?\w+ (?:is |är )?(?P<how>blå|röd|tjock|red)\??$",
    re.I,
)
KNOWN = re.compile(r"([^;]+?) (?:known|kända|känt|känd)\b")
KNOWN_ALL = re.compile(r"^(?:all|both|alla|båda|everything|allt)\b")
KNOWN_NONE = re.compile(r"^(?:nothing|inget|ingenting)\b")
TAUGHT_NAMES = re.compile(r"(?:tutor (?:just )?taught|läraren lärde(?: just)?) ([^;]+)")
TAUGHT_NAME = re.compile(
    r"([\w -]+?) (?:for|för) (?:(it|den|det|saken)|(?:the |den |det )?([\w-]+))"
    r"(?: one| thing| saken)?$"
)
LISTED = re.compile(r", | and | och ")
LEFT, RIGHT = ("left", "vänstra"), ("right", "högra")
SAID_BEFORE = re.compile(r"(?:läraren|tutor) (?:sade nyss|said): Det är \w+ (\w+)")
TAUGHT_PLACE = re.compile(r"drop (\w+)\((\w+), (\w+)\)")
ANYTHING = {"en": "cup", "sv": "kopp"}
WHERE = ("left", "right", "vänster", "höger")
SINGULARS = {
    "en": {it + "s": it for it in ("cup", "mug", "spoon", "plate", "stone", "coin")},
    "sv": {"koppar": "kopp", "muggar": "mugg", "bollar": "boll", "böcker": "bok"},
}
SINGULAR_ENDINGS = {
    "en": {"xes": "x", "ss": "ss", "s": ""},
    "sv": {"or": "a", "ar": "", "er": ""},
}
PLURAL = {"en": re.compile(r"(?<!s)s$"), "sv": re.compile(r"[oa]r$")}
TELLS = {
    "en": {
        "name": "This is {}.",
        "ask name": "What is this?",
        "ask colour": "What colour is it?",
        "how": "It is {}.",
        "ask how": "Is it {}?",
        "place": "The {1} is {0} the {2}.",
        "ask place": "Where is the {}?",
        "kind": "{} is a kind of {}.",
        "ask kind": "Is {} a kind of {}?",
        "ask find": "Show me the {}.",
        "yes": "Yes.",
        "no": "No.",
    },
    "sv": {
        "name": "Det här är {}.",
        "ask name": "Vad är det här?",
        "ask colour": "Vilken färg har den?",
        "how": "Den är {}.",
        "ask how": "Är den {}?",
        "place": "{1} är {0} {2}.",
        "ask place": "Var är {}?",
        "kind": "{} är en sorts {}.",
        "ask kind": "Är {} en sorts {}?",
        "ask find": "Visa mig {}.",
        "yes": "Ja.",
        "no": "Nej.",
    },
}  # fmt: skip
PLACES = {
    "left of": "to the left of", "till höger": "till höger om",
    "vänster": "till vänster om",
}  # fmt: skip


class Line(NamedTuple):
    """An utterance, its scene, and what a competent listener would do."""

    number: str
    scene: str
    utterance: str
    act: str
    ideal: str


class Outcome(NamedTuple):
    """What came of an utterance."""

    line: Line
    answer: str
    learned: tuple[str, ...]
    kind: str


def rows(folder: Path, name: str) -> Iterator[list[str]]:
    """The rows of a file of data; none if there is no such file."""
    with suppress(FileNotFoundError):
        for row in (folder / name).read_text("utf-8").splitlines():
            if row and not row.startswith("#"):
                yield row.split("\t")


def things_in(scene: str, language: str) -> list[str]:
    """What lies on the table in a scene, from left to right, by the names in it."""
    head, some, plural = (
        scene.split(";")[0].strip(),
        ANYTHING[language],
        PLURAL[language],
    )
    if NO_THING.match(head):
        return [] if re.match(r"empty|tomt", head) else [some]
    amid = AMID.match(head)
    if amid:
        head = ", ".join(amid.group("left", "amid", "right"))
    singulars = SINGULARS[language]
    found: list[str] = []
    for part in BETWEEN.split(ALONE.sub("", head)):
        words = part.split()
        if not words:
            continue
        times = next((n for word, n in COUNTS.items() if word in words), 1)
        names = [it for it in words if it not in COUNTS and it not in WHERE]
        is_plural = times == 1 and names and plural.search(names[-1])
        known = names and names[-1] in ("scissors", "glasses", "glasögon")
        several = is_plural and not known
        name = singulars.get(names[-1], names[-1]) if names else ""
        if times > 1:
            name = singular(name, language)
        found += [name] * (3 if several else times) if names else []
    return found[:5] or [some]


def singular(name: str, language: str) -> str:
    """The word for one of the things that a plural in a scene names."""
    for ending, one in SINGULAR_ENDINGS[language].items():
        if name.endswith(ending):
            return name.removesuffix(ending) + one
    return name


def known_words(scene: str, things: Sequence[str]) -> list[str] | None:
    """The words that a scene says are known; None where it names none."""
    found: list[str] = []
    listed = KNOWN.findall(scene.partition(";")[2])
    for words in listed:
        if KNOWN_ALL.search(words.strip()):
            found += things
        elif not KNOWN_NONE.search(words.strip()):
            found += [it.strip() for it in LISTED.split(words)]
    return found if listed else None


def taught_names(scene: str, things: Sequence[str]) -> Iterator[tuple[str, int]]:
    """The words that a tutor taught in a scene, each with the place of its thing."""
    for words in TAUGHT_NAMES.findall(scene):
        for one in LISTED.split(words):
            if not (told := TAUGHT_NAME.match(one.strip())):
                continue
            word, it, which = told.groups()
            like = [n for n, thing in enumerate(things) if which and which in thing]
            place = len(things) - 1 if which in RIGHT else (like or [0])[0]
            yield word, 0 if it or which in LEFT else place


def toy_names(things: Sequence[str]) -> list[str]:
    """A toy for each thing: the one that it looks like, or else one that is left."""
    given: list[str] = []
    for thing in things:
        name = re.sub(r"s$", "", thing)
        toy = LOOKS_LIKE.get(name, name)
        free = [it for it in (*TOYS, "shoe-box") if it not in given]
        given.append(toy if toy in free else free[0])
    return given


def set_up(robot: Agent, line: Line, language: str) -> None:
    """Lay out the scene, and say what was said before."""
    taught = (
        TAUGHT_PLACE.search(line.ideal) if "relation taught" in line.scene else None
    )
    kinds = SAID_KIND.search(line.scene)
    things = list(taught.groups()[1:]) if taught else things_in(line.scene, language)
    things = [kinds[1]] if kinds else things
    things = ["mugg"] if line.scene == "kopp lärd fel" else things
    stands, how = SAID_PLACE.search(line.scene), SAID_QUALITY.search(line.scene)
    if stands and len(things) < 2:
        things += [{"en": "box", "sv": "låda"}[language]]
    tells, words = TELLS[language], lexicon(language)

    def tell(what: str, *about: str) -> str:
        return robot.hear(tells[what].format(*about))

    def the(word: str) -> str:
        sign = noun(word)
        return noun_phrase(words, sign, "definite").removeprefix("the ")

    toys = toy_names(things)
    gap = 0.26 if "shoe-box" in toys else 0.18
    claim, side = CLAIMED.search(line.scene), SAID_OF_SIDE.search(line.scene)
    known_now = known_words(line.scene, things)
    for word in known_now or ():
        if word not in things and not is_quality(word, language):
            robot.do(f"show {toys[0] if toys else TOYS[0]}")
            tell("name", words.with_article(word))
            robot.do(f"remove {toys[0] if toys else TOYS[0]}")
    for place, toy in enumerate(toys):
        across = gap * (place - (len(toys) - 1) / 2)
        with suppress(SensorError):
            robot.do(f"place {toy} at {across:.2f} 0.0")
    pointed = POINTED.search(line.scene)
    at = place_pointed(pointed[1], things) if pointed and pointed[1] else 0
    if claim:
        name = tells["name"].format(words.with_article(claim[1]))
        robot.hear(f"#{number_at(robot, at)} {name}" if len(things) > 1 else name)
        robot.do("restart")
    if side:
        at = len(things) - 1 if side[1].lower() in RIGHT else 0
        name = tells["name"].format(words.with_article(side[2]))
        robot.hear(f"#{number_at(robot, at)} {name}")
        robot.do("restart")
    asked = ASKED_PLACE.search(line.scene)
    known = re.search(
        r"known|känd|lärd|lärt|robot pointed|ångrar|robot said: OK", line.scene
    )
    is_taught = line.act.startswith(("learn attr", "learn rel", "learn kind")) or (
        line.act in ("answer", "count", "explain", "forget", "svara") or known
    )
    is_taught = bool(is_taught or taught or kinds or stands or how or asked)
    if "pointed out" in line.scene:
        things = things[::-1]
    if (
        is_taught
        and not claim
        and not re.search("unknown|okän|not know|vet inte", line.scene)
    ):
        for place, thing in enumerate(things):
            name = tells["name"].format(words.with_article(thing))
            if known_now is None or thing in known_now:
                robot.hear(f"#{number_at(robot, place)} {name}")
    for word, place in taught_names(line.scene, things):
        name = tells["name"].format(words.with_article(word))
        robot.hear(f"#{number_at(robot, place)} {name}")
    if pointed and pointed[1]:
        robot.do(f"point {number_at(robot, at)}")
    if before := SAID_BEFORE.search(line.scene):
        tell("name", words.with_article(before[1]))
    if which := ASKED_WHICH.search(line.scene):
        for it in which.groups():
            tell("name", words.with_article(it))
        tell("no")
    if kinds:
        tell("kind", words.with_article(kinds[1]).capitalize(), kinds[2])
        tell("yes")
        tell("ask kind", words.with_article(kinds[1]), kinds[2])
    if (stands or taught) and len(things) > 1:
        place = PLACES.get(stands["place"], stands["place"]) if stands else taught[1]
        tell("place", place, the(things[0]), the(things[1]))
        if stands:
            tell("ask place", the(things[0]))
    if how or "ångrar färg" in line.scene:
        tell("how", how["how"] if how else "röd")
        if how:
            tell("ask how", how["how"])
    if asked:
        robot.hear(f"{asked[1]}?")
    if ASKED_COLOUR.search(line.scene):
        tell("ask colour")
    if "pointed out" in line.scene:
        tell("ask find", the(things[0]))
    if side:
        robot.hear(f"#{number_at(robot, at)} {tells['ask name']}")
    elif claim or ASKED.search(line.scene):
        tell("ask name")


def is_quality(word: str, language: str) -> bool:
    """Whether a word says how things are, and is known from the beginning."""
    return word in word_lists(language).qualities


def place_pointed(word: str, things: Sequence[str]) -> int:
    """The place of the thing to which a tutor points in a scene, by its word."""
    if word in (*LEFT, *RIGHT):
        return len(things) - 1 if word in RIGHT else 0
    return next((i for i, it in enumerate(things) if it.startswith(word[:4])), 0)


def number_at(robot: Agent, place: int) -> int:
    """The number of the thing at this place from the left."""
    view = robot.gaze.look()
    return 1 + ranks(view.look).index(place) if place in ranks(view.look) else 1


def ranks(look: Look) -> list[int]:
    """The place of each thing from the left, in the order of their numbers."""
    across = [it.region.box.left for it in look.percepts]
    return [sorted(across).index(left) for left in across]


def lessons(robot: Agent) -> Counter[str]:
    """The lessons of this robot, as `cup@1`: a word, and its place from the left."""
    view = robot.view
    places = [] if view is None else ranks(view.look)

    def told(it: Record) -> str:
        x = thing_at(it.content, "target") or "o1"
        at = int(x[1:]) - 1
        place = places[at] + 1 if at < len(places) else 1
        sign = "-" if is_denial(it.content) else ""
        return f"{sign}{it.sign.form}@{place}"

    return Counter(told(it) for it in robot.state.private.lessons)


def play(line: Line, language: str) -> tuple[str, tuple[str, ...], bool]:
    """Say a line in its scene: the answer, what changed, and if it was understood."""
    with Agent("synthetic:empty?seed=5", language=language, scans=2) as robot:
        set_up(robot, line, language)
        before = lessons(robot)
        answer = robot.hear(line.utterance)
        new, gone = lessons(robot) - before, before - lessons(robot)
        said = robot.exchanges[-1].said
        understood = not said or any(it.judgement is not None for it in said)
        changes = (*sorted(new.elements()), *(f"forgot {it}" for it in sorted(gone)))
        return answer.replace("\n", " / "), changes, understood


def right_lessons(line: Line, extra: Mapping[str, Sequence[str]]) -> frozenset[str]:
    """The lessons that are right for a line, by `lessons_*.tsv`."""
    return frozenset(extra.get(line.number, ()))


def is_right(lesson: str, right: Iterable[str]) -> bool:
    """Whether a lesson is one of those allowed; `cup` allows any place."""
    return any(lesson == it or lesson.split("@")[0] == it for it in right)


def outcomes(language: str, folder: Path = DATA, only: str = "") -> Iterator[Outcome]:
    """What comes of every utterance of a language in the lists of a folder."""
    right = {it[0]: it[1].split(", ") for it in rows(folder, f"lessons_{language}.tsv")}
    judged = {(it[0], it[1]): it[2] for it in rows(folder, f"judged_{language}.tsv")}
    helps = lexicon(language).not_understood[0].split("{nearest}")[0][-12:]
    for row in rows(folder, f"utterances_{language}.tsv"):
        line = Line(*row)
        if only and line.number not in only.split(","):
            continue
        answer, changes, understood = play(line, language)
        new = [it for it in changes if not it.startswith("forgot ")]
        if not all(is_right(it, right_lessons(line, right)) for it in new):
            kind = "wrong"
        elif not understood:
            kind = "helpful" if helps in answer else "refused"
        else:
            kind = judged.get((line.number, answer), "unjudged")
        yield Outcome(line, answer, changes, kind)


def taught_by(texts: Iterable[str], language: str) -> Iterator[tuple[str, list[str]]]:
    """The texts that teach something in front of one thing, and what."""
    for text in texts:
        with Agent("synthetic:empty?seed=5", language=language, scans=2) as robot:
            robot.do("show cup")
            robot.hear(text)
            if new := sorted(lessons(robot).elements()):
                yield text, new


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--language", choices=LANGUAGES)
    parser.add_argument("--idioms", action="store_true")
    parser.add_argument("--unjudged", action="store_true", help="only those to judge")
    parser.add_argument("--all", action="store_true", help="every line")
    parser.add_argument("--only", default="", metavar="NUMBERS")
    parser.add_argument("--held", action="store_true", help="the lists held back")
    options = parser.parse_args()
    folder = DATA / "held" if options.held else DATA
    for language in [options.language] if options.language else LANGUAGES:
        if options.idioms:
            texts = (DATA / f"idioms_{language}.txt").read_text("utf-8").splitlines()
            found = list(taught_by(texts, language))
            for text, new in found:
                print(f"  {text}  {new}")
            print(f"{language}: {len(found)} of {len(texts)} idioms teach something")
            continue
        counts = Counter[str]()
        for it in outcomes(language, folder, options.only):
            counts[it.kind] += 1
            if options.all or (it.kind == "unjudged" and options.unjudged):
                learned = ", ".join(it.learned)
                print(
                    "\t".join((it.line.number, it.answer, it.kind, learned, *it.line))
                )
        print(language, *(f"{kind} {counts[kind]}" for kind in CLASSES), sep=", ")


if __name__ == "__main__":
    main()
