# SPDX-License-Identifier: Apache-2.0
"""One page of all runs: table.html, a file that needs nothing beside it.

  table.py SHEET --out OUT --limit Z
"""
import argparse
import base64
import html
import json
import math
import os
import re
import sys
from pathlib import Path

from jobs import DONE, FINAL, read_outcomes
from outliers import FEWEST, FIGURES, mark_outliers
from sheet import read_sheet

MOST_THUMBNAIL_BYTES = 300_000
HERE = Path(__file__).resolve().parent


def escaped(text):
    """Text for a page; what cannot be shown becomes its number."""
    plain = "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in str(text))
    return html.escape(plain, quote=True)


def number(value):
    """Four digits that mean something; nothing for what is not known."""
    if value is None:
        return ""
    if value == int(value) and abs(value) < 1e6:
        return str(int(value))
    decimals = 3 - math.floor(math.log10(abs(value))) if value else 0
    return f"{value:.{max(0, decimals)}f}" if -4 < 3 - decimals < 7 else f"{value:.3e}"


def _known(value):
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return float(value) if is_number and math.isfinite(value) else None


def _entry(value, *keys):
    """What stands under these keys of a report, None if anything is missing."""
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def _figures(surface, error, level, seconds):
    volume, area = _known(_entry(surface, "volume_mm3")), _known(_entry(surface, "area_mm2"))
    return {"volume": None if volume is None else volume / 1000,
            "area": None if area is None else area / 100,
            "parts": _known(_entry(surface, "islands")), "level": _known(level),
            "error": _known(_entry(error, "mean")), "seconds": _known(seconds)}


def _levels(report):
    """The level at which each object borders on the background."""
    levels = {}
    for boundary in _entry(report, "object", "boundaries") or []:
        between = boundary.get("between") or []
        if None in between and boundary.get("placed_by") == "image":
            levels.setdefault(next((n for n in between if n), None), boundary.get("level_native"))
    return levels


def figures_of(report):
    """Pairs of an object's name and its figures: one without a name, or those of the labels."""
    seconds = _entry(report, "seconds")
    surfaces = _entry(report, "object", "surfaces")
    if not isinstance(surfaces, list):
        surface = _entry(report, "surface")
        error = _entry(report, "quality", "expected_error_mm")
        level = _entry(surface, "level_native")
        return [("", _figures(surface, error, level, seconds))]
    levels, found = _levels(report), []
    for surface in (s for s in surfaces if isinstance(s, dict)):
        name = str(surface.get("name", ""))
        found.append((name, _figures(surface, surface.get("expected_error_mm"), levels.get(name),
                                     None if found else seconds)))
    return found


