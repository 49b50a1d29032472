"""Our driver and libfreenect's programs on a real Linux USB stack: a virtual machine.

    python tests/emulation/real_kernel.py [--kernel FOLDER] [--speed N]

It needs qemu-system-x86, busybox-static, usbip, udev, kmod, cpio, libfreenect-bin and a
kernel of Debian unpacked into FOLDER (`dpkg -x linux-image-*.deb FOLDER`; without the
option, the one that is installed). The machine is emulated without hardware support, so
that it runs anywhere. It boots that kernel, sees this computer's files read-only under
a layer of its own, plugs the emulated Kinect in by USB/IP, runs `real_kernel_guest.sh`
and ends; its figures are printed. Nothing outside the machine is changed. On a slow
computer the Kinect's own clock can be slowed down by `--speed`.
"""

from __future__ import annotations

import argparse
import gzip
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
PROGRAMS = ("qemu-system-x86_64", "busybox", "usbip", "modprobe", "depmod", "cpio")
BOOT_MODULES = ("virtio_pci", "9pnet_virtio", "9p", "overlay")
MINUTES = 5

INIT = """#!/bin/busybox sh
B=/bin/busybox
$B mkdir -p /proc /sys /dev /host /layer /whole
$B mount -t proc proc /proc
$B mount -t sysfs sys /sys
$B mount -t devtmpfs dev /dev
for module in {modules}; do $B insmod /modules/$module; done
$B mount -t 9p -o {options} hostroot /host
$B mount -t tmpfs layer /layer; $B mkdir /layer/up /layer/work
$B mount -t overlay -o {layers} root /whole
for folder in proc sys dev; do $B mount --move /$folder /whole/$folder; done
$B chroot /whole /bin/sh {script} {python} {emulation} {kernel} {speed}
$B poweroff -f
"""


def modules(kernel: Path, release: str) -> list[Path]:
    """The files of the modules that are needed to reach this computer's files."""
    found: list[Path] = []
    for module in BOOT_MODULES:
        command = ["modprobe", "-d", str(kernel), "-S", release, "--show-depends"]
        told = subprocess.run(
            [*command, module], check=True, capture_output=True, text=True
        )
        for line in told.stdout.splitlines():
            kind, _, path = line.partition(" ")
            if kind == "insmod" and Path(path.strip()) not in found:
                found.append(Path(path.strip()))
    return found


def initramfs(kernel: Path, release: str, folder: Path, speed: float) -> Path:
    """What the kernel starts with: busybox, those modules, and INIT."""
    root = folder / "initramfs"
    for name in ("bin", "modules"):
        (root / name).mkdir(parents=True)
    shutil.copy("/bin/busybox", root / "bin" / "busybox")
    files = modules(kernel, release)
    for file in files:
        shutil.copy(file, root / "modules" / file.name)
    text = INIT.format(
        options="trans=virtio,version=9p2000.L,msize=262144,cache=loose,ro",
        modules=" ".join(file.name for file in files),
        layers="lowerdir=/host,upperdir=/layer/up,workdir=/layer/work",
        script=HERE / "real_kernel_guest.sh",
        python=sys.executable,
        emulation=HERE,
        kernel=kernel,
        speed=speed,
    )
    (root / "init").write_text(text)
    (root / "init").chmod(0o755)
    names = "\n".join(str(path.relative_to(root)) for path in root.rglob("*"))
    archive = subprocess.run(
        ["cpio", "-o", "-H", "newc", "--quiet"],
        cwd=root,
        input=names.encode(),
        check=True,
        capture_output=True,
    )
    target = folder / "initramfs.gz"
    target.write_bytes(gzip.compress(archive.stdout, 1))
    return target


def newest(kernel: Path) -> Path | None:
    """The image of the newest kernel in that folder, if there is one."""
    images = (kernel / "boot").glob("vmlinuz-*")
    numbers = {image: re.findall(r"\d+", image.name) for image in images}
    return max(numbers, key=lambda it: [*map(int, numbers[it])], default=None)


def boot(image: Path, archive: Path) -> int:
    """Run the machine until it switches itself off; its exit status."""
    command = [
        *("qemu-system-x86_64", "-accel", "tcg,thread=multi", "-cpu", "max"),
        *("-m", "3072", "-smp", "2", "-nographic", "-no-reboot", "-net", "none"),
        *("-kernel", str(image), "-initrd", str(archive)),
        *("-append", "console=ttyS0 quiet panic=-1"),
        "-virtfs",
        "local,path=/,mount_tag=hostroot,security_model=none,readonly=on,multidevs=remap",
    ]
    try:
        return subprocess.run(command, timeout=60 * MINUTES).returncode
    except subprocess.TimeoutExpired:
        print(f"It was stopped: it had not ended after {MINUTES} minutes.")
        return 1


def main() -> int:
    """Build, boot, report."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--kernel", type=Path, default=Path("/"))
    parser.add_argument("--speed", type=float, default=1.0)
    given = parser.parse_args()
    missing = [program for program in PROGRAMS if shutil.which(program) is None]
    if missing:
        parser.error(f"not installed: {', '.join(missing)}; --help names the packages")
    kernel = given.kernel.resolve()
    image = newest(kernel)
    if image is None:
        parser.error(f"there is no kernel in {kernel / 'boot'}; name one by --kernel")
    release = image.name.removeprefix("vmlinuz-")
    if not (kernel / "lib/modules" / release / "modules.dep").exists():
        subprocess.run(["depmod", "-b", str(kernel), release], check=True)
    with tempfile.TemporaryDirectory(prefix="real-kernel-") as name:
        archive = initramfs(kernel, release, Path(name), given.speed)
        return boot(image, archive)


if __name__ == "__main__":
    sys.exit(main())
