"""Questions, what is about them, what resolves them, and what is under discussion."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import (
    Basic,
    Ind,
    Model,
    Pred,
    Rec,
    TTRError,
    fun,
    outer,
    record,
    rectype,
    subtype,
    this,
)
from ttr.errors import IllFormedError
from ttr.semantics.questions import (
    Question,
    asked_of,
    combine,
    downdate,
    find_answer,
    is_polar,
    is_question,
    pop,
    push,
    relevant,
    resolves,
    top,
    whether,
    which,
    which_of,
    with_questions,
)
from ttr.types import FiniteSet

City, Month = Basic("City"), Basic("Month")
dest, depart, month = Pred("dest", City), Pred("depart", City), Pred("month", Month)
back, fly = Pred("back", ()), Pred("fly", City, City)
M = Model().given("may", Month)
for city in ("paris", "london"):
    M = M.given(city, City)

TO, FROM, WHEN = which(dest), which(depart), which(month)
BACK = rectype(e=back())
RETURN = whether(BACK)
ECONOMY, BUSINESS = rectype(c=Pred("economy", ())()), rectype(c=Pred("business", ())())
CLASS = which_of(ECONOMY, BUSINESS)
ROUTE = fun(r=rectype(x=City, y=City))(rectype(e=fly(outer.r.x, outer.r.y)))
TO_PARIS, TO_LONDON = rectype(e=dest("paris")), rectype(e=dest("london"))


# --- what is a question --------------------------------------------------------------


@pytest.mark.parametrize("question", [TO, RETURN, CLASS, ROUTE, whether(Rec)])
def test_questions_are_functions_to_types_or_sets_of_them(question):
    assert is_question(question)
    assert with_questions(M).judge(question, Question).holds


@pytest.mark.parametrize(
    "value",
    [
        "paris",
        TO_PARIS,
        record(),
        FiniteSet(),
        FiniteSet(RETURN),
        FiniteSet(RETURN, TO),
        fun(x=Ind)(TO_PARIS),
        fun(r=Rec)("paris"),
        None,
    ],
)
def test_what_is_no_question(value):
    assert not is_question(value)
    assert with_questions(M).judge(value, Question).holds is False


def test_only_questions_whether_are_polar():
    assert is_polar(RETURN)
    assert not is_polar(TO)
    assert not is_polar(CLASS)


def test_what_asks_for_nothing_is_refused():
    with pytest.raises(TTRError, match="fly has no place that a question could ask"):
        which(fly)
    with pytest.raises(TTRError, match="at least two alternatives"):
        which_of(BACK)
    with pytest.raises(TTRError, match="this is no question: the object 'paris'"):
        relevant("yes", "paris", M)


# --- answers -------------------------------------------------------------------------

ABOUT = [
    # question, answer, what it comes to, whether it resolves the question
    (RETURN, "yes", BACK, True),
    (RETURN, "no", ~BACK, True),
    (RETURN, BACK, BACK, True),
    (RETURN, ~BACK, ~BACK, True),
    (TO, "paris", TO_PARIS, True),
    (TO, record(x="paris"), TO_PARIS, True),
    (TO, TO_PARIS, TO_PARIS, True),
    (TO, ~TO_PARIS, ~TO_PARIS, False),
    (CLASS, ECONOMY, ECONOMY, True),
    (CLASS, ~ECONOMY, ~ECONOMY, False),
    (ROUTE, record(x="paris", y="london"), rectype(e=fly("paris", "london")), True),
]


@pytest.mark.parametrize(("question", "answer", "proposition", "resolved"), ABOUT)
def test_what_an_answer_comes_to(question, answer, proposition, resolved):
    assert relevant(answer, question, M)
    assert combine(question, answer, M) is proposition
    assert resolves(answer, question, M) is resolved


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        (RETURN, "paris"),
        (RETURN, TO_PARIS),
        (RETURN, ~TO_PARIS),
        (TO, "yes"),
        (TO, "no"),
        (TO, "may"),
        (TO, "nowhere"),
        (TO, 5),
        (TO, record(x="may")),
        (TO, record(y="paris")),
        (TO, rectype(e=depart("paris"))),
        (TO, rectype(f=dest("paris"))),
        (TO, rectype(e=dest("may"))),
        (TO, ~rectype(e=dest("paris"), f=back())),
        (TO, Rec),
        (CLASS, "yes"),
        (CLASS, BACK),
        (ROUTE, "paris"),
    ],
)
def test_what_is_not_about_a_question(question, answer):
    assert not relevant(answer, question, M)
    assert not resolves(answer, question, M)
    with pytest.raises(TTRError, match="is no answer to the question"):
        combine(question, answer, M)


def test_a_more_specific_proposition_resolves_a_question():
    more = rectype(e=dest("paris"), m=month("may"))
    assert resolves(more, TO, M)
    assert combine(TO, more, M) is more


def test_a_manifest_field_is_what_it_is_set_to():
    set_to = rectype(x=City @ "paris", e=dest(this.x))
    assert asked_of(TO, set_to, M) == record(x="paris")
    assert not relevant(rectype(x=City, e=dest(this.x)), TO, M)


def test_one_object_for_one_variable():
    round_trip = fun(r=rectype(x=City))(rectype(e=fly(outer.r.x, outer.r.x)))
    assert relevant(rectype(e=fly("paris", "paris")), round_trip, M)
    assert not relevant(rectype(e=fly("paris", "london")), round_trip, M)


def test_the_first_that_resolves():
    known = [BACK, ~TO_LONDON, TO_PARIS]
    assert find_answer(TO, known, M) is TO_PARIS
    assert find_answer(FROM, known, M) is None


propositions = st.sampled_from(
    [
        p
        for base in (BACK, TO_PARIS, TO_LONDON, rectype(e=depart("london")), ECONOMY)
        for p in (base, ~base, rectype(**dict(base.fields), more=City))
    ]
)
questions = st.sampled_from([TO, FROM, WHEN, RETURN])


@given(propositions, questions)
def test_what_is_about_a_question_is_an_instance_of_it_or_denies_one(p, q):
    found = asked_of(q, p, M)
    if found is not None:
        assert relevant(p, q, M)
        assert subtype(p, M.apply(q, found)).yes
    elif relevant(p, q, M):
        assert M.apply(q, asked_of(q, p.body, M)) is p.body


@given(st.sampled_from(["paris", "london", "may", "yes", "no", "else"]), questions)
def test_what_an_answer_comes_to_is_an_answer_as_well(a, q):
    if not relevant(a, q, M):
        return
    p = combine(q, a, M)
    assert combine(q, p, M) is p
    assert resolves(p, q, M) == resolves(a, q, M)


# --- questions under discussion ------------------------------------------------------

many = st.lists(st.sampled_from([TO, FROM, WHEN, RETURN, CLASS]))


@given(many)
def test_no_question_is_twice_under_discussion(asked):
    qud = ()
    for question in asked:
        qud = push(qud, question)
        assert top(qud) is question
    assert len(set(qud)) == len(qud)
    assert set(qud) == set(asked)


@given(many, many)
def test_what_was_under_discussion_keeps_its_order(before, asked):
    qud = ()
    for question in before:
        qud = push(qud, question)
    after = qud
    for question in asked:
        after = push(after, question)
    kept = [question for question in after if question not in asked]
    assert kept == [question for question in qud if question not in asked]


@given(many, st.lists(propositions))
def test_downdating_leaves_just_what_is_open(asked, facts):
    qud = tuple(dict.fromkeys(asked))
    left = downdate(qud, facts, M)
    assert left == tuple(q for q in qud if find_answer(q, facts, M) is None)
    assert downdate(left, facts, M) == left


def test_what_is_dropped_is_gone():
    assert pop((TO, FROM), TO) == (FROM,)
    assert pop((TO, FROM), WHEN) == (TO, FROM)
    assert top(()) is None


def test_only_questions_are_under_discussion():
    with pytest.raises(TTRError, match="only questions are under discussion, not"):
        push((), TO_PARIS)


def test_what_is_denied_twice_is_said() -> None:
    dest = Pred("dest_city", Basic("City"))
    M = Model().given("paris", Basic("City"))
    there = rectype(e=dest("paris"))
    assert relevant(~~there, which(dest), M)
    assert resolves(~~there, which(dest), M)
    assert not resolves(~~~there, which(dest), M)


def test_a_question_whether_not_is_answered_by_what_it_denies() -> None:
    back = rectype(e=Pred("return_trip", ())())
    for answer in (back, ~back, ~~back):
        assert resolves(answer, whether(~back), Model())


def test_a_meet_of_propositions_answers_what_one_of_them_does() -> None:
    City = Basic("City")
    dest, start = Pred("dest_city", City), Pred("from_city", City)
    M = Model().given("paris", City).given("oslo", City)
    both = rectype(e=dest("paris")) & rectype(f=start("oslo"))
    assert resolves(both, which(dest), M)
    assert asked_of(which(dest), both, M) == record(x="paris")


@pytest.mark.parametrize("junk", [None, 5, Ind, "ab", b"ab", this.x, Pred("p", Ind)])
def test_what_is_no_list_of_questions_is_refused(junk: object) -> None:
    question = whether(Rec)
    for wrong in (
        lambda: top(junk),
        lambda: pop(junk, question),
        lambda: push(junk, question),
        lambda: downdate(junk, [], Model()),
        lambda: downdate([question], junk, Model()),
        lambda: find_answer(question, junk, Model()),
    ):
        with pytest.raises(TTRError, match=r"a list of (questions|prop)"):
            wrong()
    with pytest.raises(TTRError):
        asked_of(junk, Rec, Model())


def test_which_asks_for_a_predicate() -> None:
    with pytest.raises(TTRError, match="asks for a predicate"):
        which(5)


@pytest.mark.parametrize("junk", [[1], {"a": 1}, bytearray(b"x")])
def test_what_python_cannot_hash_is_no_question_and_no_answer(junk: object) -> None:
    with pytest.raises(TTRError, match="this is no question"):
        asked_of(junk, Rec, Model())
    assert asked_of(TO, junk, M) is None


# --- ptypes and record types ---------------------------------------------------------


@pytest.mark.parametrize(
    "ask", [resolves, relevant, lambda answer, q, M: combine(q, answer, M)]
)
@pytest.mark.parametrize(
    ("answer", "question", "hint"),
    [
        (dest("paris"), which(dest), "write [e : dest(paris)]"),
        (~dest("paris"), which(dest), "write ~[e : dest(paris)]"),
        (
            dest("paris"),
            whether(rectype(e=dest("paris"))),
            "write [e : dest(paris)]",
        ),
        (rectype(e=dest("paris")), whether(dest("paris")), "write dest(paris)"),
    ],
)
def test_a_ptype_where_a_record_type_is_asked_for_is_an_error(
    answer, question, hint, ask
):
    with pytest.raises(IllFormedError) as error:
        ask(answer, question, M)
    assert "is a ptype, but" in error.value.message or "is a record type, but" in (
        error.value.message
    )
    assert "\n" not in error.value.message
    assert error.value.hint == hint


def test_a_ptype_that_is_about_nothing_asked_is_none():
    other = Pred("colour", City)
    assert not resolves(other("paris"), which(dest), M)
    assert find_answer(which(dest), [other("paris")], M) is None
    assert resolves(dest("paris"), whether(dest("paris")), M)
