"""Running: all that is left is played, whoever plays, and however often it stops."""

from __future__ import annotations

import gc
import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory
from typing import NamedTuple, TypeAlias

import pytest
from distributed import Client
from distributed.security import Security
from threadpoolctl import threadpool_info, threadpool_limits

import little_study
from kille.interfaces.experiment.stopping import stoppable
from kille.lab import log
from kille.lab.errors import StudyError
from kille.lab.log import Log, write_tables
from kille.lab.log.outcomes import Outcome, RunError
from kille.lab.running_studies.clusters import _Cluster, _connect
from kille.lab.running_studies.crews import alone, crew, play_runs
from kille.lab.running_studies.local import MOST, Workers
from kille.lab.running_studies.runner import Progress, forget_broken, run
from kille.lab.running_studies.schedulers import Scheduler
from kille.lab.running_studies.threads import READ_WHEN_LOADED, one_thread
from kille.lab.study import Run, Study
from listening import sockets_of
from little_study import BAD, DEADLY, GOOD, folder_of, play

pytestmark = pytest.mark.slow

HELPERS = str(Path(little_study.__file__).parent)
SETTLED = 120
"""So many seconds a busy machine may take to start a cluster, or to end programs."""


def names(folder: Path) -> list[str]:
    return [str(it.run) for it in log.outcomes(folder)]


def test_all_dialogues_are_played_and_none_twice(tmp_path: Path) -> None:
    study = little_study.study()
    told: list[Progress] = []
    summary = run(study, tmp_path, play, told=told.append)
    assert (summary.planned, summary.played, summary.broken) == (6, 6, 0)
    assert [it.over for it in told] == list(range(7))
    assert names(tmp_path) == list(map(str, study.runs()))
    assert run(study, tmp_path, play).played == 0


def test_what_breaks_stops_no_other_dialogue(tmp_path: Path) -> None:
    study = little_study.study(theories=(BAD, GOOD))
    summary = run(study, tmp_path, play)
    assert (summary.played, summary.broken) == (6, 1)
    assert [str(it.run) for it in log.broken_runs(tmp_path)] == ["bad/Ann/table/2"]
    assert run(study, tmp_path, play).played == 0
    assert forget_broken(study, tmp_path) == 1
    assert run(study, tmp_path, play).played == 1


def test_it_goes_on_where_it_was_stopped(tmp_path: Path) -> None:
    study = little_study.study()
    played: list[Run] = []

    def counting(study: Study, run: Run) -> object:
        played.append(run)
        if len(played) == 4:
            raise KeyboardInterrupt
        return play(study, run)

    with pytest.raises(KeyboardInterrupt):
        run(study, tmp_path, counting)  # type: ignore[arg-type]
    assert log.count_outcomes(tmp_path) == 3
    assert run(study, tmp_path, counting).played == 3  # type: ignore[arg-type]
    assert played == [*list(study.runs())[:4], *list(study.runs())[3:]]


def test_a_thousand_dialogues_that_are_over_are_passed_over_at_once(
    tmp_path: Path,
) -> None:
    study = little_study.study(seeds=500)
    run(study, tmp_path, play)
    start = time.thread_time()
    assert run(study, tmp_path, play).played == 0
    assert time.thread_time() - start < 5


def test_nothing_is_played_where_another_plays(tmp_path: Path) -> None:
    study = little_study.study()
    with Log.open(study, tmp_path), pytest.raises(RunError, match="another run"):
        run(study, tmp_path, play)


# --- several processes ---------------------------------------------------------------


def test_results_are_the_same_bytes_for_any_number_of_workers(tmp_path: Path) -> None:
    study = little_study.study(seeds=40, theories=(GOOD, BAD))
    for workers in (1, 2):
        folder = tmp_path / str(workers)
        assert run(study, folder, play, crew(workers)).played == 80
        write_tables(folder)
    assert folder_of(tmp_path / "1") == folder_of(tmp_path / "2")
    assert (
        log.broken_runs(tmp_path / "2")[0].reason
        == log.broken_runs(tmp_path / "1")[0].reason
    )


