"""Drawing types, objects and judgements as text, LaTeX and HTML."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest

import ttr
from ttr import Basic, Ind, Model, Pred, Type, outer, record, rectype, this
from ttr.errors import IllFormedError, UnsupportedError
from ttr.escapes import columns
from ttr.types import Application

KENNEL = ttr.Theory.parse(
    r"""
    basic  Ind, Loc_1
    pred   dog(Ind), hug(Ind, Ind), cup(Ind, Loc_1), z()
    pred   believe(Ind, RecType), p(RecType), q(Type)
    object fido, a, b : Ind
    Dog    := [x : Ind, c : dog(x)]
    Kennel := [first : Dog, second : Dog, e : hug(first.x, second.x)]
    Big    := [k : Kennel, n : list(Dog)]
    """
)

NOTATIONS = r"""
Ind
dog(fido)
z()
[x : Ind, c : dog(x)]
[x = "x" : Ind, c : dog(x)]
[x : Ind, y : [x : Ind, e : hug(x, ^.x)]]
[x = fido : Ind, loc_of_x : Loc_1]
[x = {a = 1, b = [2, "two words"], s = [], r = {}} : Rec]
[x : (Ind /\ Loc_1) \/ ~dog(fido)]
Rec
Ind@fido
~(Ind@fido)
(Ind \/ Loc_1)@a
~~Ind
~(Ind \/ Loc_1)
(Ind -> Type)
((Ind -> Type) -> (Ind -> RecType))
(~Ind -> (Ind \/ Loc_1))
((r : Dog) -> [e : dog(r.x)])
((x : Ind) -> ((y : Ind) -> hug(x, y)))
\x:Ind. \y:Ind. hug(x, y)
\r:Dog. [e : dog(r.x), x : Ind, d : hug(x, r.x)]
\x:(Ind \/ Loc_1). Ind
(\x:Ind. dog(x))(a)
\f:(Ind -> (Ind -> Type)). f(a)(b)
list(Ind)
nelist(Dog)
set(list(Ind))
str(Ind, plus(Dog))
Type^1
[l : list(Ind), m = [a] + l : list(Ind), h = fst(l) : Ind, t = rst(l) : list(Ind)]
[f : (Ind -> RecType), x : Ind, y : .f(x)]
[s = <a b> : plus(Ind), t = set{} : set(Ind), u = {a, b} : set(Ind)]
[n = 1 : Ind, f = -2.5 : Ind, g = "R&D_1 50% #$ {~^`} 'q' <b> é 犬" : Ind]
believe(fido, [y : Ind, c : dog(y)])
p([x : Ind, c : dog(x)] /\ [y : Ind])
[e : hug(a, b) \/ (dog(a) /\ hug(b, a)) \/ cup(a, "somewhere_far_away_from_anywhere")]
[dog : (Ind -> Type), x : Ind, c : .dog(x), d : dog(x)]
[dog : (Ind -> Type), r : [x : Ind, c : ^.dog(x), d : dog(x)]]
\f:(Ind -> Type). [x : Ind, c : f(x)]
"fido"(a)(b)
[l : list((Ind -> Type)), c : (fst(l))(b)]
<a, (\x:Ind. dog(x))(b)>
<a, (\x:Ind. \y:Ind. dog(x))(a)(b)>
<a, (Ind@b)>
[Ind : Loc_1, Rec : Ind, c : q(Ind /\ Ind), d = [Rec /\ Rec, Loc_1] : list(RecType)]
[Ind : Loc_1, s = <(Ind /\ Ind), a> : plus(Type), t = {Ind /\ Ind} : set(Type)]
"""
SAMPLES = {text: KENNEL.parse(text) for text in NOTATIONS.strip().splitlines()}

SAM = record(x="sam", c="s1")
MODEL = Model(KENNEL).given("fido", Ind).given("s1", KENNEL.dog("fido"))
FIVE = KENNEL.parse("[x : Ind, y : Ind, c : dog(x), d : dog(y), e : hug(x, y)]")
OF_FIVE = record(x="fido", y="fido", c="s1", d="s1", e="s2")

TYPED = {"∧": "/\\", "∨": "\\/", "¬": "~", "→": "->", "λ": "\\", "⟨": "<", "⟩": ">"}
"""The signs that are drawn, as they are typed."""

every_sample = pytest.mark.parametrize("T", SAMPLES.values(), ids=SAMPLES.keys())


# --- text ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "drawn"),
    [
        ("dog(fido)", "dog(fido)"),
        ("[x : Ind]", "[x : Ind]"),
        (
            "Kennel",
            """
