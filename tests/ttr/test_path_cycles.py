"""Fields that depend on one another in a circle, at every depth."""

import pytest

from ttr import Ind, Rec, outer, rectype, this
from ttr.computing.path_cycles import describe_cycle
from ttr.types.objects import Path

CYCLES = {
    "r.x → r.y → r.x": rectype(r=rectype(x=Ind @ this.y, y=Ind @ this.x)),
    "r.x → y → r.x": rectype(r=rectype(x=Ind @ outer.y), y=Ind @ this.r.x),
    "r.s.x → r.y → r.s.x": rectype(
        r=rectype(s=rectype(x=Ind @ outer.y), y=Ind @ this.s.x)
    ),
    "r.s.x → y → r.s.x": rectype(
        r=rectype(s=rectype(x=Ind @ Path(2, ("y",)))), y=Ind @ this.r.s.x
    ),
    "r.x → r.x": rectype(r=rectype(x=Rec @ outer.r)),
}

NO_CYCLES = {
    "beside it": rectype(r=rectype(x=Ind, y=Ind @ this.x)),
    "around it": rectype(r=rectype(x=Ind @ outer.x), x=Ind),
    "two around it": rectype(r=rectype(s=rectype(x=Ind @ Path(2, ("x",)))), x=Ind),
    "within another": rectype(r=rectype(x=Ind), s=rectype(x=Ind @ outer.r.x)),
    "beside it, of a record type without fields": rectype(
        r=rectype(x=Rec, y=Rec @ this.x)
    ),
}


@pytest.mark.parametrize("cycle", CYCLES)
def test_fields_in_a_circle(cycle):
    assert describe_cycle(CYCLES[cycle]) == cycle


@pytest.mark.parametrize("name", NO_CYCLES)
def test_fields_that_depend_only_on_others(name):
    assert describe_cycle(NO_CYCLES[name]) == ""
