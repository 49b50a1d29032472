"""Subtyping up to relabelling: which relabelling, and why there is none."""

import pickle
import re

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Pi,
    Pred,
    Theory,
    budget,
    check,
    fun,
    join,
    meet,
    outer,
    record,
    rectype,
    relabel,
    subtype,
    this,
)
from ttr.building import subtype_up_to_relabelling
from ttr.building.relabelling import relabel as relabel_type
from ttr.cli.session.replies import answer
from ttr.cli.session.sessions import Session
from ttr.errors import IllFormedError, NotationError

A, B = Basic("A"), Basic("B")
dog, cat, hug = Pred("dog", Ind), Pred("cat", Ind), Pred("hug", Ind, Ind)
VIEW = rectype(x=Ind, c=dog(this.x), y=Ind, e=cat(this.y), h=hug(this.x, this.y))


def below(S, T, *theory):
    """The relabelling by which S is below T; fails if there is none."""
    found = subtype_up_to_relabelling(S, T, *theory)
    assert found.yes, found
    assert subtype(S, relabel(T, found.relabelling), *theory).yes
    return found.relabelling


def test_the_relabelling_takes_what_depends_on_a_label_along():
    assert below(VIEW, rectype(x=Ind, c=cat(this.x))) == {"x": "y", "c": "e"}
    T = rectype(a=Ind, b=Ind, e=hug(this.b, this.a))
    assert below(VIEW, T) == {"a": "y", "b": "x", "e": "h"}


def test_labels_stay_the_same_where_they_can():
    found = subtype_up_to_relabelling(VIEW, rectype(x=Ind, c=dog(this.x)))
    assert found.relabelling == {}
    assert found.why == subtype(VIEW, rectype(x=Ind, c=dog(this.x))).why
    assert below(VIEW, rectype(y=Ind, z=Ind)) == {"z": "x"}


def test_two_labels_are_never_called_the_same():
    found = subtype_up_to_relabelling(rectype(x=Ind), rectype(a=Ind, b=Ind))
    assert found.no
    assert found.why == "[x : Ind] has too few fields that can be a, b"
    assert found.relabelling is None
    assert subtype_up_to_relabelling(VIEW, rectype(a=Ind, b=Ind)).yes


def test_a_label_that_is_wanted_twice_is_given_up():
    T = rectype(x=A | B, y=A)
    assert below(rectype(x=A, z=B), T) == {"x": "z", "y": "x"}


def test_labels_inside_record_types_are_renamed_too():
    S = rectype(b=rectype(y=Ind, d=dog(this.y)), f=cat(this.b.y), g=rectype(x=Ind))
    T = rectype(bg=rectype(x=Ind, c=dog(this.x)), e=cat(this.bg.x))
    assert below(S, T) == {"bg": "b", "bg.x": "y", "bg.c": "d", "e": "f"}


def test_a_path_out_of_a_record_type_is_followed():
    S = rectype(i=Ind, m=rectype(j=Ind, h=hug(outer.i, this.j)))
    T = rectype(x=Ind, n=rectype(y=Ind, c=hug(outer.x, this.y)))
    assert below(S, T) == {"x": "i", "n": "m", "n.y": "j", "n.c": "h"}
    T = rectype(x=Ind, n=rectype(y=Ind, c=hug(this.y, outer.x)))
    assert subtype_up_to_relabelling(S, T).no


def test_what_is_said_of_a_record_as_a_whole_keeps_its_labels():
    good = Pred("good", rectype(x=Ind))
    S = rectype(a=rectype(x=Ind, y=Ind), s=good(this.a))
    assert below(S, rectype(b=rectype(x=Ind), c=good(this.b))) == {"b": "a", "c": "s"}
    T = rectype(b=rectype(x=Ind, z=Ind), c=good(this.b))
    with pytest.raises(IllFormedError, match="c is about b as a whole"):
        relabel_type(T, {"b.z": "y"})
    assert subtype_up_to_relabelling(S, T).no


