"""Functions with a narrower domain, and fixed-point types."""

import pytest

from ttr import Basic, Ind, Model, Pred, fun, outer, record, rectype, this
from ttr.building.function_domains import fix, restrict
from ttr.errors import IllFormedError

A = Basic("A")
man, run, hug = Pred("man", Ind), Pred("run", Ind), Pred("hug", Ind, Ind)


def test_a_domain_is_merged_with_a_type():
    f = fun(r=rectype(x=Ind))(run(this.r.x))
    man_domain = rectype(x=Ind, c=man(this.x))
    assert restrict(f, man_domain) is fun(r=man_domain)(run(this.r.x))
    assert restrict(f, rectype(y=A)) is fun(r=rectype(x=Ind, y=A))(run(this.r.x))


def test_what_says_nothing_new_restricts_nothing():
    f = fun(r=rectype(x=Ind, y=A))(run(this.r.x))
    assert restrict(f, rectype(x=Ind)) is f


def test_only_functions_are_restricted():
    with pytest.raises(IllFormedError, match="restrict takes a function, found"):
        restrict(Ind, Ind)
    with pytest.raises(IllFormedError, match="expected a type"):
        restrict(fun(x=Ind)(run(this.x)), "x")


def test_the_record_stands_for_the_variable():
    f = fun(r=rectype(x=Ind))(rectype(c=run(outer.r.x)))
    assert fix(f) is rectype(x=Ind, c=run(this.x))


def test_paths_from_further_in_and_in_the_domain_follow():
    S = rectype(x=Ind, c=man(this.x))
    f = fun(r=S)(
        rectype(y=Ind, n=rectype(e=hug(outer(2).r.x, outer.y)), c=run(outer.r.x))
    )
    assert fix(f) is rectype(
        x=Ind,
        c=man(this.x) & run(this.x),
        y=Ind,
        n=rectype(e=hug(outer.x, outer.y)),
    )


def test_a_function_around_it_keeps_its_variable():
    inner = fun(r=rectype(x=Ind))(rectype(e=hug(outer.r.x, outer(2).v)))
    f = fun(v=Ind)(inner)
    assert fun(v=Ind)(fix(f.body)) is fun(v=Ind)(rectype(x=Ind, e=hug(this.x, outer.v)))


def test_a_record_is_of_it_iff_of_the_domain_and_of_what_the_function_gives():
    f = fun(r=rectype(x=Ind))(rectype(c=run(outer.r.x)))
    M = Model().given("a", Ind).given("s", run("a"))
    for r in (record(x="a", c="s"), record(x="a", c="t"), record(c="s")):
        of_domain = M.judge(r, f.domain).holds
        of_both = of_domain and M.judge(r, M.apply(f, r)).holds
        assert M.judge(r, fix(f)).holds == of_both


def test_what_has_no_fixed_point_type_is_said():
    for f in (fun(x=Ind)(run(this.x)), fun(r=rectype(x=Ind))(run(this.r.x)), Ind):
        with pytest.raises(
            IllFormedError, match="fix takes a function from a record type"
        ):
            fix(f)
    whole = fun(r=rectype(x=Ind))(rectype(s=rectype(x=Ind) @ outer.r))
    with pytest.raises(IllFormedError, match="something is said of r as a whole"):
        fix(whole)
