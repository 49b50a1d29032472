"""Checks that fail say why in words that users know: no names of ours are in them."""

import re

import pytest
from hypothesis import given

from ttr import Ind, Theory, TTRError, check, consistent, subtype
from ttr.testing.strategies import types

THEORY = r"""
basic Ind
pred man(Ind), dog(Ind), cat(Ind), run(Ind), red(Ind), chase(Ind, Ind)
object j, k : Ind
P := (Ind -> Type)
A := \Q:P. \R:P. [x : Ind, r : Q(x), s : R(x)]
Dog := \v:Ind. dog(v)
GQ := (P -> Type)
Men := ((x : Ind) -> man(x))
Man := \v:Ind. [e : man(v)]
"""

CHECKS = r"""
A : (P -> (P -> Ind))
(\Q:P. \v:Ind. Q(v)) : (P -> (Ind -> RecType))
(\Q:P. \v:Ind. Q(v)) : (P -> (Ind -> man(j)))
(\f:(Ind -> (Ind -> Ind)). \v:Ind. f(v)(v)) : ((Ind -> (Ind -> Ind)) -> (Ind -> man(j)))
(\f:GQ. \Q:P. f(Q)) : (GQ -> (P -> RecType))
(\f:GQ. \Q:P. f(\x:Ind. Q(x))) : (GQ -> (P -> RecType))
(\f:GQ. f(\x:Ind. f(\y:Ind. chase(x,y)))) : (GQ -> RecType)
(\f:(Men -> Type). f(\x:Ind. j)) : ((Men -> Type) -> RecType)
[l : list([x:Ind, c : man(x)])] <= [l:list([x:Ind, c:run(x)])]
[l : list([x:Ind, c : man(x)])] <= [l:list([x=j:Ind])]
list([x:Ind, y : Ind]) <= list([x:Ind, y = x : Ind])
list(Ind) <= list(Ind@j)
[l : set([x:Ind])] <= [l:set([x = j : Ind])]
[s : str([x:Ind], Ind)] <= [s : str([x=j:Ind], Ind)]
[s : str(Ind, Ind)] <= [s : str(Ind@j, Ind)]
[s : plus(Ind)] <= [s : plus(Ind@j)]
Ind <= Ind@j
[f : Men] <= [f:((x:Ind) -> run(x))]
((x:Ind) -> [c:man(x)]) <= ((x:Ind) -> [c : run(x)])
[f : (Ind -> Ind), x : Ind, c : man(f(x))] <= [f:(Ind->Ind), x : Ind, c : run(f(x))]
[f : (Ind -> Type), x : Ind, c : f(x)] <= [f:(Ind->Type), x : Ind, c : f(f(x))]
[x : Ind, r : (\y:Ind. [e : man(y)])(x)] = Rec
[x : Rec, r : (\y:[z:Ind]. [e : man(y.z)])(x)] = Rec
[x : Rec, r : (\y:[z:Ind]. [e : man(y.z)])(x)] <= [x : Rec, r : [e : Ind]]
[q:Ind, a : [x : Rec, r : (\y:[z:Ind]. [e : chase(y.z, ^q)])(x)]] <= [a : [r : Ind]]
[x:Ind, a : (Ind -> [c : man(x)])] <= [x:Ind, a : (Ind -> [c : run(x)])]
[x:Ind, a : ((y:Ind) -> [c : chase(x,y)])] <= [x:Ind, a : ((y:Ind) -> [c : chase(y,x)])]
[x:Ind, y:Ind, c:man(x)] <= [x:Ind, y=x:Ind, c:man(y)]
[r : [x:Ind, y:Ind]] <= [r : [x:Ind, y=x:Ind]]
[l : list(Ind), x = fst(l) : Ind] <= [l:list(Ind), x = j : Ind]
[l : nelist(Ind)] <= [l:nelist(Ind), x = fst(l) : Ind]
[l : nelist(Ind), x = fst(l) : Ind] <= [l:nelist(Ind), x = j : Ind]
(man(j) /\ ~run(j)) <= dog(j)
[x:~Ind] <= [x:Ind]
~[x:Ind] <= ~[y:Ind]
Type <= RecType
[t : Type, x : t] <= [t:Type, x : Ind]
[t : Type, x : t] <= [t:RecType, x : t]
(\t:Type. [x : t]) : (Type -> (Type -> Type))
(\r:[t:Type]. [x : r.t]) : ([t:Type] -> Type@Ind)
(\r:[x:Ind]. r.x) : ([x:Ind] -> man(j))
(\r:[x:Ind, c:man(x)]. r.c) : ((r : [x:Ind, c:man(x)]) -> run(r.x))
create([x:man(j), y:run(x)])
create((Ind -> man(j)) /\ (Ind -> ~man(j)))
create(Men)
create([f : Men])
j : Man(j)
(\v:Ind. [e:man(v)]) = (\v:Ind. [e:run(v)])
(\v:Ind. \w:Ind. chase(v,w)) = (\v:Ind. \w:Ind. chase(w,v))
[f : ((x:Ind)->man(x)), g : ((x:Ind) -> run(x))@f] <= Ind
merge([x:Ind], [y:Ind]) = Rec
(\v:Ind. merge([c:man(v)],[c:run(v)])) : (Ind -> Ind)
(\f:Men. \v:Ind. f(v)) : (Men -> ((x:Ind) -> run(x)))
(\f:Men. \v:Ind. v) : (Men -> ((x:Ind) -> Ind@j))
A(Dog)(\y:Ind. A(\v:Ind. cat(v))(\z:Ind. chase(y, z))) : man(j)
A(Dog) : (P -> RecType@Rec)
(\Q:P. A(Q)(Q)) : (P -> (P -> Type))
(\f:Men. [l = [f(j)] : list(man(j))]) : (Men -> [l : list(run(j))])
[l : list((Ind -> Ind))] <= [l : list((Ind -> man(j)))]
[x1 : Ind, f : ((x:Ind) -> chase(x, x1))] <= [x1 : Ind, f : ((x:Ind) -> chase(x1, x))]
P(j : Man(j)) = 0.5
P([x : Ind, f : ((y:Ind) -> chase(x, y))]) = 0.5
"""

