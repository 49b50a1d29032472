"""IBiS1 for a domain, as a game that can be played.

The update algorithm and the selection of moves are those of Larsson 2002, chapter 2.
The system's moves are made as one utterance, which is grounded and integrated as the
user's are.
"""

from __future__ import annotations

from collections.abc import Callable

from ttr.judging.judgements import Judgement
from ttr.semantics.gameboards.ibis.domains import Domain
from ttr.semantics.gameboards.ibis.integrating import integration, own_integration
from ttr.semantics.gameboards.ibis.planning import plan_execution
from ttr.semantics.gameboards.ibis.selecting import selection
from ttr.semantics.gameboards.ibis.state import START, STATE, USER
from ttr.semantics.gameboards.ibis.turn_grounding import GROUNDING, get_own_moves
from ttr.theories.theory import Theory
from ttr.updates import Algorithm, Game, first, maybe, seq


def algorithm(domain: Domain) -> Algorithm:
    """The update algorithm for utterances of the system and of the user.

    Both are grounded and integrated move by move, then the plan is carried out. After
    the user's turn the system selects what to say; after its own, whether to go on.

    >>> from ttr import Model
    >>> from ttr.semantics.gameboards.ibis import Domain
    >>> from ttr.updates import rules_of
    >>> len(rules_of(algorithm(Domain({}, lambda *_: None, Model()))))
    34
    """
    carry_out, select = maybe(plan_execution(domain)), selection(domain)
    integrated = maybe(own_integration(domain))
    own = seq(get_own_moves, integrated, carry_out, maybe(select.going_on))
    users = seq(GROUNDING, maybe(integration(domain)), carry_out)
    return first(own, seq(users, maybe(select.answering)))


def game(
    name: str,
    domain: Domain,
    *,
    hear: Callable[[str], object] | None = None,
    say: Callable[[Judgement], str] | None = None,
    theory: Theory | None = None,
) -> Game:
    """The game in which a system answers questions about this domain.

    `hear` reads the user's texts, and `say` puts the system's utterances into words;
    `theory` has the names that stories may use.

    >>> from ttr import Model
    >>> from ttr.semantics.gameboards.ibis import Domain
    >>> empty = game("silent desk", Domain({}, lambda *_: None, Model()))
    >>> print(empty.take(empty.begin()).said[0].type)
    [moves = [greet(sys)] : list(Move), spkr = sys : Participant]
    """
    return Game(
        name,
        STATE,
        START,
        algorithm(domain),
        domain.model,
        agenda="output",
        hears=(USER,),
        hear=hear,
        say=say,
        theory=theory,
    )