def test_manifest_fields_tell_labels_apart():
    S = rectype(x=Ind @ "a", y=Ind @ "b")
    assert below(S, rectype(z=Ind @ "b")) == {"z": "y"}
    S = rectype(x=Ind @ "fido", e=dog("fido"))
    assert below(S, rectype(y=Ind, c=dog(this.y))) == {"y": "x", "c": "e"}
    S = rectype(x=Ind, y=Ind @ this.x, e=dog(this.y))
    assert below(S, rectype(a=Ind, b=Ind @ this.a, c=dog(this.a)))


def test_fields_on_a_circle_of_paths_are_followed():
    S = rectype(x=A, y=A, u=B @ this.v, v=B @ this.u)
    T = rectype(a=B @ this.b, b=B @ this.a)
    assert below(S, T) == {"a": "u", "b": "v"}


def test_axioms_are_used():
    theory = Theory.parse("""
        basic Ind
        pred  left(Ind, Ind), right(Ind, Ind)
        right(x, y) <: left(y, x)
        S := [x : Ind, y : Ind, c : right(x, y)]
        T := [a : Ind, b : Ind, e : left(a, b)]
    """)
    S, T = theory.S, theory.T
    assert below(S, T, theory) == {"a": "y", "b": "x", "e": "c"}
    assert subtype_up_to_relabelling(S, T).no


def test_a_join_has_one_relabelling_for_all_its_cases():
    S = join(rectype(x=A, y=B), rectype(x=A, z=B))
    assert below(S, rectype(a=A)) == {"a": "x"}
    assert subtype_up_to_relabelling(S, rectype(a=B)).no


def test_other_types_than_record_types_have_one_relabelling():
    assert subtype_up_to_relabelling(A & B, A).relabelling == {}
    assert subtype_up_to_relabelling(A, B).no
    assert subtype_up_to_relabelling(ListOf(A), ListOf(A | B)).yes
    found = subtype_up_to_relabelling(rectype(x=A), meet(rectype(y=A), Pi(v=A)(B) >> A))
    assert found.unknown or found.no
    assert subtype_up_to_relabelling(rectype(x=A), join(rectype(y=A), B)).unknown


def test_labels_that_are_not_tried_leave_the_answer_open():
    S = rectype(n=meet(rectype(x=A), rectype(y=B)))
    T = rectype(m=join(rectype(a=B), rectype(b=B)))
    found = subtype_up_to_relabelling(S, T)
    assert found.unknown
    assert "labels inside other types than record types" in found.why


def test_applications_are_computed_first():
    Dog = fun(v=Ind)(rectype(e=dog(outer.v)))
    some = rectype(x=Ind, r=Dog(this.x))
    S = rectype(y=Ind, s=rectype(c=dog(outer.y)))
    found = subtype_up_to_relabelling(S, some)
    assert found.relabelling == {"x": "y", "r": "s", "r.e": "c"}


def test_a_counterexample_refutes_each_relabelling_where_rules_do_not_decide():
    assert subtype_up_to_relabelling(rectype(x=A), rectype(y=~A)).no
    assert subtype_up_to_relabelling(rectype(x=A), rectype(y=~(A & B))).no


def test_the_reason_says_how_far_it_came():
    found = subtype_up_to_relabelling(rectype(x=Ind), rectype(y=Ind, c=dog(this.y)))
    assert str(found) == "no: with y as x, no field of [x : Ind] can be c : dog(y)"
    found = subtype_up_to_relabelling(rectype(x=A), rectype(y=B))
    assert found.why == "no field of [x : A] can be y : B"


def test_many_fields_do_not_take_long():
    k = 200
    individuals = {f"x{i}": Ind for i in range(k)}
    kinds = {f"c{i}": (cat if i % 10 else dog)(this[f"x{i}"]) for i in range(k)}
    S = rectype({**individuals, **kinds, "h": hug(this.x190, this.x7)})
    T = {"a": Ind, "d": dog(this.a), "b": Ind, "c": cat(this.b)}
    assert below(S, rectype(**T, h=hug(this.a, this.b)))["a"] == "x190"
    assert subtype_up_to_relabelling(S, rectype(**T, h=hug(this.b, this.a))).no