OURS = re.compile(r"·|•|\.\*|\*\.|(?<![\w)])\^\d|(?<!\d)\.\d")
"""What stands for places, variables, elements, scopes and events inside."""


def why_not(claim):
    """What a check says that is wrong, without the lines that it quotes."""
    try:
        report = str(check(Theory.parse(f"{THEORY}check {claim}")))
    except TTRError as error:
        report = f"{error.message} {error.hint}"
    lines = [line for line in report.splitlines() if "│" not in line]
    return "\n".join(line for line in lines if not line.startswith("failed: "))


@pytest.mark.parametrize("claim", CHECKS.strip().split("\n"))
@pytest.mark.parametrize("expected", ["", "not ", "unknown ", "error "])
def test_why_a_check_fails_has_no_name_of_ours(claim, expected):
    assert not OURS.search(why_not(expected + claim))


def test_there_are_checks_that_fail_in_every_way():
    found = [why_not(claim) for claim in CHECKS.strip().split("\n")]
    for verdict in ("no", "unknown", "error"):
        assert any(re.search(rf"found: +{verdict}", text) for text in found)


@given(types(), types())
def test_why_one_type_is_not_below_another_has_no_name_of_ours(S, T):
    assert not OURS.search(subtype(S, T).why)
    assert not OURS.search(consistent(S, T).why)


@pytest.mark.parametrize(
    ("claim", "why"),
    [
        (
            "[l : list([x : Ind, c : man(x)])] <= [l : list([x : Ind, c : run(x)])]",
            "in the field l.c, man(x) is not below run(x)",
        ),
        ("list(Ind) <= list(Ind@j)", "element need not be j"),
        (
            r"(\f:((x : Ind) -> man(x)). \v:Ind. v) : "
            "(((x : Ind) -> man(x)) -> (Ind -> Ind@j))",
            "it may be, but x2 need not be j",
        ),
    ],
)
def test_places_have_names_that_can_be_read(claim, why):
    assert why in why_not(claim)


def test_what_is_assumed_for_the_sake_of_argument_is_not_said_to_be_given():
    theory = Theory.parse(
        THEORY
        + r"""
        given s1 : dog(k)
        check (\y:Ind. \b:man(y). s1) : ((y : Ind) -> (man(y) -> dog(y)))
        """
    )
    (failure,) = check(theory).failures
    assert "j : Ind   (given)" in failure.why
    assert ": man(j)   (assumed)" in failure.why
    refuted = subtype(theory.parse("[x : Ind]"), theory.parse("[x : Ind, c : dog(x)]"))
    assert refuted.counter is not None
    assert "a1 : Ind   (assumed)" in str(refuted.counter.model.judge("a1", Ind).why)


def test_a_function_is_judged_at_the_object_that_its_domain_names():
    theory = Theory.parse(
        THEORY
        + r"""
        given s1 : dog(j)
        check (\y:Ind. s1) : ((y : Ind@j) -> dog(y))
        check (\y:Ind. \r:[c : man(y)]. {e = s1})
            : ((y : Ind@j) -> ([c : man(y)] -> [e : dog(y)]))
        check not (\y:Ind. s1) : ((y : Ind) -> dog(y))
        """
    )
    assert check(theory).failures == ()
