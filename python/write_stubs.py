#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes into mesamis/__init__.pyi the keywords of segment(), from the library's table of settings, and the
documentation of everything public, so that editors show it.

    PYTHONPATH=build/release/python python/write_stubs.py [--check]
"""

import ast
import inspect
import re
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


def documentation(owner, name):
    """What an editor shows of a name; empty where it has none of its own."""
    found = inspect.getattr_static(owner, name, None)
    if found is None and owner is mesamis:
        found = {"_AnyResult": mesamis._result._AnyResult, "_Shape": mesamis._shapes.Shape}.get(name)
    if isinstance(found, property):
        found = found.fget
    text = getattr(found, "__doc__", None)
    inherited = inspect.isclass(found) and any(text == getattr(base, "__doc__", None) for base in found.__mro__[1:])
    if not text or inherited:
        return ""
    # The keywords beside it say what the settings are.
    return re.sub(r"\nSettings\n-+\n.*?\n(?=Returns\n-)", "\n", inspect.cleandoc(text), flags=re.S)


def lines_of(text, indent):
    """The documentation as a string of a stub."""
    quote = text.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    if quote.endswith('"'):
        quote = quote[:-1] + '\\"'
    body = [(" " * indent + line).rstrip() for line in quote.split("\n")]
    body[0] = " " * indent + '"""' + body[0].strip()
    if len(body) == 1:
        return [body[0] + '"""']
    return [*body, " " * indent + '"""']


def documented(tree, owner):
    """The definitions of a stub that have documentation, with it."""
    for node in tree.body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name != "__init__":
            text = documentation(owner, node.name)
            if text:
                yield node, text
        if isinstance(node, ast.ClassDef):
            inner = {"_AnyResult": mesamis._result._AnyResult, "_Shape": mesamis._shapes.Shape}.get(
                node.name, getattr(mesamis, node.name, None))
            yield from documented(node, inner)


def is_text(statement):
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant) and isinstance(
        statement.value.value, str)


def without_documentation(text):
    """Every definition whose documentation alone was its body ends with "..." again."""
    lines = text.split("\n")
    nodes = [n for n in ast.walk(ast.parse(text)) if isinstance(n, (ast.ClassDef, ast.FunctionDef)) and is_text(n.body[0])]
    for node in sorted(nodes, key=lambda n: -n.lineno):
        first, last = node.body[0].lineno - 1, node.body[0].end_lineno
        del lines[first:last]
        if len(node.body) == 1:
            lines[first - 1] += " ..."
    return "\n".join(lines)


def with_documentation(text):
    text = without_documentation(text)
    lines = text.split("\n")
    # From the end; on one line what is inside first.
    found = sorted(documented(ast.parse(text), mesamis),
                   key=lambda pair: (-pair[0].body[0].lineno, -pair[0].col_offset))
    for node, words in found:
        first = node.body[0]
        inside = lines_of(words, node.col_offset + 4)
        dots = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and first.value.value is ...
        if dots:
            line = first.lineno - 1
            lines[line] = lines[line][:first.col_offset].rstrip()
            lines[line + 1:line + 1] = inside
        else:
            at = min([first.lineno, *(d.lineno for d in getattr(first, "decorator_list", []))]) - 1
            lines[at:at] = inside
    return "\n".join(lines)


if __name__ == "__main__":
    old = STUB.read_text(encoding="utf-8")
    new = with_documentation(with_keywords(old))
    if "--check" in sys.argv:
        sys.exit(0 if new == old else f"{STUB}: not up to date; run python/write_stubs.py")
    STUB.write_text(new, encoding="utf-8")