⎡first  : ⎡x : Ind   ⎤          ⎤
⎢         ⎣c : dog(x)⎦          ⎥
⎢second : ⎡x : Ind   ⎤          ⎥
⎢         ⎣c : dog(x)⎦          ⎥
⎣e      : hug(first.x, second.x)⎦
""",
        ),
        (
            "[x = fido : Ind, there : Loc_1, c : hug(x, a)]",
            """
⎡there    : Loc_1    ⎤
⎢x = fido : Ind      ⎥
⎣c        : hug(x, a)⎦
""",
        ),
        (
            "{x = fido, bg = {size = 3, of = [a, {b}, <a b>, <>]}}",
            """
⎡bg = ⎡of   = [a, {b}, ⟨a b⟩, ⟨⟩]⎤⎤
⎢     ⎣size = 3                  ⎦⎥
⎣x  = fido                        ⎦
""",
        ),
        (
            r"~[x : Ind, y : Ind] /\ Ind \/ (Ind -> Type)",
            """
(Ind → Type) ∨ ⎛Ind ∧ ¬⎡x : Ind⎤⎞
               ⎝       ⎣y : Ind⎦⎠
""",
        ),
        (
            "((r : Dog) -> [e : dog(r.x)])",
            """
⎛⎛r : ⎡x : Ind   ⎤⎞ → [e : dog(r.x)]⎞
⎝⎝    ⎣c : dog(x)⎦⎠                 ⎠
""",
        ),
        (
            r"\r:Dog. believe(r.x, [y : Ind, c : hug(y, r.x)])",
            """
λr:⎡x : Ind   ⎤. believe⎛r.x, ⎡y : Ind        ⎤⎞
   ⎣c : dog(x)⎦         ⎝     ⎣c : hug(y, r.x)⎦⎠
""",
        ),
    ],
)
def test_a_box_is_the_matrix_of_the_papers(text: str, drawn: str) -> None:
    assert ttr.box(KENNEL.parse(text)) == drawn.strip("\n")


def test_what_is_applied_is_drawn_as_it_is_printed() -> None:
    P = Pred("P", Ind)
    T = rectype(P=Ind >> Type, x=Ind, c=this.P(this.x), d=P(this.x))
    assert [ttr.box(part) for part in (T["c"], T["d"])] == [".P(.x)", "P(.x)"]
    assert ".P(x)" in ttr.box(T)
    assert r"\mathrm{c} & : & {.}\mathrm{P}(\mathrm{x})" in ttr.latex(T)
    assert ttr.box(Application("f", "a")) == '"f"(a)'


def test_what_is_too_wide_stands_on_several_lines() -> None:
    function = KENNEL.parse("((r : Dog) -> [e : hug(r.x, r.x)])")
    assert (
        ttr.box(function, width=25)
        == """\
