from collections.abc import Callable, Sequence
from typing import Any

__all__ = ["__version__", "diagnose", "working"]

__version__: str

def diagnose(
    recordings: Sequence[Any],
    rig: str | tuple[str, str],
    out: str,
    held_out: Any = None,
    hold_out_share: float | None = None,
    from_s: float | None = None,
    to_s: float | None = None,
    calibrate: int | None = None,
    jobs: int = 0,
    tick: Callable[[float, str], object] | None = None,
) -> dict[str, Any]: ...
def working() -> int: ...
