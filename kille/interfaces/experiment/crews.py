"""Choose who plays the dialogues of a study, as the user asked."""

from __future__ import annotations

from argparse import Namespace

from kille.interfaces.terminal import complain
from kille.lab.running_studies import Crew, Scheduler, crew


def scheduler_from(options: Namespace) -> Scheduler | None:
    """The cluster scheduler that the options name, if any."""
    given = options.scheduler, options.tls_ca, options.tls_cert, options.tls_key
    return Scheduler(*given) if any(given) else None


def choose_crew(workers: int | None, scheduler: Scheduler | None) -> Crew:
    """The crew; warns of a cluster without TLS. RunError if there is none."""
    found = crew(workers, scheduler)
    if scheduler and scheduler.risk:
        complain(scheduler.risk)
    return found