⎛  ⎛r : ⎡x : Ind   ⎤⎞ ⎞
⎜  ⎝    ⎣c : dog(x)⎦⎠ ⎟
⎝→ [e : hug(r.x, r.x)]⎠"""
    )
    assert (
        ttr.box(KENNEL.parse(r"hug(fido, a) \/ hug(a, b) \/ hug(b, fido)"), width=30)
        == "  hug(a, b)\n∨ hug(b, fido)\n∨ hug(fido, a)"
    )
    assert (
        ttr.box([f"name{number}" for number in range(6)], width=30)
        == "⎡name0, name1, name2, name3,⎤\n⎣name4, name5               ⎦"
    )


@every_sample
@pytest.mark.parametrize("width", [10, 40, 80])
def test_brackets_are_closed_in_one_column(T: object, width: int) -> None:
    lines = ttr.box(record(a=T, b=T), width=width).splitlines()
    assert len({columns(line) for line in lines}) == 1
    assert lines[0].startswith("⎡")
    assert lines[-1].endswith("⎦")


@every_sample
def test_a_box_keeps_to_the_width_where_words_let_it(T: object) -> None:
    widest = max(columns(line) for line in ttr.box(T, width=70).splitlines())
    assert widest <= 70


def test_letters_that_take_two_columns_or_none() -> None:
    drawn = ttr.box(record(a="犬", b="e\u0301", c="no"))
    assert [columns(line) for line in drawn.splitlines()] == [8, 8, 8]


@pytest.mark.parametrize("odd", ["a\u202eb", "a\u2028b", "a\nb", "a\x00b"])
def test_odd_letters_break_no_line_and_turn_no_text(odd: str) -> None:
    for drawn in (ttr.box(odd), ttr.latex(odd), ttr.html(odd)):
        assert odd not in drawn
    assert len(ttr.box(record(x=odd)).splitlines()) == 1


# --- LaTeX ---------------------------------------------------------------------------

SHARED = set(
    re.findall(
        r"\w+",
        """left right begin end mathrm mathit mathord text textit kern phantom vphantom
        underline wedge vee neg to lambda langle rangle surd times sim backslash
        bullet""",
    )
)
"""What plain LaTeX with amsmath, MathJax 2 and 3 and KaTeX all know."""


@every_sample
def test_latex_uses_only_what_all_its_readers_know(T: object) -> None:
    drawn = ttr.latex(record(a=T, b=[T] * 12))
    assert set(re.findall(r"\\([a-zA-Z]+)", drawn)) <= SHARED
    assert set(re.findall(r"\\([^a-zA-Z])", drawn)) <= set("\\_%&#${}")
    assert set(re.findall(r"\\(?:begin|end)\{(\w+)\}", drawn)) == {"array"}


@every_sample
def test_latex_is_balanced(T: object) -> None:
    check_balance(ttr.latex(record(a=T, b=[T] * 12)))


def check_balance(drawn: str) -> None:
    """Every brace, \\left and \\begin is closed, and every row of an array is full."""
    plain = re.sub(r"\\text(?:it)?\{[^{}\\]*\}|\\[_%&#${}]", "", drawn)
    assert not set("%#$~`\"'") & set(plain)
    open_now: list[str] = []
    for sign in re.findall(r"\\left|\\right|\\begin|\\end|[{}]", plain):
        if sign in ("\\left", "\\begin", "{"):
            open_now.append(sign)
        else:
            assert {"\\left": "\\right", "\\begin": "\\end", "{": "}"}[
                open_now.pop()
            ] == sign
    assert not open_now
    for innermost in re.findall(
        r"\\begin\{array\}\{lcl\}((?:(?!\\begin|\\end).)*)\\end", plain, flags=re.DOTALL
    ):
        assert {row.count("&") for row in innermost.split("\\\\")} == {2}


@pytest.mark.parametrize(
    ("text", "drawn"),
    [
        (
            "Dog",
            r"\left[\begin{array}{lcl}"
            "\n"
            r"\mathrm{x} & : & \mathit{Ind} \\[2pt]"
            "\n"
            r"\mathrm{c} & : & \mathrm{dog}(\mathrm{x})"
            "\n"
            r"\end{array}\right]",
        ),
        ("Ind@fido", r"{\mathit{Ind}}_{\mathrm{fido}}"),
        ("Type^1", r"\mathit{Type}^{1}"),
        (
            r"\x:Ind. ~dog(x)",
            r"\lambda \mathrm{x}{:}\mathit{Ind}{.}\text{ }"
            r"\neg \mathrm{dog}(\mathrm{x})",
        ),
        (
            r"Ind /\ (Ind -> Loc_1)",
            r"(\mathit{Ind} \to \mathit{Loc}\_\mathit{1}) \wedge \mathit{Ind}",
        ),
        ("<a b>", r"\langle \mathrm{a}\text{ }\mathrm{b}\rangle "),
        (
            "'R&D 5%'",
            r"\text{" + '"' + r"}\mathrm{R}\& \mathrm{D}\text{ }5\%\text{" + '"}',
        ),
    ],
)
def test_latex_of(text: str, drawn: str) -> None:
    assert ttr.latex(KENNEL.parse(text)) == drawn


def test_long_meets_and_lists_are_broken_in_latex() -> None:
    names = [f"a_rather_long_name_{number}" for number in range(12)]
    assert ttr.latex(names).count("\\\\[2pt]") == 2
    long = ttr.join(*[KENNEL.dog(name) for name in names])
    assert ttr.latex(long).count("\\\\[2pt]") == 11
    for drawn in (ttr.latex(names), ttr.latex(long)):
        check_balance(drawn)


def test_letters_are_arguments_where_mathjax_2_would_count_too_far() -> None:
    names = {f"name_{number}": Ind for number in range(200)}
    drawn = ttr.latex(rectype(names))
    assert len(drawn) > 5_000
    assert drawn.count("\\mathrm") == drawn.count("\\mathord{\\mathrm{") > 0
    assert drawn.count("\\mathit") == drawn.count("\\mathord{\\mathit{") == 200
    check_balance(drawn)
    assert "\\mathord" not in ttr.latex(KENNEL.Big)


# --- HTML ----------------------------------------------------------------------------


def parsed(page: str) -> ElementTree.Element:
    """The fragment without its style; it is well-formed XML."""
    root = ElementTree.fromstring(page)
    style = root.find("style")
    assert style is not None
    style.text = ""
    return root


@every_sample
def test_what_is_copied_from_html_reads_back(T: object) -> None:
    copied = "".join(parsed(ttr.html(T)).itertext())
    names = ttr.Theory.of(T)
    assert names.parse(copied) is T


@every_sample
def test_html_has_the_words_and_signs_of_what_is_printed(T: object) -> None:
    copied = "".join(parsed(ttr.html(T)).itertext())
    assert closed_up(copied) == closed_up(str(T))


def closed_up(text: str) -> str:
    """The text without spaces, with the signs of the keyboard."""
    for drawn, typed in TYPED.items():
        text = text.replace(drawn, typed)
    return "".join(text.split())


@every_sample
def test_html_fetches_nothing_and_runs_nothing(T: object) -> None:
    drawn = ttr.html(T)
    for word in ("<script", "http", "url(", "@import", "src=", "onclick"):
        assert word not in drawn
    classes = re.findall(r'class="([^"]*)"', drawn)
    assert all(name.startswith("ttr") for it in classes for name in it.split())


def test_html_is_nested_tables() -> None:
    tables = list(parsed(ttr.html(KENNEL.Kennel)).iter("table"))
    assert [len(table.findall("./tbody/tr")) for table in tables] == [3, 2, 2]
    first = tables[1]
    assert ["".join(cell.itertext()) for cell in first.iter("td")] == [
        *("[x", ":", "Ind,"),
        *("c", ":", "dog(x)]"),
    ]


def test_html_is_escaped() -> None:
    drawn = ttr.html("<b onclick='x'>&amp;\"")
    assert "<b" not in drawn
    text = "".join(parsed(drawn).itertext())
    assert text == str(record(x="<b onclick='x'>&amp;\""))[5:-1]


# --- judgements ----------------------------------------------------------------------


def test_a_judgement_is_situation_type_and_probability() -> None:
    j = MODEL.judge(SAM, KENNEL.Dog)
    assert ttr.box(j) == "⎡c = s1 ⎤ : ⎡x : Ind   ⎤   p = 0\n⎣x = sam⎦   ⎣c : dog(x)⎦"
    assert ttr.latex(j).endswith(r"\kern1em \mathrm{p} = 0")
    assert "".join(parsed(ttr.html(j)).itertext()).endswith("p = 0")


def test_a_derivation_as_text_has_its_lines() -> None:
    why = MODEL.judge("s1", KENNEL.dog("fido")).why
    assert ttr.box(why) == str(why)
    why = MODEL.judge(SAM, KENNEL.Dog).why
    lines = ttr.box(why, unfold=0, theory=KENNEL).splitlines()
    assert lines[0].startswith("✗ ⎡c = s1 ⎤ : Dog   (")
    assert lines[2].startswith("  ✗ x: sam : Ind   (")


def test_a_derivation_in_latex_marks_each_step_and_underlines_the_failure() -> None:
    drawn = ttr.latex(MODEL.judge(OF_FIVE, FIVE).why)
    check_balance(drawn)
    assert set(re.findall(r"\\([a-zA-Z]+)", drawn)) <= SHARED
    marks = re.findall(r"^(?:\\begin\{array\}\{ll\}\n)?\\(surd|times) &", drawn, re.M)
    assert marks == ["times", "surd", "surd", "surd", "surd", "times"]
    assert drawn.count("\\underline") == 1
    assert r"\underline{\mathrm{e}{:}\text{ }\mathrm{s2} : \mathrm{hug}" in drawn


def test_a_derivation_that_holds_is_closed_and_has_no_failure() -> None:
    why = MODEL.judge(record(x="fido", c="s1"), KENNEL.Dog).why
    assert "\\underline" not in ttr.latex(why)
    steps = parsed(ttr.html(why))
    assert [step.get("open") for step in steps.iter("details")] == [None]
    assert "ttr-fails" not in ElementTree.tostring(steps, "unicode")


def test_a_derivation_in_html_is_open_where_it_fails() -> None:
    pair = KENNEL.parse("[a : Dog, b : Dog]")
    dog = record(x="fido", c="s1")
    why = MODEL.judge(record(a=dog, b=SAM), pair).why
    steps = parsed(ttr.html(why, unfold=0, theory=KENNEL))
    opened = {
        "".join(step.find("summary").itertext()).split(":")[0]: step.get("open")  # type: ignore[union-attr]
        for step in steps.iter("details")
    }
    assert opened == {
        "✗ {a={c=s1,x=fido},b={c=s1,x=sam}} ": "",
        "✓ a": None,
        "✗ b": "",
    }
    failing = [it for it in steps.iter() if "ttr-fails" in it.get("class", "")]
    assert len(failing) == 3
    assert "".join(failing[-1].itertext()).startswith("✗ x: sam : Ind")


def test_a_degree_is_its_own_mark() -> None:
    model = MODEL.given("s3", KENNEL.dog("sam"), 0.75).given("sam", Ind)
    why = model.judge(record(x="sam", c="s3"), KENNEL.Dog).why
    assert "p = 0.75 c: s3 : dog(sam)" in ttr.box(why)
    assert r"\mathrm{p}\text{ }{=}\text{ }0{.}75 & \kern1em " in ttr.latex(why)
    assert ">p = 0.75</span>" in ttr.html(why)


# --- names for what is defined -------------------------------------------------------


def test_unfold_is_how_many_definitions_are_opened() -> None:
    drawn = [ttr.box(KENNEL.Big, unfold=n, theory=KENNEL) for n in range(4)]
    assert drawn[0] == "Big"
    assert drawn[1] == "⎡k : Kennel   ⎤\n⎣n : list(Dog)⎦"
    assert "first  : Dog" in drawn[2]
    assert drawn[3] == ttr.box(KENNEL.Big) == ttr.box(KENNEL.Big, theory=KENNEL)


def test_what_is_no_definition_itself_is_opened() -> None:
    T = KENNEL.parse("[a : Dog, l : list(Kennel)]")
    assert (
        ttr.box(T, unfold=0, theory=KENNEL) == "⎡a : Dog         ⎤\n⎣l : list(Kennel)⎦"
    )
    assert r"\mathit{Kennel}" in ttr.latex(T, unfold=0, theory=KENNEL)
    assert ">Kennel<" in ttr.html(T, unfold=0, theory=KENNEL)


def test_words_keep_their_own_names() -> None:
    theory = ttr.Theory.parse("basic Ind\nThing := Ind\nNothing := Rec\nAlso := Type")
    T = theory.parse("[a : Ind, b : Rec, c : Type, d = [] : list(Ind)]")
    drawn = ttr.box(T, unfold=0, theory=theory)
    assert drawn == ttr.box(T)


def test_the_first_of_several_names_is_shown() -> None:
    theory = ttr.Theory.parse("basic Ind\nZ := [x : Ind]\nA := [x : Ind]")
    assert ttr.box(theory.A, unfold=0, theory=theory) == "Z"


def test_what_leads_out_is_no_definition() -> None:
    inner = ttr.RecordType((("c", KENNEL.dog(outer.x)),))
    theory = ttr.Theory(definitions={"Stray": inner})
    T = rectype(x=Ind, y=inner)
    assert ttr.box(T, unfold=0, theory=theory) == ttr.box(T)


def test_records_and_functions_have_names_too() -> None:
    theory = ttr.Theory.parse(
        "basic Ind\npred run(Ind)\nF := \\x:Ind. run(x)\nR := {x = 1, y = 2}\n"
        "T := [f = F : (Ind -> Type), r = R : Rec, e : F('a')]"
    )
    drawn = ttr.box(theory.T, unfold=1, theory=theory)
    for part in ("f = F : (Ind → Type)", "r = R : Rec"):
        assert part in drawn


@pytest.mark.parametrize("form", [ttr.box, ttr.latex, ttr.html])
def test_wrong_unfolding(form) -> None:
    with pytest.raises(IllFormedError, match=r"unfold takes .*, 0 or more, found -1"):
        form(Ind, unfold=-1, theory=KENNEL)
    with pytest.raises(IllFormedError, match=r"unfold takes .* found True"):
        form(Ind, unfold=True, theory=KENNEL)
    with pytest.raises(IllFormedError, match="unfold needs the theory") as caught:
        form(Ind, unfold=0)
    assert caught.value.hint
    with pytest.raises(IllFormedError, match="unfold needs the theory"):
        form(Ind, unfold=0, theory="kennel.ttr")


def test_wrong_width() -> None:
    with pytest.raises(IllFormedError, match="a width is a number of columns"):
        ttr.box(Ind, width=0)


# --- size, and notebooks -------------------------------------------------------------


def test_wide_and_long_values_are_drawn() -> None:
    wide = rectype({f"x{number}": Ind for number in range(5000)})
    assert len(ttr.box(wide).splitlines()) == 5000
    assert ttr.latex(wide).count("\\\\[2pt]") == 4999
    assert ttr.html(wide).count("<tr>") == 5000
    assert ttr.box([1] * 10_000).count("1") == 10_000


@pytest.mark.parametrize("form", [ttr.box, ttr.latex, ttr.html])
def test_what_nests_too_deep_is_refused(form) -> None:
    T = Ind
    for _ in range(3000):
        T = ttr.ListOf(T)
    with pytest.raises(UnsupportedError, match="deeper than can be followed"):
        form(T)


@pytest.mark.parametrize("form", [ttr.box, ttr.latex, ttr.html])
def test_what_nests_deep_is_drawn(form) -> None:
    T = Ind
    for _ in range(60):
        T = rectype(x=Ind, deep=T)
    assert form(T).count("deep") == 60


def test_other_objects_are_drawn_by_their_kind() -> None:
    assert ttr.box(record(image=b"abc")) == "[image = <bytes 3>]"
    assert "&lt;bytes 3&gt;" in ttr.html(b"abc")
    assert ttr.box(Pred("dog", Ind)) == "dog"
    assert ttr.box(this.x.y) == ".x.y"
    assert ttr.box(["a", {"x": 1}]) == "[a, [x = 1]]"


def test_values_draw_themselves_in_a_notebook() -> None:
    j = MODEL.judge(SAM, KENNEL.Dog)
    for value in (KENNEL.Dog, SAM, ttr.types.FiniteSet("a"), j, j.why):
        assert value._repr_html_() == ttr.html(value)
        assert value._repr_latex_() == f"$\\displaystyle {ttr.latex(value)}$"


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        (Model(), "Model"),
        (KENNEL, "Theory"),
        (ttr.subtype(Ind, Type), "Answer"),
    ],
)
def test_what_is_only_about_objects_has_no_box(value, kind):
    with pytest.raises(IllFormedError, match=f"derivations are drawn, found {kind}$"):
        ttr.box(value)


@pytest.mark.parametrize("form", [ttr.box, ttr.latex, ttr.html])
@pytest.mark.parametrize(
    ("value", "kind"),
    [
        (rectype, "function"),
        (None, "NoneType"),
    ],
)
def test_what_is_only_pythons_is_not_drawn(form, value, kind):
    with pytest.raises(IllFormedError, match=f"derivations are drawn, found {kind}$"):
        form(value)


def test_any_other_value_of_python_is_drawn_as_an_object():
    assert ttr.box(3.5) == "3.5"


def test_the_arithmetic_of_a_reason_is_plain_latex():
    A, B = Basic("A"), Basic("B")
    M = Model().given("a", A, 0.6).given("a", B, 0.3)
    either, both = (ttr.latex(M.judge("a", T).why) for T in (A | B, A & B))
    assert r"\text{(each part; 0.6 }\times \text{ 0.3)}" in both
    assert "−" not in either
    assert "×" not in either + both
