"""Whatever is put in by mistake, the error is one of ours."""

import contextlib

import numpy as np
import pytest

import ttr
from ttr import Ind, Model, Rec, TTRError, record, rectype, this
from ttr.updates import first, maybe, repeat, rule, run, seq

ODD = [
    None,
    3,
    "a",
    "",
    True,
    float("nan"),
    [],
    {},
    {"x": 1},
    {"_x": 1},
    {1: 2},
    (1,),
    set(),
    np.zeros(2),
    Ind,
    Rec,
    ttr.Type,
    ttr.Pred("p", Ind),
    this,
    this.x,
    record(x=1),
    record(x=this.y),
    rectype(x=Ind),
    ttr.ListOf(Ind),
    str,
    Model(),
]

TACIT = rule(when=Rec)(lambda s: s)
HEARD = rule(when=Rec, on=Ind)(lambda s, e: s)

P, Q = ttr.Pred("p", Ind), ttr.Pred("q", Ind)

ENTRIES = {
    "rectype": lambda a, b: rectype({"x": a, "y": b}),
    "rectype of one": lambda a, b: rectype(a, b),
    "record": lambda a, b: record(a),
    "replace": lambda a, b: ttr.replace(a, b),
    "replace a label": lambda a, b: ttr.replace(a, x=b),
    "meet": ttr.meet,
    "ListOf": lambda a, b: ttr.ListOf(a),
    "Singleton": ttr.types.Singleton,
    "Basic": lambda a, b: ttr.Basic(a),
    "Universe": lambda a, b: ttr.types.Universe(a, b),
    "Pred": lambda a, b: ttr.Pred(a, b),
    "Pred named p": lambda a, b: ttr.Pred("p", a, b),
    "PType": ttr.types.PType,
    "print": lambda a, b: (str(Ind @ a), repr(Ind @ b)),
    "merge": ttr.merge,
    "amerge": ttr.amerge,
    "subtype": ttr.subtype,
    "wellformed": lambda a, b: ttr.wellformed(a),
    "under a theory": lambda a, b: ttr.subtype(P("a"), Q("a"), a),
    "merge under a theory": lambda a, b: ttr.merge(P("a"), Q("a"), a),
    "amerge under a theory": lambda a, b: ttr.amerge(P("a"), Q("a"), a),
    "consistent": lambda a, b: ttr.consistent(P("a"), theory=a),
    "common_supertype": lambda a, b: ttr.building.common_supertype(a, b),
    "a theory to put above": lambda a, b: ttr.building.common_supertype(
        P("a"), Q("a"), a
    ),
    "rectype under a theory": lambda a, b: rectype({"x": Ind}, a, c=P(this.x)),
    "relabel": lambda a, b: ttr.relabel(a, b),
    "flatten": lambda a, b: (ttr.building.flatten(a), ttr.building.unflatten(b)),
    "subtract": lambda a, b: ttr.building.subtract(a, b),
    "restrict": lambda a, b: ttr.building.restrict(a, b),
    "fix": lambda a, b: ttr.building.fix(a, b),
    "parse": lambda a, b: ttr.parse(a, using=b),
    "parse something": lambda a, b: ttr.parse("Ind", using=b),
    "load": lambda a, b: ttr.load(a),
    "check": lambda a, b: ttr.check(a),
    "at_least": lambda a, b: Model().judge("a", Ind).at_least(a),
    "fst": lambda a, b: (ttr.types.fst(a), ttr.types.rst(b), ttr.types.concat(a, b)),
    "fun": lambda a, b: ttr.fun(x=a)(b),
    "Pi": lambda a, b: ttr.Pi(x=a)(b),
    "apply": lambda a, b: Model().apply(a, b),
    "witnesses": lambda a, b: Model().witnesses(a),
    "box": lambda a, b: (ttr.box(a, width=b), ttr.latex(a), ttr.html(a)),
    "unfold": lambda a, b: ttr.box(Ind, unfold=a, theory=b),
    "no arguments": lambda a, b: ttr.ListOf(),
    "too many arguments": lambda a, b: ttr.ListOf(Ind, Ind),
    "data of a record type": lambda a, b: ttr.RecordType(a),
    "Model": lambda a, b: Model(a),
    "given": lambda a, b: Model().given(a, b),
    "given p": lambda a, b: Model().given("a", Ind, a),
    "judge": lambda a, b: Model().judge(a, b),
    "perceive": lambda a, b: Model().perceive(a, b),
    "create": lambda a, b: Model().create(a),
    "witnessed": lambda a, b: Model().witnessed(a, by=b),
    "rule": lambda a, b: rule(when=a, on=b)(lambda s: s),
    "strategies": lambda a, b: (first(a), seq(a), maybe(b)),
    "repeat": lambda a, b: repeat(TACIT, times=a),
    "run": lambda a, b: run(TACIT, a, type=b, model=Model()),
    "run with events": lambda a, b: run(
        HEARD, record(), type=Rec, model=Model(), events=[a, b]
    ),
}


@pytest.mark.parametrize("name", ENTRIES)
def test_only_errors_of_ours(name):
    for a in ODD:
        for b in ODD:
            with contextlib.suppress(TTRError):
                ENTRIES[name](a, b)
