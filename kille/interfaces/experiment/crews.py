"""Who plays the dialogues of a study, as the user has asked for."""

from __future__ import annotations

from argparse import Namespace

from kille.interfaces.terminal import complain
from kille.studies.running import Crew, Scheduler, crew


def scheduler_from(options: Namespace) -> Scheduler | None:
    """The scheduler of a cluster that the options name, if they do."""
    given = options.scheduler, options.tls_ca, options.tls_cert, options.tls_key
    return Scheduler(*given) if any(given) else None


def choose_crew(workers: int | None, scheduler: Scheduler | None) -> Crew:
    """Those who play; warns of a cluster without TLS. RunError if there are none."""
    found = crew(workers, scheduler)
    if scheduler and scheduler.risk:
        complain(scheduler.risk)
    return found