def test_axioms_do_not_make_it_take_long():
    theory = Theory.parse("""
        basic Ind, Thing
        pred  dog(Ind), cat(Ind), hug(Ind, Ind), animal(Ind), touch(Ind, Ind)
        Ind <: Thing
        dog(x) <: animal(x)
        cat(x) <: animal(x)
        hug(x, y) <: touch(y, x)
    """)
    dogs = {f"c{i}": dog(this[f"x{i}"]) for i in range(0, 200, 10)}
    S = rectype(
        {**{f"x{i}": Ind for i in range(200)}, **dogs, "h": hug(this.x190, this.x7)}
    )
    T = theory.parse("[a : Ind, b : Ind, d : animal(b), h : touch(a, b), t : Thing]")
    found = below(S, T, theory)
    assert (found["a"], found["b"]) == ("x7", "x190")


def test_pigeons_are_counted_not_tried():
    S, T = rectype({f"x{i}": A for i in range(30)}), {f"y{i}": A for i in range(31)}
    assert subtype_up_to_relabelling(S, rectype(T)).no


def test_a_search_that_is_too_long_is_left_open():
    k = 12
    edges = {f"e{i}": hug(this[f"x{i}"], this[f"x{(i + 1) % k}"]) for i in range(k)}
    S = rectype({**{f"x{i}": Ind for i in range(k)}, **edges})
    T = rectype({f"y{i}": Ind for i in range(5)}, c=hug(this.y0, this.y0))
    with budget(steps=20):
        found = subtype_up_to_relabelling(S, T)
    assert found.unknown
    assert found.relabelling is None
    assert "too large" in found.why


def test_what_is_no_type_is_refused():
    with pytest.raises(IllFormedError):
        subtype_up_to_relabelling(record(x="a"), VIEW)
    with pytest.raises(TypeError, match=r"ask for \.yes or \.no"):
        bool(subtype_up_to_relabelling(VIEW, VIEW))


def test_an_answer_survives_pickling():
    found = subtype_up_to_relabelling(VIEW, rectype(x=Ind, c=cat(this.x)))
    again = pickle.loads(pickle.dumps(found))
    assert again == found
    assert again.relabelling == found.relabelling


# --- in theories and at the prompt ----------------------------------------------------

PETS = """
    basic Ind
    pred  dog(Ind), cat(Ind)
    S := [x : Ind, c : dog(x), y : Ind, e : cat(y)]
    T := [x : Ind, c : cat(x)]
"""


def test_a_theory_checks_it():
    theory = Theory.parse(
        PETS
        + """
    check S <= T up to relabelling
    check S ⊑ [a : Ind]
        up to relabelling
    check not S <= T
    check not T <= S up to relabelling
    check S <= S up to relabelling
    check unknown S <= [a : Ind] \\/ [b : dog('fido')] up to relabelling
    """
    )
    report = check(theory)
    assert report.holds, report
    assert report.asked == 6


def test_a_check_that_fails_says_why():
    report = check(Theory.parse(PETS + "    check T <= S up to relabelling"))
    assert re.search(r"why:      .*no field of .* can be", str(report))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("check S <= T up", "expected to, found the end"),
        ("check S <= T up to relabeling", "expected relabelling, found relabeling"),
        ("check S = T up to relabelling", "expected the end, found up"),
        ("check S <= T upto", "expected up to relabelling or the end, found upto"),
    ],
)
def test_a_misspelt_question_is_refused(text, message):
    with pytest.raises(NotationError, match=message):
        Theory.parse(PETS + "    " + text)


def test_up_may_be_a_name():
    theory = Theory.parse("basic up, to\ncheck up <= up up to relabelling")
    assert check(theory).holds


def test_the_prompt_shows_the_relabelling():
    session = Session()
    for line in PETS.strip().split("\n"):
        session = answer(session, line.strip()).session
    reply = answer(session, "S <= T up to relabelling")
    assert reply.text == "yes: with x as y, c as e"
    assert reply.session.last.relabelling == {"x": "y", "c": "e"}
