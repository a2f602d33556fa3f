"""This file says which joints a URDF moves, from its root to a tip."""

from __future__ import annotations

import os
from xml.etree import ElementTree

from ._errors import Error

# What a joint of each type does, as a rig description calls it.
MOTIONS = {"revolute": "rotary", "continuous": "rotary", "prismatic": "linear"}


def moving(path: str | os.PathLike[str], tip: str | None) -> list[tuple[str, str]]:
    """Name and motion, `rotary` or `linear`, of each moving joint on the way from the root to the link `tip`; without one to the only end."""
    name = os.fspath(path)
    try:
        robot = ElementTree.parse(name).getroot()
    except OSError as error:
        raise Error(f"{name}: it cannot be read; {error}") from error
    except ElementTree.ParseError as error:
        raise Error(f"{name}, line {error.position[0]}, column {error.position[1] + 1}: it is no XML; give a URDF") from error
    above: dict[str, tuple[str, str, str]] = {}
    for joint in robot.iter("joint"):
        parent, child = joint.find("parent"), joint.find("child")
        if parent is not None and child is not None:
            above[child.get("link", "")] = (joint.get("name", ""), joint.get("type", ""), parent.get("link", ""))
    links = [link.get("name", "") for link in robot.findall("link")]
    parents = {parent for _, _, parent in above.values()}
    ends = [link for link in links if link not in parents]
    if tip is None:
        if len(ends) != 1:
            raise Error(f"{name}: it has the ends {', '.join(ends)}; say beyond which link nothing is attached, tip=...")
        tip = ends[0]
    elif tip not in links:
        raise Error(f"{name}: `{tip}` is no link; the links are {', '.join(links)}")
    way: list[tuple[str, str]] = []
    link, seen = tip, {tip}
    while link in above:
        own, kind, link = above[link]
        if link in seen:
            raise Error(f"{name}: the joints around `{link}` make a loop; give a serial arm")
        seen.add(link)
        if kind in MOTIONS:
            way.insert(0, (own, MOTIONS[kind]))
    if not way:
        raise Error(f"{name}: no joint moves between the root and `{tip}`; give an arm")
    return way
