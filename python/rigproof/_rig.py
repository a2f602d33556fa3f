"""This file is a rig description: what it is, what is known of it, and what the channels of its recordings mean."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from . import _mjcf, _urdf
from ._errors import Error

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

    Rig.from_path(path), Rig.from_dict(keys), Rig.axis(...), Rig.from_urdf(...), Rig.from_mjcf(...). `inferred` says what was read out of a model, a line each.
    """

    def __init__(self, text: str, path: str | None = None, inferred: list[str] | None = None) -> None:
        self.text = text
        self.path = path
        self.inferred = inferred or []

    @property
    def is_sweep(self) -> bool:
        """Whether its recordings are static sweeps: settled rows, without a time."""
        return re.search(r"""["']?drive["']?\s*=\s*["']static["']""", self.text) is not None

    @classmethod
    def from_path(cls, path: str | os.PathLike[str]) -> Rig:
        """The description in a TOML file."""
        try:
            return cls(Path(path).read_text(encoding="utf-8"), os.fspath(path))
        except (OSError, UnicodeDecodeError) as error:
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
        servo: Mapping[str, float] | None = None,
        effects: list[dict[str, Any]] | None = None,
        **roles: dict[str, float],
    ) -> Rig:
        """One driven joint: command in, position out.

        position, command: the names of the channels. inertia, command_gain: value and unit, such as (0.002, "kg·m²/rad") and (0.4, "N·m/A"). status: `known`,
        or `unknown` where both are only a start for the fit. effects: physics that the model has already, each a dict as a table `[[effect]]` of a rig file.
        drive: what the command does between two samples, `held` where a card holds it, as `[protocol]` of a rig file says. servo:
        numbers of a position servo as `[servo]` says, such as {"gain": 8.5, "supply_v": 7.4, "back_emf": 0.386} in V/rad, V and V·s/rad; the command is then its
        goal, and the gain of the command is N·m/V. position_keys, command_keys: further keys of a channel, such as {"quantum": 1e-4, "sign": -1}.
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
                **({} if servo is None else {"servo": servo}),
                "protocol": {} if drive is None else {"drive": drive},
            }
        )

    @classmethod
    def from_urdf(
        cls,
        path: str | os.PathLike[str],
        position: Sequence[str],
        effort: Sequence[str],
        *,
        tip: str | None = None,
        joints: Sequence[str] | None = None,
        name: str = "arm",
        units: Mapping[str, str] | None = None,
        position_keys: Mapping[str, float] | None = None,
        effort_keys: Mapping[str, float] | None = None,
        effects: list[dict[str, Any]] | None = None,
    ) -> Rig:
        """A serial arm that is modelled by a URDF: positions and efforts of its joints in, which efforts the model leaves over out.

        position, effort: the names of the channels, one for each moving joint from the base to the tip, or for each of `joints` in that order. tip: the link
        beyond which nothing is attached; needed where the URDF branches. units: of channels that are not in rad and N·m (or m and N). position_keys, effort_keys:
        further keys of every channel, such as {"noise": 0.02}. effects: physics that the model has beyond the URDF, each a dict as `[[effect]]` with its `joint`.
        """
        there = _urdf.moving(path, tip)
        motions = dict(there)
        names = list(joints) if joints is not None else [own for own, _ in there]
        unknown = [own for own in names if own not in motions] + [own for own in motions if own not in names]
        if unknown or len(names) != len(motions):
            raise Error(f"joints: `{unknown[0] if unknown else names[-1]}`; name each of {', '.join(motions)} once, or move the tip")
        for role, own in (("position", position), ("effort", effort)):
            if isinstance(own, str) or len(own) != len(names):
                raise Error(f"{role}: {len(own)} channels; give {len(names)}, one for each of {', '.join(names)}")

        def of(channel: str, usual: str, more: Mapping[str, float] | None) -> dict[str, Any]:
            return {"channel": channel, "unit": (units or {}).get(channel, usual), **(more or {})}

        rows = []
        for own, q, tau in zip(names, position, effort):
            usual = ("rad", "N·m") if motions[own] == "rotary" else ("m", "N")
            rows.append({"name": own, "motion": motions[own], "position": of(q, usual[0], position_keys), "effort": of(tau, usual[1], effort_keys)})
        keys = {"name": name, "plant": "chain", "urdf": os.path.abspath(path), **({} if tip is None else {"tip": tip}), "joint": rows, "effect": effects or []}
        return cls.from_dict(keys)

    @classmethod
    def from_mjcf(
        cls,
        model: Any,
        position: str | Sequence[str],
        *,
        command: str | None = None,
        effort: Sequence[str] | None = None,
        joints: Sequence[str] | None = None,
        actuator: str | int = 0,
        urdf: str | os.PathLike[str] | None = None,
        name: str | None = None,
        command_unit: str | None = None,
        position_keys: Mapping[str, float] | None = None,
        command_keys: Mapping[str, float] | None = None,
        effort_keys: Mapping[str, float] | None = None,
        drive: str | None = None,
    ) -> Rig:
        """A rig from a MuJoCo model, an MjModel or the path of an MJCF file; `inferred` says what MuJoCo's compiler made of it.

        One joint: position and command are the names of two channels, joints the joint's name where the model has several; inertia, damping, frictionloss,
        gravity and the actuator's gain are taken as known. command_unit: V, A or whatever the command is in; the unit of the effort where it is None.

        An arm: position and effort are lists, a channel for each of `joints`, all of the model where it is None. It is written as a URDF to the file `urdf`.
        """
        own = _mjcf.compiled(model)
        found = _mjcf.chosen(own, joints)
        name = name or "joint"
        if isinstance(position, str):
            if command is None or len(found) != 1:
                raise Error("from_mjcf: one position means one joint: give its command, and its name where the model has several, joints=['...']")
            keys, said = _mjcf.axis(own, found[0], actuator)
            turns, effort_unit = keys["motion"] == "rotary", "N·m" if keys["motion"] == "rotary" else "N"
            is_servo = "servo" in keys
            unit = command_unit or (("rad" if turns else "m") if is_servo else effort_unit)
            if not is_servo:
                keys["parameters"]["command_gain"]["unit"] += f"/{unit}"
            channels = {
                "position": {"channel": position, "unit": "rad" if turns else "m", **(position_keys or {})},
                "command": {"channel": command, "unit": unit, **(command_keys or {})},
            }
            protocol = {} if drive is None else {"drive": drive}
            rig = cls.from_dict({"name": name, "plant": "axis", "channels": channels, **keys, "protocol": protocol})
            rig.inferred = said
            return rig
        if effort is None or urdf is None:
            raise Error("from_mjcf: an arm needs the channels of its efforts, effort=[...], and a file for its URDF, urdf='arm.urdf'")
        text, effects, said = _mjcf.urdf(own, found, name)
        Path(urdf).write_text(text, encoding="utf-8")
        rig = cls.from_urdf(urdf, position, effort, name=name, position_keys=position_keys, effort_keys=effort_keys, effects=effects)
        rig.inferred = [*said, f"written to {os.fspath(urdf)}"]
        return rig

    @classmethod
    def of(cls, rig: Any) -> Rig:
        """A rig from whatever `diagnose` takes: a Rig, a path, or a dict."""
        if isinstance(rig, Rig):
            return rig
        if isinstance(rig, Mapping):
            return cls.from_dict(rig)
        return cls.from_path(rig)

    def given(self, settings: Sequence[tuple[str, Mapping[str, float]]] = ()) -> str | tuple[str, str]:
        """What the compiled part takes: the path, or the text and its name; with a table `[[recording]]` for each recording that has settings of its own."""
        if self.path is not None and not settings:
            return self.path
        more = "".join("\n[[recording]]\n" + "".join(f"{key} = {_toml(value)}\n" for key, value in {"file": name, **own}.items()) for name, own in settings)
        return (self.text + more, self.path or "rig.toml")

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the description as TOML."""
        Path(path).write_text(self.text, encoding="utf-8")

    def __repr__(self) -> str:
        return f"Rig.from_path({self.path!r})" if self.path else f"Rig({self.text!r})"
