"""This file is a rig description: what it is, what is known of it, and what the channels of its recordings mean."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

Number = tuple[float, str]


def _toml(value: Any) -> str:
    """A value of TOML, tables inline."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escaped = "".join(f"\\u{ord(c):04X}" if ord(c) < 32 or ord(c) == 127 else "\\" + c if c in '"\\' else c for c in value)
        return f'"{escaped}"'
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_toml(str(k))} = {_toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(v) for v in value) + "]"
    if isinstance(value, (int, float)) or hasattr(value, "__float__"):
        return repr(value) if isinstance(value, int) else repr(float(value))
    raise TypeError(f"{value!r} cannot stand in a rig description; give text, numbers, tables or lists")


class Rig:
    """A rig description, from a file, a dict of the same keys, or a constructor.

    Rig.from_path(path), Rig.from_dict(keys), Rig.axis(...).
    """

    def __init__(self, text: str, path: str | None = None) -> None:
        self.text = text
        self.path = path

    @classmethod
    def from_path(cls, path: str | os.PathLike[str]) -> Rig:
        """The description in a TOML file."""
        try:
            return cls(Path(path).read_text(encoding="utf-8"), os.fspath(path))
        except (OSError, UnicodeDecodeError) as error:
            from ._errors import Error

            raise Error(f"{os.fspath(path)}: it cannot be read as text; {error}") from error

    @classmethod
    def from_dict(cls, keys: Mapping[str, Any]) -> Rig:
        """The description whose TOML file would have these keys; a list of dicts under `effect` is a list of `[[effect]]`."""
        return cls("".join(f"{_toml(str(key))} = {_toml(value)}\n" for key, value in keys.items()))

    @classmethod
    def axis(
        cls,
        *,
        position: str,
        command: str,
        inertia: Number,
        command_gain: Number,
        position_unit: str = "rad",
        command_unit: str = "V",
        motion: str = "rotary",
        name: str = "axis",
        status: str = "known",
        drive: str | None = None,
        effects: list[dict[str, Any]] | None = None,
        **roles: dict[str, float],
    ) -> Rig:
        """One driven joint: command in, position out.

        position, command: the names of the channels. inertia, command_gain: value and unit, such as (0.002, "kg·m²/rad") and (0.4, "N·m/A"). status: `known`,
        or `unknown` where both are only a start for the fit. effects: physics that the model has already, each a dict as a table `[[effect]]` of a rig file.
        drive: what the command does between two samples, `held` where a card holds it, as `[protocol]` of a rig file says. position_keys, command_keys: further keys of a channel, such as {"quantum": 1e-4, "sign": -1}.
        """

        def value(number: Number) -> dict[str, Any]:
            return {"value": number[0], "unit": number[1], "status": status}

        def of(role: str, channel: str, unit: str) -> dict[str, Any]:
            return {"channel": channel, "unit": unit, **roles.get(f"{role}_keys", {})}

        unknown = set(roles) - {"position_keys", "command_keys"}
        if unknown:
            raise TypeError(f"Rig.axis() got an unexpected keyword argument {sorted(unknown)[0]!r}")
        return cls.from_dict(
            {
                "name": name,
                "plant": "axis",
                "motion": motion,
                "channels": {"position": of("position", position, position_unit), "command": of("command", command, command_unit)},
                "parameters": {"inertia": value(inertia), "command_gain": value(command_gain)},
                "effect": effects or [],
                "protocol": {} if drive is None else {"drive": drive},
            }
        )

    @classmethod
    def of(cls, rig: Any) -> Rig:
        """A rig from whatever `diagnose` takes: a Rig, a path, or a dict."""
        if isinstance(rig, Rig):
            return rig
        if isinstance(rig, Mapping):
            return cls.from_dict(rig)
        return cls.from_path(rig)

    def given(self) -> str | tuple[str, str]:
        """What the compiled part takes: the path, or the text and its name."""
        return self.path if self.path is not None else (self.text, "rig.toml")

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the description as TOML."""
        Path(path).write_text(self.text, encoding="utf-8")

    def __repr__(self) -> str:
        return f"Rig.from_path({self.path!r})" if self.path else f"Rig({self.text!r})"
