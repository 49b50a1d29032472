"""The command `kille`. Camera and parser are imported only when needed."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import threading
from collections.abc import Sequence
from errno import ENOSPC
from pathlib import Path
from shlex import join
from typing import TYPE_CHECKING, Any, NoReturn

from kille.extras import MissingExtraError, check_extra
from kille.interfaces.number_arguments import (
    parse_count,
    parse_port,
    parse_seed,
    positive,
)
from kille.interfaces.standard_streams import (
    drop_output,
    end_line,
    prepare_streams,
    write_error,
)
from ttr.cli.command_line import Parser, Version
from ttr.cli.consent_options import add_consent, consent_of
from ttr.safety.interruptions import keep_interruptions

if TYPE_CHECKING:
    from kille.interfaces.experiment.running import StudyRequest
    from kille.interfaces.serve import Against

PACKAGED = "packaged"
"""The name of the theory that a robot has unless another is named."""

FAILED, WRONG_USE, INTERRUPTED, PIPE_CLOSED = 1, 2, 130, 141


def command() -> NoReturn:
    """Run the installed command.

    At the end a thread may still be building a part of the index. Python waits for it,
    and a Ctrl-C would then report the thread, which is of no interest.
    """
    threading.excepthook = _unforeseen_in_thread
    code = main()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.exit(code)


def _unforeseen_in_thread(told: threading.ExceptHookArgs) -> None:
    """Report a thread's error in one line; the command goes on without the thread."""
    if told.exc_value is not None and not isinstance(told.exc_value, SystemExit):
        from ttr.safety.unforeseen_errors import report_unforeseen

        report_unforeseen("kille", told.exc_value)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; 0 is success, 1 failure, 2 wrong use, 130 Ctrl-C."""
    prepare_streams()
    try:
        with keep_interruptions():
            code = _run(argv)
        sys.stdout.flush()
    except KeyboardInterrupt:
        end_line()
        return INTERRUPTED
    except BrokenPipeError:
        drop_output()
        return PIPE_CLOSED
    except MissingExtraError as error:
        write_error(f"kille: {error}")
        return WRONG_USE
    except Exception as error:
        if not isinstance(error, OSError) or error.errno != ENOSPC:
            from ttr.safety.unforeseen_errors import report_unforeseen

            return report_unforeseen("kille", error)
        drop_output()
        write_error("kille: the output cannot be written: no space left on device")
        return FAILED
    return code


def _run(argv: Sequence[str] | None) -> int:
    options = _parser().options_of(argv)
    options.words = tuple(sys.argv[1:] if argv is None else argv)
    _limit_pictures()
    code: int = options.run(options)
    return code


def _limit_pictures() -> None:
    """Make OpenCV refuse large pictures itself, which it decides when it is loaded.

    Sizes are read before that, too, but by another reader of the same headers.
    """
    from ttr.safety.limits import PICTURE

    os.environ.setdefault("OPENCV_IO_MAX_IMAGE_PIXELS", str(PICTURE.maximum))


def _parser() -> Parser:
    parser = Parser(
        prog="kille",
        description="A table-top robot that learns words for objects and places.",
    )
    parser.add_argument("--version", action=Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(metavar="COMMAND", parser_class=Parser)
    _add_demo(commands)
    _add_talk(commands)
    _add_serve(commands)
    _add_replay(commands)
    _add_record(commands)
    _add_convert(commands)
    memory = commands.add_parser("memory", help="what the robot has learned")
    actions = memory.add_subparsers(metavar="ACTION", parser_class=Parser)
    _add_memory_actions(actions)
    _add_evaluate(commands)
    _add_experiment(commands)
    _add_ros(commands)
    _add_init(commands)
    doctor = commands.add_parser("doctor", help="what works here, what is missing")
    doctor.add_argument("--json", action="store_true", help="report for machines")
    doctor.set_defaults(run=_doctor)
    return parser


def _add_demo(commands: Any) -> None:
    demo = commands.add_parser("demo", help="watch a tutor teach and test the robot")
    demo.add_argument(
        "--seed",
        type=parse_seed,
        default=7,
        metavar="N",
        help="another run of chance (7)",
    )
    demo.add_argument(
        "--out",
        type=Path,
        default=Path("kille-demo.png"),
        metavar="FILE",
        help="where the picture sheet goes (kille-demo.png)",
    )
    demo.set_defaults(run=_demo)


def _add_init(commands: Any) -> None:
    init = commands.add_parser(
        "init", help="copy what the robot says and understands, to be edited"
    )
    init.add_argument("folder", type=Path, metavar="FOLDER", help="a new folder")
    init.add_argument(
        "--lang", choices=["en", "sv"], default="en", help="English or Swedish (en)"
    )
    init.set_defaults(run=_init)


def _add_talk(commands: Any) -> None:
    talk = commands.add_parser("talk", help="teach the robot yourself")
    _add_robot(talk)
    _add_account_and_speech(talk)
    talk.set_defaults(run=_talk)


def _add_serve(commands: Any) -> None:
    serve = commands.add_parser("serve", help="teach the robot in a browser")
    _add_robot(serve)
    serve.add_argument(
        "--host",
        default="127.0.0.1",
        metavar="H",
        help="where the page listens; beyond this machine it speaks TLS and needs a "
        "token (127.0.0.1)",
    )
    serve.add_argument(
        "--port",
        type=parse_port,
        default=8765,
        metavar="N",
        help="the port; 0 for any that is free (8765)",
    )
    serve.add_argument("--open", action="store_true", help="open the page in a browser")
    serve.add_argument(
        "--against",
        metavar="T",
        help="another theory, as for --theory, or `packaged`: a second robot has it, "
        "hears and sees the same, and stands beside the first",
    )
    serve.add_argument(
        "--against-memory",
        type=Path,
        metavar="FILE",
        help="where the second robot keeps what it learns (it begins with a copy of "
        "the first one's memory, and keeps nothing)",
    )
    serve.set_defaults(run=_serve)


def _add_robot(talk: argparse.ArgumentParser) -> None:
    """The options of a robot that is talked to."""
    talk.add_argument(
        "--sensor",
        default="synthetic",
        metavar="S",
        help="what it looks through: synthetic, synthetic:SCENE?seed=7, kinect, or the "
        "path of recorded captures",
    )
    talk.add_argument(
        "--memory",
        type=Path,
        metavar="FILE",
        help="where it keeps what it learns (your data folder)",
    )
    talk.add_argument(
        "--lang", choices=["en", "sv"], default="en", help="English or Swedish (en)"
    )
    talk.add_argument(
        "--mode",
        choices=["driven", "assisted", "autonomous"],
        default="assisted",
        help="driven: never asks; assisted: asks when it helps; autonomous: also "
        "learns by itself what it is sure of (assisted)",
    )
    talk.add_argument(
        "--wording",
        choices=["paper", "four", "varied"],
        default="paper",
        help="how certain it sounds: the paper's wordings, or four bands; varied: the "
        "paper's, but not always in the same words (paper)",
    )
    _add_theory(talk)


def _add_account_and_speech(talk: argparse.ArgumentParser) -> None:
    talk.add_argument(
        "--trace",
        nargs="?",
        const="short",
        choices=("short", "whole"),
        help="show what each turn does to the state: short (in at most ten lines), or "
        "whole (every judgement, rule and change)",
    )
    talk.add_argument(
        "--speech",
        action="store_true",
        help="talk aloud: as --hear device --say espeak",
    )
    talk.add_argument(
        "--hear",
        metavar="FROM",
        help="what it hears: device (a microphone, after Enter), always (the same, all "
        "the time), FILE.wav, or - for raw samples of 16 bits, 16 kHz, on the input",
    )
    talk.add_argument(
        "--say",
        metavar="VOICE",
        help="how it speaks: espeak, flite, FILE.wav, or none (none)",
    )
    talk.add_argument(
        "--barge-in",
        action="store_true",
        help="with --hear always and headphones: who speaks over it stops it",
    )
    talk.add_argument(
        "--live",
        action="store_true",
        help="at a terminal: after a silence it remarks on what comes, goes or moves, "
        "and asks",
    )
    talk.add_argument(
        "--log",
        type=Path,
        metavar="FILE.dlg",
        help="write the dialogue, with times, as a story for kille replay",
    )


def _add_theory(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--theory",
        metavar="T",
        help="the theory that it has: FILE.ttr, a folder that `kille init` made, or "
        "STUDY.toml:NAME (the packaged one)",
    )
    add_consent(command)


def _add_replay(commands: Any) -> None:
    replay = commands.add_parser("replay", help="play dialogue files, compare answers")
    replay.add_argument("files", nargs="+", type=Path, metavar="FILE.dlg")
    telling = replay.add_mutually_exclusive_group()
    telling.add_argument("--quiet", action="store_true", help="only what differs")
    telling.add_argument("--json", action="store_true", help="report for machines")
    replay.add_argument(
        "--junit", type=Path, metavar="FILE", help="write a report for CI (.xml)"
    )
    _add_theory(replay)
    replay.set_defaults(run=_replay)


def _add_ros(commands: Any) -> None:
    ros = commands.add_parser("ros", help="the robot as nodes of ROS")
    parts = ros.add_subparsers(metavar="PART", parser_class=Parser)
    for part, told in _ROS_PARTS.items():
        node = parts.add_parser(part, help=told)
        if part in ("sensor", "all"):
            node.add_argument("--sensor", metavar="S", help="as in kille talk")
            node.add_argument("--rate", type=float, metavar="HZ", help="(30)")
        if part in ("dialogue", "all"):
            node.add_argument("--memory", metavar="FILE", help="as in kille talk")
            for name in ("lang", "mode", "wording"):
                shown = name[0].upper()
                node.add_argument(f"--{name}", metavar=shown, help="as in kille talk")
            _add_theory(node)
        if part in ("perception", "dialogue", "all"):
            waiting = "how long to wait for other nodes (10)"
            node.add_argument("--patience", type=float, metavar="SECONDS", help=waiting)
        if part != "launch":
            node.add_argument(
                "--over",
                choices=["ros", "ros2"],
                default="ros",
                help="ROS 1, or the topics of ROS 2, which is experimental (ros)",
            )
        node.add_argument(
            "remapped",
            nargs="*",
            metavar="NAME:=VALUE",
            help="other names for topics, and parameters, as ROS writes them",
        )
        node.set_defaults(run=_ros, part=part)


_ROS_PARTS = {
    "sensor": "sends what a sensor sees",
    "perception": "looks, when it is asked to",
    "dialogue": "has the state and the memory, hears and answers",
    "all": "all three in one process",
    "talk": "type to a robot that runs as nodes",
    "launch": "start all nodes by roslaunch, and again if they die",
}


def _add_record(commands: Any) -> None:
    record = commands.add_parser("record", help="keep what a sensor sees, to play it")
    record.add_argument("out", type=Path, metavar="OUT", help="a new folder")
    record.add_argument(
        "--sensor",
        default="synthetic",
        metavar="S",
        help="kinect, synthetic, the path of a recording … (synthetic)",
    )
    ending = record.add_mutually_exclusive_group()
    ending.add_argument(
        "--seconds", type=positive, metavar="N", help="how long (until Ctrl-C)"
    )
    ending.add_argument(
        "--frames", type=parse_count, metavar="N", help="how many frames (until Ctrl-C)"
    )
    record.add_argument(
        "--force", action="store_true", help="take the place of a recording"
    )
    record.set_defaults(run=_record)


def _add_convert(commands: Any) -> None:
    convert = commands.add_parser("convert", help="a recording in another format")
    convert.add_argument("source", metavar="IN", help="the path of a recording")
    convert.add_argument("out", type=Path, metavar="OUT", help="a new file or folder")
    convert.add_argument(
        "--to",
        choices=["fakenect", "tum", "captures", "bag", "mcap", "ros2", "npz"],
        help="the format (as OUT ends: .bag, .mcap or .npz)",
    )
    convert.add_argument(
        "--force", action="store_true", help="take the place of a recording"
    )
    convert.set_defaults(run=_convert)


def _add_evaluate(commands: Any) -> None:
    evaluate = commands.add_parser("evaluate", help="how well words are learned")
    kinds = evaluate.add_subparsers(metavar="WHAT", parser_class=Parser)
    objects = kinds.add_parser(
        "objects",
        help="words for things: the paper's tables for your data and method",
    )
    _add_measuring(
        objects,
        data="pictures by category, labelled scenes or captures, meshes "
        "(the ten things of the simulated table)",
        protocols="paper, rotation, specimens, shots, degrees, even-odd, halves, "
        "scenes, regions or growth",
        methods="default and kille",
    )
    for act in ("teach", "ask"):
        told = f"a labelled scene to {act} in; may be repeated"
        objects.add_argument(
            f"--{act}", action="append", default=[], metavar="SCENE", help=told
        )
    relations = kinds.add_parser(
        "relations",
        help="words for places: the same, against people's judgements",
    )
    _add_measuring(
        relations,
        data="people's judgements (the paper's protocol with simulated judges)",
        protocols="paper or judgements",
        methods="default, kille and angle",
    )
    relations.set_defaults(teach=[], ask=[])


def _add_measuring(
    parser: argparse.ArgumentParser, data: str, protocols: str, methods: str
) -> None:
    parser.add_argument("data", nargs="?", metavar="DATA", help=data)
    parser.add_argument(
        "--protocol", metavar="P", help=f"{protocols} (all usual ones for the data)"
    )
    parser.add_argument(
        "--method",
        action="append",
        default=[],
        metavar="M",
        help="who takes part, by name, or your own as FILE.py:NAME or MODULE:NAME; "
        f"may be repeated ({methods})",
    )
    parser.add_argument(
        "--seed",
        type=parse_seed,
        default=0,
        metavar="N",
        help="another run of chance (0)",
    )
    parser.add_argument("--json", action="store_true", help="report for machines")
    parser.add_argument(
        "--report",
        type=Path,
        metavar="FILE.html",
        help="write a page with tables and figures",
    )
    parser.set_defaults(run=_evaluate)


def _add_experiment(commands: Any) -> None:
    experiment = commands.add_parser(
        "experiment", help="theories of meaning compared by the dialogues they lead to"
    )
    actions = experiment.add_subparsers(metavar="ACTION", parser_class=Parser)
    checking = actions.add_parser("check", help="all that is wrong with studies")
    checking.add_argument("files", nargs="+", type=Path, metavar="FILE.toml")
    add_consent(checking)
    checking.set_defaults(run=_experiment_check)
    running = actions.add_parser("run", help="play all dialogues, or go on with them")
    running.add_argument("file", type=Path, metavar="FILE.toml")
    running.add_argument(
        "--out", type=Path, metavar="FOLDER", help="for the results (FILE.results)"
    )
    add_consent(running)
    _add_players(running)
    running.set_defaults(run=_experiment_run)
    resuming = actions.add_parser("resume", help="go on where it was stopped")
    _add_results(resuming)
    resuming.add_argument("--again", action="store_true", help="also with what broke")
    _add_study(resuming)
    _add_players(resuming)
    resuming.set_defaults(run=_experiment_resume)
    showing = actions.add_parser("show", help="a dialogue, or how many there are")
    _add_results(showing)
    showing.add_argument(
        "name", nargs="?", metavar="RUN", help="such as theory/tutor/scene/seed"
    )
    showing.add_argument("--json", action="store_true", help="report for machines")
    showing.set_defaults(run=_experiment_show)
    replaying = actions.add_parser("replay", help="do dialogues go as they went?")
    _add_results(replaying)
    replaying.add_argument("names", nargs="*", metavar="RUN", help="(all of them)")
    _add_study(replaying)
    _add_players(replaying)
    replaying.set_defaults(run=_experiment_replay)
    reporting = actions.add_parser("report", help="write the tables and the page")
    _add_results(reporting)
    add_consent(reporting, log="the log")
    reporting.set_defaults(run=_experiment_report)
    comparing = actions.add_parser("compare", help="how two folders of results differ")
    comparing.add_argument("one", type=Path, metavar="A")
    comparing.add_argument("other", type=Path, metavar="B")
    comparing.add_argument(
        "--report", type=Path, metavar="FILE.html", help="write a page"
    )
    add_consent(comparing, log="a log")
    comparing.set_defaults(run=_experiment_compare)


def _add_results(action: argparse.ArgumentParser) -> None:
    action.add_argument("folder", type=Path, metavar="FOLDER", help="of results")


def _add_study(action: argparse.ArgumentParser) -> None:
    action.add_argument(
        "--study",
        type=Path,
        metavar="FILE.toml",
        help="the study, in the place of the one that the log has",
    )
    add_consent(action, log="the log")


def _add_players(action: argparse.ArgumentParser) -> None:
    action.add_argument(
        "--workers", type=parse_count, metavar="N", help="processes (one for each core)"
    )
    action.add_argument(
        "--scheduler",
        default="",
        metavar="ADDRESS",
        help="a cluster of Dask that is there already, such as tls://lab:8786",
    )
    for name, what in (
        ("ca", "the authority that signed the certificates of the cluster"),
        ("cert", "the certificate that the cluster knows you by"),
        ("key", "the key of this certificate"),
    ):
        action.add_argument(f"--tls-{name}", type=Path, metavar="FILE", help=what)


def _add_memory_actions(actions: Any) -> None:
    listing = actions.add_parser(
        "list", help="the words, and how often each was taught"
    )
    listing.set_defaults(run=_memory_list)
    showing = actions.add_parser(
        "show", help="who taught a word when, and what it looked like"
    )
    _add_named(showing, "+")
    showing.add_argument(
        "--out", type=Path, metavar="FOLDER", help="where the pictures are written"
    )
    showing.set_defaults(run=_memory_show)
    forgetting = actions.add_parser("forget", help="unlearn a word or a lesson")
    _add_named(forgetting, "*")
    forgetting.add_argument(
        "--last", action="store_true", help="the lesson that was learned last"
    )
    forgetting.add_argument("--yes", action="store_true", help="do not ask")
    forgetting.set_defaults(run=_memory_forget)
    exporting = actions.add_parser("export", help="write it for other programs")
    exporting.add_argument("target", type=Path, metavar="FILE.zip|FOLDER")
    exporting.set_defaults(run=_memory_export)
    importing = actions.add_parser("import", help="add what was exported")
    importing.add_argument("source", type=Path, metavar="FILE.zip|FOLDER")
    importing.set_defaults(run=_memory_import)
    checking = actions.add_parser(
        "check", help="say what is wrong with it, and save what can be read"
    )
    checking.add_argument("file", nargs="?", type=Path, metavar="FILE")
    checking.add_argument(
        "--salvage",
        type=Path,
        metavar="NEW",
        help="make a new memory, in this file, of what can be read",
    )
    checking.set_defaults(run=_memory_check)
    for action in (listing, showing, forgetting, exporting, importing, checking):
        action.add_argument("--memory", type=Path, metavar="FILE", help="which memory")
        action.add_argument("--json", action="store_true", help="report for machines")


def _add_named(action: argparse.ArgumentParser, count: str) -> None:
    action.add_argument(
        "named", nargs=count, metavar="WORD|LESSON", help="a word or a lesson's number"
    )


def _demo(options: argparse.Namespace) -> int:
    from kille.interfaces.demo import demo

    return demo(options.seed, options.out)


def _talk(options: argparse.Namespace) -> int:
    from kille.interfaces.formatting import ACCOUNTS
    from kille.interfaces.talk import talk

    account = ACCOUNTS[options.trace or "none"]
    settings = _robot_settings(options, options.theory)
    if settings is None:
        return WRONG_USE
    return talk(
        options.sensor,
        options.memory,
        account,
        hear=options.hear or ("device" if options.speech else ""),
        say=options.say or ("espeak" if options.speech else "none"),
        log=options.log,
        live=options.live,
        barge_in=options.barge_in,
        **settings,
    )


def _serve(options: argparse.Namespace) -> int:
    from kille.interfaces.serve import serve

    settings = _robot_settings(options, options.theory)
    if settings is None:
        return WRONG_USE
    against = None
    if options.against or options.against_memory:
        against = _against(options, settings["language"])
        if against is None:
            return WRONG_USE
    return serve(
        options.sensor,
        options.memory,
        host=options.host,
        port=options.port,
        show=options.open,
        against=against,
        **settings,
    )


def _against(options: argparse.Namespace, language: str) -> Against | None:
    """The robot that stands beside the first; None if there can be none, which is
    complained of."""
    from kille.agent.agent import Agent
    from kille.dialogue.language_files import plain
    from kille.interfaces.serve import Against
    from kille.interfaces.terminal import complain

    if not options.against:
        complain("--against-memory is of a second robot: name its theory by --against")
        return None
    same = options.against == (options.theory or PACKAGED)
    if same and options.against_memory is None:
        complain(
            f"both robots would have the theory {options.against}: name another by "
            "--theory or --against, or give the second a memory by --against-memory"
        )
        return None
    settings = _robot_settings(options, options.against)
    if settings is None:
        return None
    if plain(settings["language"]) != plain(language):
        complain(
            f"{options.against} speaks {plain(settings['language'])}, and the first "
            f"robot {plain(language)}: they are to hear the same sentences"
        )
        return None
    make = settings.pop("make", Agent)
    memory = options.against_memory
    ours, theirs = _short_theory(options.theory), _short_theory(options.against)
    if ours == theirs:
        ours, theirs = (options.theory or ours), options.against
    if ours == theirs:
        theirs = f"{theirs}, {memory.name}"
    return Against(make, settings, (ours, theirs), memory)


def _short_theory(named: str | None) -> str:
    """What a theory is called beside another: its file, or its name in a study."""
    return Path((named or PACKAGED).rpartition(":")[2]).name


def _robot_settings(
    options: argparse.Namespace, named: str | None
) -> dict[str, Any] | None:
    """The language and strategy of a robot, and what makes it of the theory that is
    so named.

    None if the theory cannot be used, which is complained of.
    """
    settings = {"mode": options.mode, "wording": options.wording}
    if not named or named == PACKAGED:
        return {"language": options.lang, **settings}
    from functools import partial

    from kille.interfaces.experiment.checking import MISTAKES
    from kille.interfaces.terminal import complain_all
    from kille.interfaces.theories import robot_of, theory_named
    from kille.lab.theories import language_of

    try:
        theory = theory_named(
            named, options.lang, **settings, consent=consent_of(options)
        )
    except MISTAKES as error:
        complain_all(error)
        return None
    return {
        "language": language_of(theory),
        **settings,
        "make": partial(robot_of, theory),
    }


def _init(options: argparse.Namespace) -> int:
    from kille.interfaces.init import init

    return init(options.folder, options.lang)


def _replay(options: argparse.Namespace) -> int:
    from kille.interfaces.replay import as_json, in_brief, in_full, replay

    report = in_brief if options.quiet else in_full
    if options.json:
        report = as_json
    if not options.theory:
        return replay(options.files, report, options.junit)
    from functools import partial

    from kille.interfaces.theories import maker_of

    robots = partial(maker_of, options.theory, consent_of(options))
    return replay(options.files, report, options.junit, robots)


def _record(options: argparse.Namespace) -> int:
    from kille.interfaces.record import record_sensor
    from kille.sensors.recordings.output_paths import check_new, check_replaceable
    from kille.sensors.recordings.recorder import Limits

    may_write = check_replaceable if options.force else check_new
    limits = Limits(options.frames, options.seconds)
    return record_sensor(options.sensor, options.out, limits, may_write)


def _convert(options: argparse.Namespace) -> int:
    from kille.interfaces.convert import convert_recording
    from kille.sensors.recordings.output_paths import check_new, check_replaceable

    may_write = check_replaceable if options.force else check_new
    return convert_recording(options.source, options.out, options.to, may_write)


def _memory_list(options: argparse.Namespace) -> int:
    from kille.interfaces.memory.listing import as_json, as_table, list_words

    return list_words(options.memory, as_json if options.json else as_table)


def _memory_show(options: argparse.Namespace) -> int:
    from kille.interfaces.memory.showing import as_json, as_text, show

    report = as_json if options.json else as_text
    return show(options.memory, " ".join(options.named), options.out, report)


def _memory_forget(options: argparse.Namespace) -> int:
    from kille.interfaces.memory import forgetting

    if bool(options.named) == options.last:
        options.parser.error("name a WORD, a LESSON or --last, one of them")
    named = " ".join(options.named)
    chosen = forgetting.last if options.last else forgetting.of(named)
    may = forgetting.sure if options.yes else forgetting.ask_consent
    report = forgetting.as_json if options.json else forgetting.as_text
    return forgetting.forget(options.memory, chosen, may, report)


def _memory_export(options: argparse.Namespace) -> int:
    from kille.interfaces.memory.moving import as_json, as_text, export_memory

    report = as_json if options.json else as_text
    return export_memory(options.memory, options.target, report)


def _memory_import(options: argparse.Namespace) -> int:
    from kille.interfaces.memory.moving import as_json, as_text, import_memory

    report = as_json if options.json else as_text
    return import_memory(options.memory, options.source, report)


def _memory_check(options: argparse.Namespace) -> int:
    from kille.interfaces.memory.checking import as_json, as_text, check_memory

    if options.file is not None and options.memory is not None:
        options.parser.error("name FILE or --memory FILE, one of them")
    report = as_json if options.json else as_text
    return check_memory(options.file or options.memory, options.salvage, report)


def _evaluate(options: argparse.Namespace) -> int:
    check_extra("experiments", "kille evaluate")
    from kille.interfaces.evaluate import (
        EvaluationRequest,
        as_json,
        as_tables,
        evaluate,
    )

    request = EvaluationRequest(
        what=options.parser.prog.split()[-1],
        data=options.data,
        protocol=options.protocol,
        methods=tuple(dict.fromkeys(options.method)),
        seed=options.seed,
        report=options.report,
        teach=tuple(options.teach),
        ask=tuple(options.ask),
        words=options.words,
    )
    return evaluate(request, as_json if options.json else as_tables)


def _experiment_check(options: argparse.Namespace) -> int:
    from kille.interfaces.experiment.checking import check_files

    return check_files(options.files, consent_of(options))


def _experiment_run(options: argparse.Namespace) -> int:
    check_extra("experiments", "kille experiment run")
    from kille.interfaces.experiment.running import run_study

    return run_study(options.file, options.out, _request(options))


def _experiment_resume(options: argparse.Namespace) -> int:
    check_extra("experiments", "kille experiment resume")
    from kille.interfaces.experiment.running import keep_as_is, resume_study
    from kille.lab.running_studies.runner import forget_broken

    first = forget_broken if options.again else keep_as_is
    return resume_study(options.folder, _request(options), first)


def _request(options: argparse.Namespace) -> StudyRequest:
    """By whom a study is to be played, and what it may run."""
    from kille.interfaces.experiment.crews import scheduler_from
    from kille.interfaces.experiment.running import StudyRequest

    return StudyRequest(
        options.workers,
        scheduler_from(options),
        _command(options),
        consent_of(options),
        trusts=getattr(options, "trust", False),
        study=getattr(options, "study", None),
    )


def _experiment_show(options: argparse.Namespace) -> int:
    from kille.interfaces.experiment.showing import as_json, as_text, show

    return show(options.folder, options.name, as_json if options.json else as_text)


def _experiment_replay(options: argparse.Namespace) -> int:
    check_extra("experiments", "kille experiment replay")
    from kille.interfaces.experiment.replaying import replay_all

    return replay_all(options.folder, options.names, _request(options))


def _experiment_report(options: argparse.Namespace) -> int:
    check_extra("experiments", "kille experiment report")
    from kille.interfaces.experiment.logs import consent_to
    from kille.interfaces.experiment.reporting import report

    consent = consent_to(consent_of(options), options.trust)
    return report(options.folder, _command(options), consent)


def _experiment_compare(options: argparse.Namespace) -> int:
    check_extra("experiments", "kille experiment compare")
    from kille.interfaces.experiment.logs import consent_to
    from kille.interfaces.experiment.reporting import compare

    consent, command = consent_to(consent_of(options), options.trust), _command(options)
    return compare(options.one, options.other, options.report, command, consent)


def _command(options: argparse.Namespace) -> str:
    return join(["kille", *options.words])


def _ros(options: argparse.Namespace) -> int:
    from kille.interfaces.ros import OPENING, launch, run_nodes
    from kille.interfaces.ros_talk import talk_as_node

    if options.part == "launch":
        return launch(options.remapped)
    opened = OPENING[options.over]
    if options.part == "talk":
        return talk_as_node(opened, options.remapped)
    return run_nodes(
        opened, options.part, vars(options), options.remapped, consent_of(options)
    )


def _doctor(options: argparse.Namespace) -> int:
    from kille.interfaces.doctor import as_json, as_text, doctor

    return doctor(as_json if options.json else as_text)


if __name__ == "__main__":
    command()