def test_a_dialogue_that_kills_its_workers_is_found_and_the_others_played(
    tmp_path: Path,
) -> None:
    study = little_study.study(seeds=10, theories=(GOOD, DEADLY))
    summary = run(study, tmp_path, play, crew(2))
    assert (summary.played, summary.broken) == (20, 1)
    (broken,) = log.broken_runs(tmp_path)
    assert str(broken.run) == "deadly/Ann/table/2"
    assert "every worker that played it died" in broken.reason


def test_a_cluster_plays_on_when_one_of_its_workers_is_killed(tmp_path: Path) -> None:
    study = little_study.study(seeds=300)
    with cluster(workers=2) as (address, _, workers):

        def told(it: Progress) -> None:
            if it.over == 100:
                workers[0].kill()

        assert (
            run(study, tmp_path, play, crew(None, Scheduler(address)), told).broken == 0
        )
        workers[0].wait()
    assert names(tmp_path) == list(map(str, study.runs()))
    assert [it.played for it in log.read(tmp_path)] == [
        play(study, it) for it in study.runs()
    ]


def test_a_scheduler_that_goes_away_is_one_line_and_loses_nothing(
    tmp_path: Path,
) -> None:
    study = little_study.study(seeds=5_000)
    with cluster(workers=1) as (address, scheduler, _):

        def told(it: Progress) -> None:
            if it.over == 200:
                scheduler.kill()

        with pytest.raises(RunError, match="is gone: what was over is kept"):
            run(study, tmp_path, play, crew(None, Scheduler(address)), told)
    over = log.count_outcomes(tmp_path)
    assert 200 <= over < 10_000
    assert run(study, tmp_path, play).played == 10_000 - over


def test_a_cluster_without_workers_is_one_line_and_loses_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("kille.lab.running_studies.clusters.PATIENCE", 0.5)
    study = little_study.study(seeds=300)
    with cluster(workers=1) as (address, _, (worker,)):

        def told(it: Progress) -> None:
            if it.over == 100:
                worker.kill()

        with pytest.raises(RunError, match="no worker is left at tcp"):
            run(study, tmp_path, play, crew(None, Scheduler(address)), told)
    assert 100 <= log.count_outcomes(tmp_path) < 600


def test_a_scheduler_that_is_gone_when_runs_are_to_be_sent_is_one_line() -> None:
    study = little_study.study()
    with cluster(workers=1) as (address, _, _):
        client = Client(address, timeout=SETTLED, set_as_default=False)
        there = _Cluster(client, address, study, play)
        assert there._workers() == 1
        client.close()
        with pytest.raises(RunError, match="is gone: what was over is kept"):
            list(there.play_all(list(study.runs())))


