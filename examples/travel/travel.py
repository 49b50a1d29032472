"""A travel agency by IBiS1: what a domain is, and a dialogue with its trace.

Run it with `python examples/travel/travel.py`, and read along. The stories beside it
are played by `ttr play examples/travel/travel.dlg`.
"""

import tomllib
from pathlib import Path

from ttr import Model, load, rectype
from ttr.semantics.gameboards.ibis import Domain, PhraseBook
from ttr.semantics.gameboards.ibis import game as ibis
from ttr.semantics.questions import asked_of

# The sorts, the questions, the plans and what is on sale are a theory. Numbers are
# prices, and the objects of the theory are of their sorts.

HERE = Path(__file__).resolve().parent
theory = load(HERE / "travel.ttr")
sorts = Model(theory).witnessed(theory["Price"], by=lambda a: isinstance(a, int))

# The database answers a question by what is agreed on. A return ticket costs as much
# again, and business class half as much again.


def agreed_on(question, agreed, model):
    """The object that is agreed on as the answer to a question which, or None."""
    for P in agreed:
        found = asked_of(question, P, model)
        if found is not None:
            return found.x
    return None


def cost(agreed, model):
    """What the trip costs that is agreed on; None where there is no such trip."""
    asked = {"means": "How", "depart_city": "Depart", "dest_city": "Dest"}
    wanted = {k: agreed_on(theory[q], agreed, model) for k, q in asked.items()}
    for trip in theory["Trips"]:
        if all(trip[label] == value for label, value in wanted.items()):
            both_ways = theory["Return"].body in agreed
            business = agreed_on(theory["TravelClass"], agreed, model) == "business"
            price = trip.price * (1 + both_ways) * (3 if business else 2) // 2
            return rectype(e=theory["price"](price))
    return None


def lookup(question, agreed, model):
    """The answer to an issue by the tables of the theory."""
    if question is theory["Cost"]:
        return cost(agreed, model)
    country = agreed_on(theory["VisaCountry"], agreed, model)
    if question is not theory["Visa"] or country is None:
        return None
    needed = theory["Visa"].body
    return needed if country in theory["NeedVisa"] else ~needed


plans = {
    theory["Cost"]: theory["PricePlan"],
    theory["Visa"]: theory["VisaPlan"],
}
domain = Domain(plans, lookup, sorts)

# The little English is a table. A game is a domain and a language.

english = tomllib.loads((HERE / "english.toml").read_text(encoding="utf-8"))
book = PhraseBook.of(theory, domain.model, **english)
game = ibis("travel", domain, hear=book.hear, say=book.say, theory=theory)

# A dialogue, with the rules that ran in one of its turns.

DIALOGUE = [
    "",
    "Hi! I want price information, please.",
    "by train",
    "from London to Paris",
    "in may, economy class",
    "no",
    "thanks, bye",
]


def talk(texts):
    """Prints what both say."""
    so_far = game.begin()
    for text in texts:
        turn = game.take(so_far, book.hear(text))
        so_far = turn.run
        print(f"U> {text}")
        for said in turn.said:
            print(f"S> {book.say(said)}")
    return so_far


if __name__ == "__main__":
    talk(DIALOGUE)
    first, second, third, *_ = game.play(map(book.hear, DIALOGUE))
    print("\nWhat happened when the user answered the first question:\n")
    print(third)
