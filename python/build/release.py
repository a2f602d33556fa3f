"""This file makes what a release consists of: python python/build/release.py FOLDER [--program PATH]

An archive of the program with its licences, manual pages and completions of shells, the wheel, the source archive, and the SHA-256 of each. With --program it
takes a program that is built already and makes its archive alone.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import platform
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SHELLS = ("bash", "elvish", "fish", "powershell", "zsh")


def archive(program: Path, folder: Path) -> Path:
    """The archive of a program; equal programs give equal archives."""
    said = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()
    top = f"rigproof-{said[1]}-{platform.machine()}-{sys.platform}"
    with tempfile.TemporaryDirectory() as scratch:
        pages = Path(scratch, "man")
        subprocess.run([program, "man", "--out", pages], check=True, capture_output=True)
        files = {program.name: program, **{f"man/{page.name}": page for page in sorted(pages.iterdir())}}
        files |= {name: ROOT / name for name in ("LICENSE-APACHE", "LICENSE-MIT", "README.md")}
        for shell in SHELLS:
            words = Path(scratch, shell)
            words.write_bytes(subprocess.run([program, "completions", shell], check=True, capture_output=True).stdout)
            files[f"completions/rigproof.{shell}"] = words
        path = folder / f"{top}.tar.gz"
        with open(path, "wb") as raw, gzip.GzipFile("", "wb", fileobj=raw, mtime=0) as packed, tarfile.open(fileobj=packed, mode="w") as tar:
            for name, file in sorted(files.items()):
                entry = tar.gettarinfo(file, f"{top}/{name}")
                entry.uid = entry.gid = entry.mtime = 0
                entry.uname = entry.gname = ""
                entry.mode = 0o755 if file == program else 0o644
                with open(file, "rb") as content:
                    tar.addfile(entry, content)
    return path


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    words.add_argument("folder", type=Path)
    words.add_argument("--program", type=Path)
    asked = words.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    program = asked.program
    if program is None:
        # The wheel's build compiles the program first; `build` is of PyPI.
        subprocess.run([sys.executable, "-m", "build", "--outdir", asked.folder, ROOT / "python"], check=True)
        program = ROOT / "python" / "rigproof.data" / "scripts" / "rigproof"
    archive(program, asked.folder)
    made = sorted(file for file in asked.folder.iterdir() if file.name != "SHA256SUMS")
    sums = "".join(f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in made)
    (asked.folder / "SHA256SUMS").write_text(sums)
    print(sums, end="")


if __name__ == "__main__":
    main()
