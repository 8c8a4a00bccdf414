# SPDX-License-Identifier: Apache-2.0
"""The sample sheet and the configuration: read, and checked with one line per error."""
import csv
import re
import shlex
from dataclasses import dataclass, field
from pathlib import Path

COLUMNS = ("sample", "scan", "labels", "label", "options", "settings", "group")
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
# What the workflow itself gives to `mesamis segment`. All other options are the user's.
RESERVED = ("--output", "--report", "--html", "--mesh", "--band-mesh", "--labelmap", "--body",
            "--pictures", "--labels", "--label", "--settings", "--plan", "--threads", "--memory",
            "--quiet", "--log-json", "--help", "--version")
FORMATS = ("stl", "ply", "obj", "vtp", "3mf", "amf")
TOGETHER = ("vtp", "3mf", "obj")  # formats that hold several objects in one file
DEFAULTS = {"samples": "samples.tsv", "out": "results", "program": "mesamis", "options": "",
            "formats": ["stl"], "mesh": False, "labelmap": False, "html": "auto",
            "thumbnails": True, "threads": 1, "memory_margin": 1.25, "minutes": 30,
            "minutes_per_million_voxels": 3, "outlier_z": 3.5}


@dataclass
class Sample:
    """One run. Paths are absolute; empty where the sheet names none."""
    name: str
    scan: str = ""
    labels: str = ""
    label: list = field(default_factory=list)
    options: list = field(default_factory=list)
    settings: str = ""
    group: str = ""

    def files(self):
        return [path for path in (self.scan, self.labels, self.settings) if path]


def shown(text):
    """The text in one line of ASCII, at most 80 characters."""
    line = ascii(text)
    return line if len(line) <= 80 else line[:76] + "...'"


def words_of(text):
    """Options as a shell would split them. Nothing is expanded.
    Raises ValueError, with what was expected and found."""
    try:
        words = shlex.split(text)
    except ValueError:
        raise ValueError(f"expected closed quotes, found {shown(text)}") from None
    for word in words:
        name = word.split("=", 1)[0]
        if name in RESERVED or name == "--" or re.match("-[oh]", word):
            raise ValueError(f"expected none of the options that the workflow sets itself, "
                             f"found {shown(name)}")
    return words


def _path(text, base):
    return str((base / text).resolve()) if text else ""


def _name(cells, seen):
    name = cells["sample"]
    if not NAME.fullmatch(name) or name.endswith("."):
        yield ("sample: expected 1 to 64 letters, digits, '_', '-' and '.', the first a letter or "
               f"digit, the last no '.', found {shown(name)}")
    elif name.lower() in seen:
        yield f"sample: expected a name that is not there yet, found {shown(name)} again"
    seen.add(name.lower())


def _cells(cells):
    for column, text in cells.items():
        if column != "sample" and re.search(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]", text):
            yield f"{column}: expected printable characters, found {shown(text)}"
    if not cells["scan"] and not cells["labels"]:
        yield "scan: expected a scan or labels, found neither"
    if cells["label"] and not cells["labels"]:
        yield f"label: expected labels beside it, found none for {shown(cells['label'])}"
    if any(not label.strip() or label.strip().startswith("-")
           for label in cells["label"].split(";") if cells["label"]):
        yield f"label: expected names or numbers with ';' between them, found {shown(cells['label'])}"
    try:
        words_of(cells["options"])
    except ValueError as error:
        yield f"options: {error}"


def _braces(cells, base):
    """Snakemake takes them for wildcards."""
    return [f"{column}: expected a path without braces, found {shown(_path(cells[column], base))}"
            for column in ("scan", "labels", "settings")
            if re.search("[{}]", _path(cells[column], base))]


def _sample(cells, base):
    return Sample(name=cells["sample"], scan=_path(cells["scan"], base),
                  labels=_path(cells["labels"], base),
                  label=[label.strip() for label in cells["label"].split(";") if label.strip()],
                  options=words_of(cells["options"]), settings=_path(cells["settings"], base),
                  group=cells["group"])


