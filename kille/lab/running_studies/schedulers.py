"""Where the scheduler of a cluster is, and how one is known to it.

Dask runs whatever it is sent. Only TLS with certificates keeps others from sending it
something: both sides then show a certificate that the same authority has signed.
"""

from __future__ import annotations

import ssl
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path
from urllib.parse import urlsplit

from kille.lab.log.outcomes import RunError

ENCRYPTED = ("tls", "wss")
"""The protocols of Dask that ask both sides for a certificate."""


@dataclass(frozen=True)
class Scheduler:
    """The scheduler of a cluster of Dask: its address, and PEM files for TLS.

    The files are the `authority` that is trusted, our `certificate` and its `key`.
    Without them, Dask uses those that it is configured with, if it is.
    """

    address: str
    authority: Path | None = None
    certificate: Path | None = None
    key: Path | None = None

    @property
    def is_encrypted(self) -> bool:
        """Whether the connection is encrypted, and both sides show a certificate."""
        return self.address.partition("://")[0] in ENCRYPTED

    @property
    def risk(self) -> str:
        """What is risky about this address, in one line; empty with TLS.

        >>> print(Scheduler("tcp://lab:8786").risk)
        tcp://lab:8786 is without TLS: anybody who reaches it can run programs as you;
        use tls:// with --tls-ca, --tls-cert and --tls-key
        >>> Scheduler("tls://lab:8786").risk
        ''
        """
        if self.is_encrypted:
            return ""
        local = _is_loopback(self.address)
        who = "any user of this machine" if local else "anybody who reaches it"
        return (
            f"{self.address} is without TLS: {who} can run programs as you; "
            "use tls:// with --tls-ca, --tls-cert and --tls-key"
        )

    def check(self) -> None:
        """RunError if the files cannot be used, or do not go with the address."""
        files = (self.authority, self.certificate, self.key)
        if not any(files):
            return
        if not (self.authority and self.certificate and self.key):
            raise RunError("--tls-ca, --tls-cert and --tls-key are given together")
        if not self.address:
            raise RunError("--tls-ca, --tls-cert and --tls-key need a --scheduler")
        if not self.is_encrypted:
            raise RunError(
                f"{self.address} is without TLS, and takes no certificates: is it "
                f"tls://{self.address.rpartition('//')[2]}?"
            )
        _check_files(self.authority, self.certificate, self.key)


def _check_files(authority: Path, certificate: Path, key: Path) -> None:
    """RunError if these are not certificates, or the key does not fit."""
    context = ssl.create_default_context()
    read, expected = f"{authority}", "certificates of an authority"
    try:
        context.load_verify_locations(authority)
        read, expected = f"{certificate} and {key}", "a certificate and its key"
        # Without a password, OpenSSL would ask for one at the terminal.
        context.load_cert_chain(certificate, key, password=lambda: "")
    except ssl.SSLError as error:
        why = error.reason or "a key with a password cannot be used"
        raise RunError(f"{read}: expected {expected} (PEM): {why}") from error
    except (OSError, ValueError) as error:
        raise RunError(f"{read} cannot be read: {error}") from error


def _is_loopback(address: str) -> bool:
    """Whether an address can be reached from this machine only.

    >>> [_is_loopback(it) for it in ("tcp://[::1]:8786", "localhost:8786", "10.0.0.1")]
    [True, True, False]
    """
    try:
        host = urlsplit(f"//{address.rpartition('//')[2]}").hostname or ""
        return host == "localhost" or ip_address(host).is_loopback
    except ValueError:
        return False
