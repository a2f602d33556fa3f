"""This file is what is raised when an input is not usable: where, and what to do."""

from __future__ import annotations

import re

# As the program prints a place: `run.csv, line 3, column 2 `q`: problem; what to do`.
_PLACE = re.compile(r"^(?P<file>.+?)(?:, line (?P<line>\d+))?(?:, column (?P<column>\d+))?(?: `[^`]*`)?: (?P<problem>.+)$", re.S)


class Error(ValueError):
    """An input is not usable.

    `file` is the file or what stands for arrays; `line` and `column` count from 1, or are None; of arrays a line is a sample. `hint` says what to do, or is
    empty. `str(error)` is the whole message.
    """

    def __init__(self, message: str) -> None:
        super().__init__(message)
        found = _PLACE.match(message)
        self.file: str | None = found["file"] if found else None
        self.line: int | None = int(found["line"]) if found and found["line"] else None
        self.column: int | None = int(found["column"]) if found and found["column"] else None
        problem = found["problem"] if found else message
        _, _, hint = problem.partition("; ")
        self.hint: str = hint