def _header(line):
    unknown = [name for name in line if name not in COLUMNS]
    if unknown:
        yield f"expected the columns {', '.join(COLUMNS)}, found {shown(unknown[0])}"
    if "sample" not in line or not {"scan", "labels"} & set(line):
        yield "expected a first line with the columns sample and scan (or labels)"
    if len(set(line)) < len(line):
        yield "expected each column once"


def _lines(path):
    """The number and the cells of each line that is neither empty nor a comment."""
    delimiter = "," if Path(path).suffix.lower() == ".csv" else "\t"
    with open(path, encoding="utf-8-sig", newline="") as file:
        reader = csv.reader(file, delimiter=delimiter, strict=True)
        for cells in reader:
            cells = [cell.strip(" ") for cell in cells]
            if any(cells) and not cells[0].startswith("#"):
                yield reader.line_num, cells


def _read(path):
    lines = _lines(path)
    first, header = next(lines, (1, []))
    errors = [f"{path}:{first}: {error}" for error in _header(header)]
    samples, seen = [], set()
    for number, line in lines if not errors else ():
        wrong = []
        if len(line) > len(header):
            wrong = [f"expected {len(header)} columns, found {len(line)}"]
        cells = dict.fromkeys(COLUMNS, "") | dict(zip(header, line))
        wrong += [*_name(cells, seen), *_cells(cells)]
        wrong += [] if wrong else _braces(cells, Path(path).parent)
        errors += [f"{path}:{number}: {error}" for error in wrong]
        if not wrong:
            samples.append(_sample(cells, Path(path).parent))
    if not samples and not errors:
        errors.append(f"{path}: expected at least one sample, found none")
    return samples, errors


def read_sheet(path):
    """Reads a sample sheet: .csv with commas, anything else with tabs; UTF-8.
    Paths in it are relative to its folder.
    Returns the samples and the errors, a line each. Samples count only if there is no error."""
    try:
        return _read(path)
    except (OSError, UnicodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        return [], [f"{path}: cannot be read: {reason}"]


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


CHECKS = {  # what a value of the configuration must be
    "samples": (lambda v: isinstance(v, str) and v, "a path"),
    "out": (lambda v: isinstance(v, str) and v and not re.search(r"[{}\x00-\x1f]", v),
            "a path without braces"),
    "program": (lambda v: isinstance(v, str) and v, "a program"),
    "options": (lambda v: isinstance(v, str), "options in one text"),
    "formats": (lambda v: isinstance(v, list) and v and all(f in FORMATS for f in v),
                "a list of " + ", ".join(FORMATS)),
    "mesh": (lambda v: isinstance(v, bool), "true or false"),
    "labelmap": (lambda v: isinstance(v, bool), "true or false"),
    "html": (lambda v: v in (True, False, "auto"), "true, false or auto"),
    "thumbnails": (lambda v: isinstance(v, bool), "true or false"),
    "threads": (lambda v: _is_number(v) and v == int(v) and 1 <= v <= 1024, "a count from 1"),
    "memory_margin": (lambda v: _is_number(v) and 1 <= v <= 10, "a number from 1 to 10"),
    "minutes": (lambda v: _is_number(v) and 1 <= v <= 1e5, "minutes from 1"),
    "minutes_per_million_voxels": (lambda v: _is_number(v) and 0 <= v <= 1e4, "minutes from 0"),
    "outlier_z": (lambda v: _is_number(v) and 1 <= v <= 100, "a number from 1 to 100"),
}


def check_config(config):
    """The configuration with its defaults filled in, and the errors, a line each."""
    full = {**DEFAULTS, **config}
    errors = [f"config: expected one of {', '.join(DEFAULTS)}, found {shown(str(key))}"
              for key in config if key not in DEFAULTS]
    errors += [f"config: {key}: expected {meaning}, found {shown(full[key])}"
               for key, (is_right, meaning) in CHECKS.items() if not is_right(full[key])]
    if isinstance(full["options"], str):
        try:
            words_of(full["options"])
        except ValueError as error:
            errors.append(f"config: options: {error}")
    return full, errors
