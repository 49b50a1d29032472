"""States that were of their type: only what changed is judged again."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import Basic, Ind, ListOf, Model, Pred, record, rectype, this
from ttr.errors import NoStateError
from ttr.updates.states import check_state, is_still_of

Number = Basic("Number")
State = rectype(name=Ind, log=ListOf(Ind), inner=rectype(done=ListOf(Ind), n=Number))
FACTS = Model().given("a", Ind).given("b", Ind)
WATCHING = FACTS.witnessed(Number, by=lambda n: isinstance(n, int))
GIVEN = FACTS.given(0, Number).given(1, Number)

good_words = st.sampled_from(["a", "b"])
words = st.sampled_from(["a", "b", "nobody"])


def ends_of(log, word):
    """A list, and what it becomes when one thing is put to, or taken from, an end."""
    return [log, (word, *log), (*log, word), log[1:], log[:-1], (word, *log[1:]), word]


@st.composite
def changes(draw):
    """A state of the type, and another that may be none."""
    log, done = (tuple(draw(st.lists(good_words, max_size=4))) for _ in range(2))
    name, n = draw(good_words), draw(st.sampled_from([0, 1]))
    before = record(name=name, log=log, inner=record(done=done, n=n))
    inner = record(
        done=draw(st.sampled_from(ends_of(done, draw(words)))),
        n=draw(st.sampled_from([0, 1, "a"])),
    )
    after = {
        "name": draw(words),
        "log": draw(st.sampled_from(ends_of(log, draw(words)))),
        "inner": draw(st.sampled_from([before.inner, inner, "a"])),
    }
    after.pop(draw(st.sampled_from(["none", "none", "none", *after])), None)
    return before, record(after)


@pytest.mark.parametrize("model", [WATCHING, GIVEN])
@given(changes())
def test_a_changed_state_is_of_its_type_where_a_judgement_says_so(model, change):
    before, after = change
    expected = model.judge(after, State).holds
    assert is_still_of(before, after, State, model) == expected


@pytest.mark.parametrize(("word", "is_word"), [("b", True), ("nobody", False)])
def test_what_is_set_in_the_middle_of_a_list_is_judged(word, is_word):
    inner = record(done=[], n=0)
    before = record(name="a", log=["a", "a", "b"], inner=inner)
    after = record(name="a", log=["a", word, "b"], inner=inner)
    assert is_still_of(before, after, State, GIVEN) == is_word


def test_what_a_witness_function_looks_into_is_judged_again():
    """A list that was changed in place is the same object, but no longer as it was."""
    model = FACTS.witnessed(Number, by=lambda n: n.count(0) == 1)
    number = bytearray([0])
    state = record(name="a", log=[], inner=record(done=[], n=number))
    check_state(state, State, model, "at first")
    number.append(0)
    assert not is_still_of(state, state, State, model)


def test_fields_that_depend_on_one_another_are_judged_whole():
    calm = Pred("calm", Ind)
    T = rectype(x=Ind, c=calm(this.x))
    model = FACTS.given("s", calm("a"))
    before, after = (record(x=x, c="s") for x in "ab")
    check_state(before, T, model, "at first")
    assert not is_still_of(before, after, T, model)


def test_a_state_that_is_no_record_is_refused():
    with pytest.raises(NoStateError, match="at first the state is no record, but a"):
        check_state("a", State, GIVEN, "at first")
