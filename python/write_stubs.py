#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the keywords of segment() in mesamis/__init__.pyi from the library's table of settings.

    PYTHONPATH=build/release/python python/write_stubs.py [--check]
"""

import sys
from pathlib import Path

sys.path = [p for p in sys.path if Path(p or ".").resolve() != Path(__file__).resolve().parent]
import mesamis  # noqa: E402  the one that was built, not the sources beside this file

STUB = Path(__file__).parent / "mesamis" / "__init__.pyi"
BEGIN, END = "    # settings, by write_stubs.py\n", "    # end of settings\n"


def type_of(setting):
    """The type of a setting's values in Python; None leaves the default."""
    if setting.switch:
        return "bool | None"
    words = ", ".join(f'"{word}"' for word in setting.words)
    kinds = [f"Literal[{words}]"] if words else []
    number = "int" if setting.whole else "float"
    if setting.ranges:
        kinds.append("str | Sequence[tuple[int | None, int | None] | None]")
    elif setting.numbers == 1:
        kinds.append(number)
    elif setting.numbers == 3:
        kinds.append(f"{number} | Sequence[{number}]")
    elif setting.numbers > 1:
        kinds.append(f"Sequence[{number}]")
    return " | ".join([*kinds, "None"])


def keywords():
    return "".join(f"    {s.name}: {type_of(s)} = ...,\n" for s in mesamis.settings())


def with_keywords(text):
    head, rest = text.split(BEGIN, 1)
    tail = rest.split(END, 1)[1]
    return head + BEGIN + keywords() + END + tail


if __name__ == "__main__":
    old = STUB.read_text(encoding="utf-8")
    new = with_keywords(old)
    if "--check" in sys.argv:
        sys.exit(0 if new == old else f"{STUB}: not up to date; run python/write_stubs.py")
    STUB.write_text(new, encoding="utf-8")
