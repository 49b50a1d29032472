"""What a speaker sets right at once: "it's a blal. *ball", "it's green. I mean red!".

Such a repair is said, or typed, after what looks like the end of a sentence. It is
written as the one that it is, so that nothing of what was said first is learned:
"it's a blal, i mean, ball".

Source: Schegloff, Jefferson and Sacks 1977, for repairs of oneself; the asterisk is the
custom of chats.
"""

from __future__ import annotations

import re

from kille.dialogue.typos import is_misspelling, slip
from kille.dialogue.word_lists import WordLists

_AGAIN = re.compile(
    r"(?P<first>[^\W\d_]+)"
    r"(?:(?P<pause>\s*[.…,]+\s*|\s+[-–—]+\s+)(?P<star>\*?)|\s+(?P<mark>\*))"
    r"(?:(?P<article>[^\W\d_]+)\s+)??(?P<again>[^\W\d_]+)\*?(?=\s*(?:[.!…]|$))"
)
"""A word, a pause, and perhaps the same word again, at the end of a sentence."""

_ARTICLE_FIRST = re.compile(
    r"(?P<right>\b(?P<one>\w+) (?P<noun>\w+))\W+"
    r"(?:\w+ )??(?P<no>\w+) (?P<other>\w+) (?P=noun)\b",
    re.IGNORECASE,
)
"""A noun, and then the same noun with an article that it does not have."""

_ARTICLE_LAST = re.compile(
    r"\b(?P<no>\w+) (?P<other>\w+) (?P<noun>\w+)\W+"
    r"(?:\w+ )??(?P<right>(?P<one>\w+) (?P=noun))\b",
    re.IGNORECASE,
)
"""The same the other way round: "not a apple, an apple"."""

_MARKED = re.compile(r"\s*\*\s*([^\W\d_][^*.!?]*?)\*?[.!…]*\s*")
"""A text that is all a repair of what was said in the turn before: "*ball"."""

_ONE_WORD = 2
"""How many words what takes the place of another has at most: "a mug"."""

_SHORT = 3
"""Letters; shorter words are alike by chance."""


def join_repairs(text: str, lists: WordLists) -> str:
    """The text with repairs of its last word in the sentence that they are about.

    An asterisk marks a repair, and so does a pause before nearly the same word, or a
    short sentence that begins with "I mean".

    >>> from kille.dialogue.word_lists import word_lists
    >>> english = word_lists("en")
    >>> join_repairs("it's a blal. *ball", english)
    "it's a blal, i mean, ball"
    >>> join_repairs("It's green. I mean red! The mug is blue.", english)
    "It's green, I mean red! The mug is blue."
    >>> join_repairs("This is a cup. Thanks.", english)
    'This is a cup. Thanks.'

    That a noun has one article and not another is said of the word, and of no thing.

    >>> join_repairs("Förlåt, ett äpple. Inte en äpple.", word_lists("sv"))
    'Förlåt, ett äpple.'
    """
    if not lists.repair:
        return text
    text = _settle_article(text, lists)
    if marked := _MARKED.fullmatch(text):
        return f"{lists.repair} {marked[1]}"
    return _join_again(_join_renewals(text, lists), lists)


def settle_spelling(text: str) -> str:
    """The text without a word that is spelled, or with it in one, and nothing like it.

    >>> settle_spelling("It is a CUP. C-U-P.")
    'It is a CUP. '
    >>> settle_spelling("bannana. argh b a n a n a")
    'argh banana'
    """
    found = _SPELLED.search(text)
    if found is None:
        return text
    word = re.sub(r"[\W_]", "", found[0]).lower()
    before, after = text[: found.start()], text[found.end() :]
    if re.search(rf"\b{word}\b", before + after, re.I):
        return before + after.lstrip(".!")
    near = [it for it in re.findall(r"\w+", before) if is_misspelling(it.lower(), word)]
    for it in near:
        before = re.sub(rf"\b{it}\b[.,;!]*\s*", "", before)
    return before + word + after


_SPELLED = re.compile(r"(?<![\w'’-])(?:[^\W\d_][- ]){2,}[^\W\d_](?![\w'’-])")
"""A word that is said letter by letter."""


def _settle_article(text: str, lists: WordLists) -> str:
    """The text with the right article of a noun only, where a wrong one is denied."""

    def settle(found: re.Match[str]) -> str:
        one, other = found["one"].lower(), found["other"].lower()
        both = one != other and {one, other} <= lists.articles
        return (
            found["right"]
            if both and found["no"].lower() in lists.negations
            else found[0]
        )

    return _ARTICLE_FIRST.sub(settle, _ARTICLE_LAST.sub(settle, text))


def _join_again(text: str, lists: WordLists) -> str:
    """The text with words that are said again as repairs."""

    def join(found: re.Match[str]) -> str:
        first, again, article = found["first"], found["again"], found["article"]
        if article and article.lower() not in lists.articles:
            return found[0]
        said = re.findall(r"\w+", text[: found.start()].lower())
        if not lists.negations.isdisjoint(said[-2:]):
            return found[0]  # "Not a mug, a jug."
        marked = found["star"] or found["mark"]
        if marked or _is_again(first.lower(), again.lower(), found["pause"], lists):
            return f"{first}, {lists.repair}, {again}"
        return found[0]

    return _AGAIN.sub(join, text)


def _is_again(first: str, again: str, pause: str, lists: WordLists) -> bool:
    """Whether a word after a pause is another try at the one before it."""
    if lists.is_closed(first) or lists.is_closed(again) or len(again) < _SHORT:
        return False
    breaks_off = pause.strip() not in (".", ",") and again.startswith(first)
    return slip(first, again) is not None or (breaks_off and first != again)


def _join_renewals(text: str, lists: WordLists) -> str:
    """The text with sentences such as "I mean red!" in the one before them."""
    sentences = re.split(r"(?<=[.!…])\s+", text)
    joined = sentences[:1]
    for sentence in sentences[1:]:
        forms = re.findall(r"[\w'’]+", sentence.lower().replace("’", "'"))
        ends = (n for n in range(1, len(forms)) if tuple(forms[:n]) in lists.renewals)
        said = forms[max(ends, default=len(forms)) :]
        if 0 < len(said) <= _ONE_WORD and not sentence.endswith("?"):
            joined[-1] = joined[-1].rstrip(".!… ") + f", {sentence}"
        else:
            joined.append(sentence)
    return " ".join(joined) if len(joined) < len(sentences) else text