def _read_report(folder):
    try:
        return json.loads((folder / "report.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def _state(status):
    if status == 0:
        return "done"
    return "not converged" if status in DONE else "failed"


def rows_of(out, samples, outcomes):
    """The rows of the table: one per scan, with labels one per object."""
    rows = []
    for sample, outcome in zip(samples, outcomes):
        status = outcome["status"]
        row = {"sample": sample.name, "group": sample.group, "object": "", "status": status,
               "state": _state(status), "line": outcome["line"], "first": True,
               "warnings": outcome.get("warnings", []), "figures": {}, "kind": None}
        folder = Path(out) / "runs" / sample.name
        report = _read_report(folder) if status in FINAL else None
        for name, figures in figures_of(report) or [("", {})]:
            rows.append({**row, "object": name, "figures": figures,
                         "kind": (sample.group, name)})
            row["first"] = False
    return rows


def _thumbnail(folder, name):
    try:
        data = (folder / "thumbnail.png").read_bytes()
    except OSError:
        return ""
    if len(data) > MOST_THUMBNAIL_BYTES or not data.startswith(b"\x89PNG"):
        return ""
    return (f'<img width="100" height="80" alt="Surface of {escaped(name)}" '
            f'src="data:image/png;base64,{base64.b64encode(data).decode()}">')


def _links(folder, name):
    """Links to what is there, relative to the page."""
    shown = sorted(p.name for p in folder.iterdir() if p.is_file()) if folder.is_dir() else []
    kinds = ("report.html", "report.json", "surface", "mesh.", "labelmap.", "segment.log",
             "plan.log")
    files = [f for kind in kinds for f in shown if f.startswith(kind)]
    if "segment.log" in files and "plan.log" in files:
        files.remove("plan.log")
    # Names of objects stand in names of files: the program keeps them safe, the page again.
    return " ".join(f'<a href="runs/{name}/{html.escape(_url(f))}">{escaped(f)}</a>'
                    for f in files)


def _url(name):
    safe = "-._~"
    return "".join(c if c.isascii() and c.isalnum() or c in safe
                   else "".join(f"%{b:02X}" for b in os.fsencode(c)) for c in name)


def _reason(row, figure):
    score = row["scores"][figure.key]
    unit = f" {figure.unit}" if figure.unit else ""
    side = "above" if score.z > 0 else "below"
    return (f"{figure.title} {number(row['figures'][figure.key])}{unit}, far {side} the median "
            f"{number(score.middle)}{unit} (z = {_z(score)})")


def _z(score):
    sign = "+" if score.z > 0 else "−"
    z = abs(score.z)
    return f"{sign}{z:.1f}" if z < 1000 else f"{sign}1000 or more"


def _cell(row, figure):
    value = row["figures"].get(figure.key)
    if value is None:
        return '<td class="n"></td>'
    text, about = number(value), ""
    if figure.key in row["outliers"]:
        score = row["scores"][figure.key]
        arrow = "▲" if score.z > 0 else "▼"
        text = f'<strong>{text}</strong> <span class="z">{arrow} {_z(score)}</span>'
        about = f' title="{escaped(_reason(row, figure))}"'
        return f'<td class="n out" data-v="{value!r}"{about}>{text}</td>'
    return f'<td class="n" data-v="{value!r}">{text}</td>'


def _row(row, out, columns):
    folder = Path(out) / "runs" / row["sample"]
    reasons = [f.title for f in FIGURES if f.key in row["outliers"]]
    stands_out = reasons or row["state"] != "done"
    notes = ([f'{row["line"]} (exit status {row["status"]})' if row["status"] is not None
              else row["line"]] if row["line"] and row["first"] else [])
    notes += [f"far from the others: {', '.join(reasons)}"] if reasons else []
    notes += [f"warning: {w}" for w in row["warnings"]] if row["first"] else []
    picture = _thumbnail(folder, row["sample"]) if row["first"] else ""
    state = row["state"] + (", outlier" if reasons else "")
    cells = [f'<td class="pic">{picture}</td>',
             f'<th scope="row" data-v="{escaped(row["sample"])}">{escaped(row["sample"])}</th>']
    cells += [f'<td data-v="{escaped(row[c])}">{escaped(row[c])}</td>' for c in columns]
    cells.append(f'<td class="state" data-v="{state}"><span>{state}</span></td>')
    is_empty = not any(v is not None for v in row["figures"].values())
    cells += [] if is_empty else [_cell(row, figure) for figure in FIGURES]
    listed = "".join(f"<li>{escaped(n)}</li>" for n in notes)
    wide = f' colspan="{len(FIGURES) + 1}"' if is_empty else ""
    cells.append(f'<td class="notes"{wide}>' + (f"<ul>{listed}</ul>" if listed else "") +
                 (f'<p class="files">{_links(folder, row["sample"])}</p>' if row["first"] else "")
                 + "</td>")
    mark = " ".join(filter(None, (row["state"].split()[0], "odd" if stands_out else "")))
    return f'<tr class="{mark}">{"".join(cells)}</tr>'


def _strip(figure, rows):
    """All values of a figure on a line, outliers larger."""
    known = [(row, row["figures"].get(figure.key)) for row in rows]
    known = [(row, v) for row, v in known if v is not None and (v > 0 or not figure.is_ratio)]
    if len(known) < 2:
        return ""
    x = [math.log(v) if figure.is_ratio else v for _, v in known]
    low, width = min(x), max(x) - min(x)
    dots = []
    for (row, _), value in zip(known, x):
        at = 5 + (62 * (value - low) / width if width else 31)
        is_out = figure.key in row["outliers"]
        shape = (f'<path d="M{at:.1f} 3l4 7h-8z"/>' if is_out
                 else f'<circle cx="{at:.1f}" cy="7" r="2.2"/>')
        dots.append((is_out, shape))
    marks = "".join(shape for _, shape in sorted(dots, key=lambda dot: dot[0]))
    ends = f"{number(min(v for _, v in known))} to {number(max(v for _, v in known))}"
    return (f'<svg width="72" height="14" viewBox="0 0 72 14" role="img" '
            f'aria-label="{escaped(ends)}"><path class="axis" d="M2 12.5h68"/>{marks}</svg>'
            f'<div class="ends">{escaped(ends)}</div>')


def _heads(rows, columns):
    heads = ['<th scope="col">surface</th>']
    names = ["scan", *columns, "state"]
    units = {f.title: f.unit for f in FIGURES}
    for name in names + [f.title for f in FIGURES]:
        unit = f'<span class="unit">{units[name]}</span>' if units.get(name) else ""
        figure = next((f for f in FIGURES if f.title == name), None)
        strip = _strip(figure, rows) if figure else ""
        heads.append(f'<th scope="col"><button type="button">{name}</button>'
                     f'<span class="paper">{name}</span>{unit}{strip}</th>')
    return "".join(heads) + '<th scope="col">notes and files</th>'


def _count(number_of, one, many):
    return f"{number_of} {one if number_of == 1 else many}"


def _summary(rows):
    first = [row for row in rows if row["first"]]
    counts = [sum(row["state"] == state for row in first)
              for state in ("done", "not converged", "failed")]
    odd = len({row["sample"] for row in rows if row["outliers"]})
    return (f"{_count(len(first), 'scan', 'scans')}: {counts[0]} done, {counts[1]} not converged, "
            f"{counts[2]} failed; {odd} with a figure far from the others.")


def _findings(rows):
    """What a reader must not miss, a line each."""
    lines = []
    for row in rows:
        if row["first"] and row["state"] == "failed":
            status = "" if row["status"] is None else f" (exit status {row['status']})"
            lines.append(f'<li class="failed"><b>{escaped(row["sample"])}</b> failed{status}: '
                         f'{escaped(row["line"])}</li>')
    for row in rows:
        name = escaped(", ".join(filter(None, (row["sample"], row["object"]))))
        reasons = [escaped(_reason(row, f)) for f in FIGURES if f.key in row["outliers"]]
        lines += [f"<li><b>{name}</b>: {'; '.join(reasons)}</li>"] if reasons else []
    return f"<ul>{''.join(lines)}</ul>" if lines else ""


def page(rows, out, limit):
    """The page of these rows. The same rows and files give the same bytes."""
    mark_outliers(rows, limit)
    columns = [c for c in ("group", "object") if any(row[c] for row in rows)]
    text = (HERE / "table.html").read_text(encoding="utf-8")
    few = ("" if any(row["scores"] for row in rows) else
           f" Fewer than {FEWEST} runs are alike here: no figure is judged.")
    parts = {"SUMMARY": _summary(rows), "LIMIT": f"{limit:g}", "FEWEST": str(FEWEST), "FEW": few,
             "FINDINGS": _findings(rows), "HEADS": _heads(rows, columns),
             "ROWS": "\n".join(_row(row, out, columns) for row in rows)}
    # In one pass: what comes from a scan may look like a part.
    return re.sub("@([A-Z]+)@", lambda found: parts[found[1]], text)


def write_table(out, samples, limit):
    """Writes OUT/table.html whole or not at all."""
    outcomes = read_outcomes(out, [sample.name for sample in samples])
    text = page(rows_of(out, samples, outcomes), out, limit)
    path = Path(out) / "table.html"
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name("table.html.part")
    beside.write_text(text, encoding="utf-8")
    os.replace(beside, path)


def main(arguments=None):
    parser = argparse.ArgumentParser()
    parser.add_argument("sheet")
    parser.add_argument("--out", required=True)
    parser.add_argument("--limit", type=float, required=True)
    options = parser.parse_args(arguments)
    samples, errors = read_sheet(options.sheet)
    for error in errors:
        print(error, file=sys.stderr)
    if not errors:
        write_table(options.out, samples, options.limit)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
