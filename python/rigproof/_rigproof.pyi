from collections.abc import Callable, Sequence
from typing import Any

__version__: str

def diagnose(
    recordings: Sequence[Any],
    rig: str | tuple[str, str],
    out: str,
    held_out: Any = None,
    hold_out_share: float | None = None,
    between_s: tuple[float | None, float | None] = (None, None),
    calibrate: int | None = None,
    jobs: int = 0,
    tick: Callable[[float], object] | None = None,
) -> dict[str, Any]: ...
