"""How long what is made to be large takes: seconds and memory of whole processes.

    python benchmarks/bounded.py [--steps N] [NAME …]

Each theory is some dozen lines whose questions grow without end: definitions that
double, joins against negations, pigeonholes, circles in a relation, uncertain atoms.
With the default budget none of them should take 10 s of processor time or 500 MB.
`ttr check` exits with 0 where all checks hold, with 1 where one fails or is left
unknown, with 2 where a line is too large.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

SECONDS, MEGABYTES = 10.0, 500.0

OR, AND = " \\/ ", " /\\ "


def doubling(text: str, times: int, leaf: str = "A") -> str:
    lines = [text.format(a=f"T{i}", b=f"T{i + 1}") for i in range(times)]
    return "\n".join(["basic A, B, C", f"T0 := {leaf}", *lines, ""])


RECORDS = "{b} := [l : {a}, r : {a}]"


def pigeons(holes: int) -> str:
    rows = [[f"P{p}_{h}" for h in range(holes)] for p in range(holes + 1)]
    somewhere = [f"({OR.join(row)})" for row in rows]
    alone = [
        f"(~{one[h]} \\/ ~{other[h]})"
        for h in range(holes)
        for i, one in enumerate(rows)
        for other in rows[:i]
    ]
    names = ", ".join(name for row in rows for name in row)
    return (
        f"basic {names}\nT := {AND.join([*somewhere, *alone])}\n"
        "check T <= ~T\ncheck create(T)\n"
    )


def joins(count: int, checks: int = 1) -> str:
    both = " /\\ ".join(f"(A{i} \\/ B{i})" for i in range(count))
    denied = " \\/ ".join(f"~(A{i} \\/ ~B{i})" for i in range(count))
    names = ", ".join(f"A{i}, B{i}" for i in range(count))
    asked = "".join(f"check J <= A{k} \\/ {denied}\n" for k in range(checks))
    return f"basic {names}\nJ := {both}\n{asked}"


def circle(opened: str) -> str:
    facts = "\n".join(
        f"given e{i}_{j} : r(a{i}, a{j})"
        for i in range(40)
        for j in range(i + 1, 40)
        if (i * 7 + j * 3) % 11 < 3
    )
    people = ", ".join(f"a{i}" for i in range(40))
    return (
        f"basic A\npred r(A, A)\n{opened}object {people} : A\n{facts}\ncheck P([x : A, "
        "y : A, z : A, w : A, c : r(x, y), d : r(y, z), "
        "e : r(z, w), f : r(w, x)]) = 0\n"
    )


def permutations(count: int) -> str:
    names = [f"x{i}" for i in range(count)]
    swapped = ", ".join([names[1], names[0], *names[2:]])
    turned = ", ".join([*names[1:], names[0]])
    written = ", ".join(names)
    return (
        f"basic A\npred t({', '.join('A' * count)})\nt({written}) <: t({swapped})\n"
        f"t({written}) <: t({turned})\nobject {', '.join(f'o{n}' for n in names)} : A\n"
        f"given e : t({', '.join(f'o{n}' for n in names)})\ncheck e : A\n"
    )


def uncertain(count: int) -> str:
    names = ", ".join(f"A{i}" for i in range(count))
    facts = [f"given P(o : A{i} | o : A{i - 1}) = 0.5" for i in range(1, count)]
    facts += [
        f"given P(o : A{i} | o : A{i - 2}) in [0.3, 0.8]" for i in range(2, count)
    ]
    asked = " /\\ ".join(f"(A{i} \\/ ~A{i + 3})" for i in range(1, count - 4))
    return "\n".join(
        [f"basic {names}", "object o : A0", *facts, f"check o : {asked}", ""]
    )


def regular() -> str:
    lines = [
        "R{} := plus(str({}))".format(n, ", ".join(["A \\/ B"] * n))
        for n in (2, 3, 5, 7, 11, 13, 17, 19)
    ]
    every = " /\\ ".join(line.split()[0] for line in lines)
    text = "\n".join(lines)
    return f"basic A, B\n{text}\ncheck {every} <= plus(A)\ncheck create({every})\n"


THEORIES = {
    "doubled records": doubling(RECORDS, 40) + "check T40 <= [l : T39]\n",
    "doubled joins": doubling(RECORDS, 40, "A \\/ B") + "check T40 <= T39\n",
    "doubled lists": doubling("{b} := [l : list({a}), r : list({a})]", 30, "A \\/ B")
    + "check T30 <= [l : list(T29)]\n",
    "doubled functions": doubling("{b} := ({a} -> {a})", 30) + "check T30 <= T29\n",
    "doubled negations": doubling("{b} := ~[l : {a}, r : {a}]", 40)
    + "check T40 <= T39\n",
    "doubled strings": doubling("{b} := str({a}, {a})", 40) + "check T40 <= T39\n",
    "doubled repetitions": doubling("{b} := plus(str({a}, {a}) \\/ {a})", 20)
    + "check T20 <= T19\n",
    "doubled applications": "basic A\npred p(A, A)\nobject a : A\n"
    "F0 := \\x:A. [c : p(x, x)]\n"
    + "".join(f"F{i + 1} := \\x:A. [l : F{i}(x), r : F{i}(x)]\n" for i in range(30))
    + "check F30(a) <= [l : F29(a)]\n",
    "doubled objects": "basic A\nobject a : A\nx0 := {l = a, r = a}\n"
    + "".join(f"x{i + 1} := {{l = x{i}, r = x{i}}}\n" for i in range(40))
    + "check x40 : Rec\ncheck x40 = x39\n",
    "a doubled witness": doubling(RECORDS, 40) + "check create(T40)\n",
    "a doubled merge": doubling(RECORDS, 30)
    + "U0 := B\n"
    + "".join(f"U{i + 1} := [l : U{i}, r : U{i}]\n" for i in range(30))
    + "M := merge(T30, U30)\n",
    "nine joins": joins(9),
    "nine times nine joins": joins(9, 9),
    "pigeonholes of 5": pigeons(5),
    "pigeonholes of 7": pigeons(7),
    "a circle of four": circle(""),
    "an open circle of four": circle("open r\n"),
    "permuting axioms": permutations(9),
    "uncertain atoms": uncertain(30),
    "regular types": regular(),
}


def measure_check(text: str, steps: str | None) -> tuple[int, float, float, str]:
    """The exit code, seconds and megabytes of `ttr check`, and the last it said."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "large.ttr")
        file.write_text(text, encoding="utf-8")
        more = ["--steps", steps] if steps else []
        command = [sys.executable, "-m", "ttr.cli.main", "check", str(file), *more]
        said = Path(folder, "said")
        with (
            said.open("w") as output,
            subprocess.Popen(command, stdout=output) as child,
        ):
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        last = [*said.read_text(encoding="utf-8").strip().splitlines(), ""]
    seconds = used.ru_utime + used.ru_stime
    return child.returncode, seconds, used.ru_maxrss / 1024, last[-2][-60:]


def report(names: list[str], steps: str | None) -> Iterator[bool]:
    for name in names:
        code, seconds, megabytes, said = measure_check(THEORIES[name], steps)
        holds = code in (0, 1, 2) and seconds <= SECONDS and megabytes <= MEGABYTES
        verdict = "holds" if holds else "FAILS"
        print(
            f"{name:24} {seconds:6.2f} s {megabytes:6.0f} MB  exit {code}  {verdict}  "
            f"{said.partition(': ')[2]}",
            flush=True,
        )
        yield holds


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--steps", metavar="N", help="another budget")
    options = parser.parse_args()
    sys.exit(not all([*report(options.names or list(THEORIES), options.steps)]))


if __name__ == "__main__":
    main()