def test_an_address_where_nobody_is_is_one_line(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("kille.lab.running_studies.clusters.CONNECTING", 0.5)
    with pytest.raises(RunError, match="no scheduler can be reached at nowhere"):
        played_by(Scheduler("nowhere"))


def test_no_connection_that_failed_is_left_to_the_garbage_collector(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("kille.lab.running_studies.clusters.CONNECTING", 0.5)
    gc.disable()
    try:
        with pytest.raises(RunError):
            played_by(Scheduler("nowhere"))
        clients = [it for it in gc.get_objects() if issubclass(type(it), Client)]
        assert {it.status for it in clients} <= {"closed"}
    finally:
        gc.enable()


def test_what_dask_leaves_unheard_is_not_told(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with cluster(workers=1) as (address, _, _):
        with _connect(Scheduler(address), SETTLED) as client:
            future = client.loop.asyncio_loop.create_future()
            future.set_exception(TimeoutError())
        del future
        assert caplog.messages == []


def played_by(scheduler: Scheduler) -> list[Outcome]:
    study = little_study.study()
    by = crew(None, scheduler)
    with play_runs(study, list(study.runs()), play, by) as outcomes:
        return list(outcomes)


Program: TypeAlias = subprocess.Popen[bytes]


@contextmanager
def cluster(
    workers: int, tls: Sequence[str] = ()
) -> Iterator[tuple[str, Program, list[Program]]]:
    """A scheduler of Dask and its workers, on loopback."""
    host = "--host", "127.0.0.1", "--no-dashboard", *tls
    with TemporaryDirectory() as folder, ended() as programs:
        told = Path(folder, "scheduler.json")
        file = "--scheduler-file", str(told)
        scheduler = dask("scheduler", "--port", "0", *file, *host)
        programs.append(scheduler)
        alone = "--no-nanny", "--nthreads", "1"
        some = [dask("worker", *file, *alone, *host) for _ in range(workers)]
        programs.extend(some)
        address = settled(told, workers, tls)
        yield address, scheduler, some


@contextmanager
def ended() -> Iterator[list[Program]]:
    """Programs that are ended, however a test ends."""
    programs: list[Program] = []
    try:
        yield programs
    finally:
        for it in programs:
            it.kill()
            it.communicate(timeout=SETTLED)


def dask(*words: str) -> Program:
    return subprocess.Popen(
        [sys.executable, "-m", "dask", *words],
        env=os.environ | {"PYTHONPATH": HELPERS},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def settled(told: Path, workers: int, tls: Sequence[str]) -> str:
    """The address that a scheduler has told in a file, when all workers are there."""
    until = time.monotonic() + SETTLED
    while not told.is_file() and time.monotonic() < until:
        time.sleep(0.05)
    security = Security(
        **{
            f"tls_{name}": file
            for name, file in zip(
                ("ca_file", "client_cert", "client_key"), tls[1::2], strict=False
            )
        }
    )
    with Client(
        scheduler_file=str(told),
        timeout=SETTLED,
        set_as_default=False,
        security=security,
    ) as client:
        client.wait_for_workers(workers, timeout=SETTLED)
        return str(client.scheduler_info()["address"])


# --- TLS -----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def certificates(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """An authority, a certificate and key that it signed, and another authority."""
    if not which("openssl"):
        pytest.skip("openssl is not here, which makes certificates")
    folder = tmp_path_factory.mktemp("tls")
    names = "ca", "ca.key", "cert", "key", "request", "stranger", "stranger.key"
    found = {name: folder / f"{name}.pem" for name in names}
    new = "req", "-newkey", "rsa:2048", "-nodes"
    for name in ("ca", "stranger"):
        files = "-out", found[name], "-keyout", found[f"{name}.key"]
        openssl(*new, "-x509", "-days", "9", "-subj", f"/CN={name}", *files)
    files = "-out", found["request"], "-keyout", found["key"]
    openssl(*new, "-subj", "/CN=kille", *files)
    signing = "-CA", found["ca"], "-CAkey", found["ca.key"], "-CAcreateserial"
    files = "-in", found["request"], "-out", found["cert"]
    openssl("x509", "-req", "-days", "9", *signing, *files)
    return found


def openssl(*words: str | Path) -> None:
    subprocess.run(["openssl", *words], check=True, capture_output=True)


def test_a_cluster_with_tls_plays_for_who_has_its_certificates(
    tmp_path: Path, certificates: dict[str, Path]
) -> None:
    study = little_study.study()
    ca, cert, key = (certificates[name] for name in ("ca", "cert", "key"))
    files = "--tls-ca-file", str(ca), "--tls-cert", str(cert), "--tls-key", str(key)
    before = sockets_of([os.getpid()])
    with cluster(1, files) as (address, _, _):
        assert address.startswith("tls://")

        def told(it: Progress) -> None:
            # Who sends the runs connects to others, and nobody to it.
            assert sockets_of([os.getpid()]) == before

        known = Scheduler(address, ca, cert, key)
        assert run(study, tmp_path, play, crew(None, known), told).broken == 0
        stranger = Scheduler(address, certificates["stranger"], cert, key)
        with pytest.raises(RunError, match=r"do not go together: .*CERTIFICATE_VERIFY"):
            played_by(stranger)
        with pytest.raises(RunError, match="needs certificates: give --tls-ca"):
            played_by(Scheduler(address))
        with pytest.raises(RunError, match="no scheduler can be reached at tcp"):
            played_by(Scheduler(address.replace("tls", "tcp")))


@pytest.mark.parametrize(
    ("files", "told"),
    [
        (("ca", None, "key"), "are given together"),
        (("none", "cert", "key"), "none.pem cannot be read"),
        (("ca", "none", "key"), "key.pem cannot be read"),
        (("key", "cert", "key"), "expected certificates of an authority"),
        (("ca", "cert", "ca.key"), "a certificate and its key .*MISMATCH"),
        (("ca", "cert", "cert"), "expected a certificate and its key"),
    ],
)
def test_certificates_that_cannot_be_used_are_one_line(
    certificates: dict[str, Path], files: tuple[str | None, ...], told: str
) -> None:
    none = certificates["ca"].with_name("none.pem")
    given = [certificates.get(it, none) if it else None for it in files]
    with pytest.raises(RunError, match=told) as found:
        crew(None, Scheduler("tls://127.0.0.1:8786", *given))
    assert "\n" not in str(found.value)


def test_a_key_with_a_password_is_one_line_and_nobody_is_asked_for_it(
    tmp_path: Path, certificates: dict[str, Path]
) -> None:
    locked = tmp_path / "locked.pem"
    locking = "-aes256", "-passout", "pass:hidden"
    openssl("rsa", *locking, "-in", certificates["key"], "-out", locked)
    ca, cert = certificates["ca"], certificates["cert"]
    with pytest.raises(RunError, match="expected a certificate and its key"):
        Scheduler("tls://127.0.0.1:8786", ca, cert, locked).check()


@pytest.mark.parametrize(
    ("address", "who"),
    [
        ("tcp://10.0.0.5:8786", "anybody who reaches it"),
        ("lab:8786", "anybody who reaches it"),
        ("ws://lab:8786", "anybody who reaches it"),
        ("tcp://127.0.0.1.evil.org:8786", "anybody who reaches it"),
        ("tcp://127.0.0.1:8786", "any user of this machine"),
        ("localhost:8786", "any user of this machine"),
        ("tls://10.0.0.5:8786", ""),
        ("wss://lab:8786", ""),
        ("tcp://[bad", "anybody who reaches it"),
    ],
)
def test_who_may_misuse_an_address_is_told(address: str, who: str) -> None:
    risk = Scheduler(address).risk
    assert (who in risk) if who else not risk


# --- workers of this machine ---------------------------------------------------------

SCRIPT = """
import sys
from pathlib import Path
import little_study
from kille.lab.running_studies import crew, run

def play(study, run):
    return little_study.play(study, run)

print(run(little_study.study(), Path(sys.argv[1]), play, crew(2)).broken)
print({"dask", "distributed"} & set(sys.modules))
"""


def test_a_script_plays_what_it_defines_with_many_and_without_dask(
    tmp_path: Path,
) -> None:
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    found = subprocess.run(
        [sys.executable, script, tmp_path / "results"],
        env=os.environ | {"PYTHONPATH": HELPERS},
        capture_output=True,
        text=True,
        check=False,
        timeout=SETTLED,
    )
    assert (found.stdout, found.stderr, found.returncode) == ("0\nset()\n", "", 0)


def test_workers_end_with_who_began_them_whatever_ends_it(tmp_path: Path) -> None:
    with started(tmp_path / "results", "2", 50, seeds=300) as program:
        (forking,) = children(program.pid)
        assert len(members(forking)) > 1
        program.kill()
        program.communicate(timeout=SETTLED)
        settle(lambda: not members(forking))
    assert [it.name for it in tmp_path.iterdir()] == ["results"]


def test_a_stop_of_all_processes_leaves_nothing_behind(tmp_path: Path) -> None:
    with started(tmp_path / "results", "2", 50, seeds=2_000) as program:
        (forking,) = children(program.pid)
        for process in (program.pid, *members(forking)):
            with suppress(ProcessLookupError):  # the first may have ended the others
                os.kill(process, signal.SIGTERM)
        _, told = program.communicate(timeout=SETTLED)
        assert (program.returncode, told) == (128 + signal.SIGTERM, b"")
        settle(lambda: not members(forking))
    assert [it.name for it in tmp_path.iterdir()] == ["results"]


def test_a_worker_that_is_killed_is_replaced_and_nothing_is_lost(
    tmp_path: Path,
) -> None:
    study = little_study.study(seeds=300)

    def kill(it: Progress) -> None:
        if it.over % 100 == 50:
            os.kill(children(forking_process())[0], signal.SIGKILL)

    assert run(study, tmp_path, play, crew(2), kill).broken == 0
    assert [it.played for it in log.read(tmp_path)] == [
        play(study, it) for it in study.runs()
    ]


def test_workers_play_on_without_the_process_that_forked_them(tmp_path: Path) -> None:
    study = little_study.study(seeds=300)
    forked: list[int] = []

    def kill(it: Progress) -> None:
        if it.over == 50:
            forked.append(forking_process())
            os.kill(forked[0], signal.SIGKILL)

    assert run(study, tmp_path, play, crew(2), kill).played == 600
    settle(lambda: not members(forked[0]))


def forking_process() -> int:
    """The process that forks workers, among whatever else this one has begun."""
    (found,) = [
        process
        for process in children(os.getpid())
        if b"kille.lab.running_studies.workers"
        in Path(f"/proc/{process}/cmdline").read_bytes()
    ]
    return found


def children(process: int) -> list[int]:
    """The processes that this one has begun, and that have not ended."""
    return [it.process for it in processes() if it.parent == process]


def members(session: int) -> list[int]:
    """The processes of a session that have not ended."""
    return [it.process for it in processes() if it.session == session]


class Process(NamedTuple):
    """A process that has not ended, as `/proc` has it."""

    process: int
    parent: int
    session: int


def processes() -> Iterator[Process]:
    for it in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            words = it.read_text().rpartition(")")[2].split()
            if words[0] != "Z":
                yield Process(int(it.parent.name), int(words[1]), int(words[3]))


class Deadly:
    """What nobody can load and live."""

    def __reduce__(self) -> tuple[object, ...]:
        return os._exit, (1,)


def test_workers_that_never_get_ready_are_given_up() -> None:
    with (
        Workers(2, pickle.dumps(Deadly())) as workers,
        pytest.raises(RunError, match="no workers can be begun"),
    ):
        list(workers.play_all([*little_study.study().runs()]))


def test_workers_that_cannot_load_the_study_say_why() -> None:
    with (
        Workers(2, b"no pickle") as workers,
        pytest.raises(RunError, match="cannot load the study: UnpicklingError"),
    ):
        list(workers.play_all([*little_study.study().runs()]))


def test_dialogues_that_always_kill_their_workers_are_all_found(
    tmp_path: Path,
) -> None:
    study = little_study.study()
    summary = run(study, tmp_path, little_study.die, crew(2))
    assert (summary.played, summary.broken) == (6, 6)
    assert summary.broken > MOST


def test_what_cannot_be_sent_breaks_its_own_dialogue(tmp_path: Path) -> None:
    unsendable = little_study.give_what_cannot_be_sent
    assert run(little_study.study(), tmp_path, unsendable, crew(2)).broken == 6
    assert "cannot pickle" in log.broken_runs(tmp_path)[0].reason


def test_what_is_large_is_sent_whole(tmp_path: Path) -> None:
    study = little_study.study(source="b" * 3_000_000)
    assert run(study, tmp_path, little_study.say_much, crew(2)).broken == 0
    for it in log.read(tmp_path):
        assert it.played == little_study.say_much(study, it.run)


def test_one_thread_is_there_when_workers_are_forked() -> None:
    told = "import os; print(len(os.listdir('/proc/self/task')))"
    load = "from kille.lab.running_studies.workers import load; load(); "
    single = dict.fromkeys((*READ_WHEN_LOADED, "OPENCV_FOR_THREADS_NUM"), "1")
    found = subprocess.check_output(
        [sys.executable, "-c", load + told], env=os.environ | single, text=True
    )
    assert found == "1\n"


def test_workers_that_cannot_begin_are_one_line(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("sys.executable", "false")
    with pytest.raises(RunError, match="no workers can be begun"):
        run(little_study.study(), tmp_path, play, crew(2))


def settle(is_so: Callable[[], bool]) -> None:
    until = time.monotonic() + SETTLED
    while not is_so():
        assert time.monotonic() < until
        time.sleep(0.05)


# --- without Dask --------------------------------------------------------------------


def test_only_a_cluster_needs_dask(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("kille.lab.running_studies.crews.find_spec", lambda name: None)
    assert crew(1) is alone
    assert run(little_study.study(), tmp_path, play, crew(2)).played == 6
    with pytest.raises(StudyError, match=r"pip install 'kille\[cluster\]'"):
        crew(scheduler=Scheduler("tcp://127.0.0.1:1"))


# --- threads -------------------------------------------------------------------------


@pytest.mark.parametrize("workers", [1, 2])
def test_what_is_added_up_is_added_up_in_one_thread(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, workers: int
) -> None:
    for name in READ_WHEN_LOADED:
        monkeypatch.delenv(name, raising=False)
    with threadpool_limits(2):
        run(little_study.study(), tmp_path, little_study.count_threads, crew(workers))
    found = [it.played.facts for it in log.read(tmp_path)]
    assert found == [{"threads": 1.0, "asked for": 1.0}] * 6


def test_as_many_threads_as_before_are_there_afterwards(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    before = threadpool_info()
    with one_thread():
        pass
    assert threadpool_info() == before
    assert os.environ["OMP_NUM_THREADS"] == "3"
    assert "OPENBLAS_NUM_THREADS" not in os.environ


# --- stopping ------------------------------------------------------------------------

STOPPED = """
import signal, sys
from pathlib import Path
import little_study
from kille.interfaces.experiment.stopping import stoppable
from kille.lab.running_studies.crews import crew
from kille.lab.running_studies.schedulers import Scheduler
from kille.lab.running_studies.local import MOST, Workers
from kille.lab.running_studies.runner import run

def told(it):
    stop.check()
    print(it.over, flush=True)
    if it.over == it.planned - 1:  # whoever is to stop it has not come to it yet
        signal.pause()

with stoppable() as stop:
    try:
        run(little_study.study(int(sys.argv[3])), Path(sys.argv[1]), little_study.play,
            crew(int(sys.argv[2])), told)
    except KeyboardInterrupt:
        sys.exit(stop.code)
"""


@contextmanager
def started(folder: Path, workers: str, over: int, seeds: int) -> Iterator[Program]:
    """A program that runs a study of so many seeds, and has come so far."""
    with ended() as programs:
        program = subprocess.Popen(
            [sys.executable, "-c", STOPPED, str(folder), workers, str(seeds)],
            env=os.environ | {"PYTHONPATH": HELPERS, "TMPDIR": str(folder.parent)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
        programs.append(program)
        assert program.stdout
        for line in program.stdout:
            if int(line) >= over:
                break
        yield program


def test_a_stop_is_heard_that_python_drops(capfd: pytest.CaptureFixture[str]) -> None:
    class Dropping:
        def __del__(self) -> None:
            signal.raise_signal(signal.SIGTERM)

    with stoppable() as stop:
        stop.check()
        Dropping()
        with pytest.raises(KeyboardInterrupt):
            stop.check()
    assert stop.code == 128 + signal.SIGTERM
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("workers", ["1", "2"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_stop_is_clean_and_quick(
    tmp_path: Path, workers: str, number: signal.Signals
) -> None:
    # Ctrl-C is heard by all processes of a terminal.
    send = os.killpg if number == signal.SIGINT else os.kill
    with started(tmp_path, workers, over=50, seeds=2_000) as program:
        send(program.pid, number)
        _, told = program.communicate(timeout=60)
    assert program.returncode == 128 + number
    assert told == b""
    assert 50 <= log.count_outcomes(tmp_path) < 4_000


def test_what_was_killed_goes_on_to_the_same_bytes(tmp_path: Path) -> None:
    study = little_study.study(seeds=300)
    killed, whole = tmp_path / "killed", tmp_path / "whole"
    for over in (50, 200):
        with started(killed, "2", over, seeds=300) as program:
            program.kill()
            program.communicate(timeout=SETTLED)
        assert over <= log.count_outcomes(killed) < 600
    run(study, killed, play)
    run(study, whole, play)
    for folder in (killed, whole):
        write_tables(folder)
    assert folder_of(killed) == folder_of(whole)
