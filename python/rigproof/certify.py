"""This file checks certificates of controllers."""

from __future__ import annotations

import os
from typing import Any

from ._program import PathLike, asked


def check(certificate: PathLike, sample: int | None = None) -> dict[str, Any]:
    """Checks a certificate: `holds`, `wrong` (what disagrees), `may_go_on_the_rig`. sample: how many scenarios are run again."""
    return asked(["certify", "--check", os.fspath(certificate)] + (["--sample", str(sample)] if sample is not None else []))
