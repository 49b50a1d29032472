"""The extension for Visual Studio Code, as the file that it installs (`.vsix`)."""

from __future__ import annotations

import io
import zipfile
from importlib.resources import files

from ttr.editing.textmate import GRAMMARS
from ttr.escapes import html_text
from ttr.safety.inputs import parse_json

_OWN = ("package.json", "language-configuration.json", "extension.js")

_BEGINNING = (1980, 1, 1, 0, 0, 0)
"""The time of all files in the package, so that it is the same each time."""

_CONTENT_TYPES = """<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension=".json" ContentType="application/json"/>
<Default Extension=".js" ContentType="application/javascript"/>
<Default Extension=".vsixmanifest" ContentType="text/xml"/>
</Types>
"""

_MANIFEST = """<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0"
 xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011"
 xmlns:d="http://schemas.microsoft.com/developer/vsx-schema-design/2011">
<Metadata>
<Identity Language="en-US" Id="{name}" Version="{version}" Publisher="{publisher}"/>
<DisplayName>{displayName}</DisplayName>
<Description xml:space="preserve">{description}</Description>
<Tags>ttr,dlg</Tags>
<Categories>Programming Languages</Categories>
<GalleryFlags>Public</GalleryFlags>
<Properties>
<Property Id="Microsoft.VisualStudio.Code.Engine" Value="{engine}"/>
<Property Id="Microsoft.VisualStudio.Code.ExtensionKind" Value="workspace"/>
<Property Id="Microsoft.VisualStudio.Code.ExecutesCode" Value="true"/>
</Properties>
</Metadata>
<Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>
<Dependencies/>
<Assets>
<Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json"
 Addressable="true"/>
</Assets>
</PackageManifest>
"""


def vscode_package() -> bytes:
    """The extension as one file; it is the same each time.

    >>> archive = zipfile.ZipFile(io.BytesIO(vscode_package()))
    >>> [it for it in archive.namelist() if it.startswith("extension/p")]
    ['extension/package.json']
    """
    here = files("ttr.editing")
    inside = {f"extension/{it}": (here / "vscode" / it).read_bytes() for it in _OWN}
    inside |= {f"extension/{it}": (here / it).read_bytes() for it in GRAMMARS}
    about = parse_json(inside["extension/package.json"])
    texts = {it: html_text(v) for it, v in about.items() if isinstance(v, str)}
    manifest = _MANIFEST.format(engine=html_text(about["engines"]["vscode"]), **texts)
    inside["extension.vsixmanifest"] = manifest.encode()
    inside["[Content_Types].xml"] = _CONTENT_TYPES.encode()
    written = io.BytesIO()
    with zipfile.ZipFile(written, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in inside.items():
            member = zipfile.ZipInfo(name, _BEGINNING)
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, data)
    return written.getvalue()
