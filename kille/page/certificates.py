"""The certificate of this host, for a page that is reached from other machines.

Nobody but the host signs it, so a browser asks once whether to trust it: compare the
fingerprint that it shows with the one that `kille serve` prints.
"""

from __future__ import annotations

import ipaddress
import re
import socket
from collections.abc import Sequence
from contextlib import suppress
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import NamedTuple

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from kille.page.guard import is_number, own_addresses, own_names
from kille.safety.private_files import FOLDER_MODE, open_private

LASTS = timedelta(days=397)
"""As long as browsers take a certificate for at most."""

_RENEWED = timedelta(days=30)


class Certificate(NamedTuple):
    """A certificate with its key, both in one private file, and what a browser shows
    of it."""

    path: Path
    fingerprint: str


def host_certificate(host: str, folder: Path) -> Certificate:
    """The certificate of a host, made in the folder where there is none that is valid.

    Raises OSError if the file cannot be written.
    """
    names = _names_of(host)
    path = folder / f"page-{re.sub(r'[^A-Za-z0-9.-]', '_', host)}.pem"
    kept = _read_certificate(path, names)
    if kept is None:
        kept = _make(path, names)
    digest = kept.fingerprint(hashes.SHA256()).hex(":").upper()
    return Certificate(path, digest)


def _names_of(host: str) -> tuple[str, ...]:
    """The names and addresses under which the host may be asked for."""
    found = {"localhost", "127.0.0.1", "::1", host, *own_names(), *own_addresses()}
    with suppress(OSError):
        for it in socket.getaddrinfo(socket.gethostname(), None):
            found.add(str(it[4][0]).partition("%")[0])
    return tuple(sorted(found - {"0.0.0.0", "::"}))


def _read_certificate(path: Path, names: Sequence[str]) -> x509.Certificate | None:
    """The certificate in the file, if it is of all these names and valid for long."""
    try:
        data = path.read_bytes()
        serialization.load_pem_private_key(data, None)
        found = x509.load_pem_x509_certificate(data)
        of = found.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    except (OSError, ValueError, TypeError, x509.ExtensionNotFound):
        return None
    if found.not_valid_after_utc - datetime.now(UTC) < _RENEWED:
        return None
    return found if set(_general_names(names)) <= set(of) else None


def _make(path: Path, names: Sequence[str]) -> x509.Certificate:
    key = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "kille serve")])
    now = datetime.now(UTC)
    made = (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - timedelta(hours=1))
        .not_valid_after(now + LASTS)
        .add_extension(x509.SubjectAlternativeName(_general_names(names)), False)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), True)
        .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.SERVER_AUTH]), False)
        .sign(key, hashes.SHA256())
    )
    secret = key.private_bytes(
        serialization.Encoding.PEM,
        serialization.PrivateFormat.PKCS8,
        serialization.NoEncryption(),
    )
    path.parent.mkdir(parents=True, exist_ok=True, mode=FOLDER_MODE)
    path.unlink(missing_ok=True)
    with open(path, "xb", opener=open_private) as file:
        file.write(secret + made.public_bytes(serialization.Encoding.PEM))
    return made


def _general_names(names: Sequence[str]) -> list[x509.GeneralName]:
    return [
        x509.IPAddress(ipaddress.ip_address(it)) if is_number(it) else x509.DNSName(it)
        for it in names
    ]
