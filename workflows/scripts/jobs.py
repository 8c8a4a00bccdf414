# SPDX-License-Identifier: Apache-2.0
"""One scan of the workflow: what it needs, its run, its thumbnail; and the verdict on all.

  jobs.py plan JOB --folder F       asks `mesamis segment --plan`, writes plan.json
  jobs.py segment JOB --folder F --memory-mb N --threads N
                                    runs `mesamis segment`, writes outcome.json last

  jobs.py verdict SHEET --folder OUT
                                    fails where a scan has no surface that can be used

JOB is JSON: the sample and what of the configuration concerns it, see job_of(). The first two end
with 0 where the program refuses the scan: the outcome tells why.
"""
import argparse
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

from sheet import TOGETHER, read_sheet, words_of

DONE = (0, 4)          # the surface can be used; 4: not converged, marked in the table
FINAL = (0, 2, 3, 4, 5)  # another try would end in the same way
FORGOTTEN = "last-outcome.json"
REFUSED_MB = 100         # for a job that only says why nothing is run


def job_of(sample, config, html):
    """What one scan needs to know, as JSON.
    html: whether the program is to write its page."""
    job = {"sample": sample.name, "common_options": config["options"], "html": html}
    for key in ("scan", "labels", "label", "options", "settings"):
        job[key] = getattr(sample, key)
    for key in ("program", "formats", "mesh", "labelmap", "thumbnails"):
        job[key] = config[key]
    return json.dumps(job, sort_keys=True)


def _by_option(words):
    """Groups of words, each an option with its values. A negative number is a value."""
    groups = []
    for word in words:
        if word.startswith("--") or not groups:
            groups.append([])
        groups[-1].append(word)
    return groups


def merged_options(common, own):
    """The options for all scans without those that a scan has its own of, then its own."""
    def name(group):
        return group[0].split("=", 1)[0]
    names = {name(group) for group in _by_option(own)}
    kept = [group for group in _by_option(common) if name(group) not in names]
    return [word for group in kept for word in group] + own


def scan_arguments(job):
    """What says to `mesamis segment` which scan and object are meant."""
    arguments = [job["scan"]] if job["scan"] else []
    for name in ("labels", "settings"):
        if job[name]:
            arguments.append(f"--{name}={job[name]}")
    arguments += [f"--label={label}" for label in job["label"]]
    return arguments + merged_options(words_of(job["common_options"]), job["options"])


def plan_command(job):
    mesh = ["--mesh=mesh.vtu"] if job["mesh"] else []  # needs memory; a plan writes nothing
    return [job["program"], "segment", "--plan", "--log-json", *scan_arguments(job), *mesh]


def surface_names(job):
    """Files of surfaces. Several objects are also written into one file, for the picture."""
    formats = list(job["formats"])
    if job["labels"] and not set(TOGETHER) & set(formats):
        formats.append("vtp")
    return [f"surface.{extension}" for extension in formats]


def segment_command(job, folder, memory_mb, threads):
    folder = Path(folder)
    command = [job["program"], "segment", "--log-json", f"--memory={memory_mb / 1000:g}",
               f"--threads={threads}", *scan_arguments(job),
               f"--report={folder / 'report.json'}"]
    command += [f"--output={folder / name}" for name in surface_names(job)]
    for key, option in (("mesh", "--mesh={}.vtu"), ("labelmap", "--labelmap={}.nrrd"),
                        ("html", "--html={}.html")):
        if job[key]:
            command.append(option.format(folder / ("report" if key == "html" else key)))
    return command


def messages(log):
    """Errors and warnings of a log of JSON lines."""
    found = {"error": [], "warning": []}
    for line in log.splitlines():
        try:
            entry = json.loads(line)
        except ValueError:
            continue
        if isinstance(entry, dict) and entry.get("level") in found:
            found[entry["level"]].append(str(entry.get("message", "")))
    return found["error"], found["warning"]


def last_line(status, log):
    """What a run of this exit status says about itself, in one line."""
    if status < 0:
        name = signal.Signals(-status).name if -status in iter(signal.Signals) else str(-status)
        memory = " (out of memory?)" if -status == signal.SIGKILL else ""
        return f"the program was ended by {name}{memory}"
    errors, _ = messages(log)
    if errors:
        return errors[-1]
    return "" if status == 0 else f"the program ended with status {status} and said nothing"


def run_program(command, log_path):
    """Runs a command with its log in a file. Returns exit status, stdout and log."""
    with open(log_path, "w+", encoding="utf-8", errors="replace") as log:
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=log, check=False)
            status, out = done.returncode, done.stdout.decode("utf-8", "replace")
        except (OSError, ValueError) as error:
            status, out = 127, ""
            log.write(json.dumps({"level": "error", "message": f"{command[0]}: {error}"}) + "\n")
        log.seek(0)
        return status, out, log.read()


def write_json(path, value):
    """Writes a file that is whole or not there."""
    path = Path(path)
    beside = path.with_name(path.name + ".part")
    beside.write_text(json.dumps(value, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    os.replace(beside, path)


def outcome_of(job, status, log):
    return {"sample": job["sample"], "status": status, "line": last_line(status, log),
            "warnings": messages(log)[1]}


def make_plan(job, folder):
    """Asks the program what the run needs: plan.json has "memory_mb" and "voxels", or "outcome"
    of a run that need not be tried."""
    status, out, log = run_program(plan_command(job), Path(folder) / "plan.log")
    plan = {"memory_mb": REFUSED_MB, "voxels": 0}
    if status == 0:
        told = json.loads(out)
        plan = {"memory_mb": -(-told["memory_bytes"] // 1_000_000), "voxels": told["voxels"]}
    else:
        plan["outcome"] = outcome_of(job, status, log)
    write_json(Path(folder) / "plan.json", plan)


def draw_thumbnail(job, folder):
    """Draws the surface; a run without a picture is a run all the same."""
    folder = Path(folder)
    names = [n for n in surface_names(job) if (folder / n).exists()]
    names = names or sorted(p.name for p in folder.glob("surface-*"))  # of several seeds
    if not job["thumbnails"] or not names:
        return
    together = [name for name in names if name.rsplit(".", 1)[1] in TOGETHER]
    source = (together or names)[0]
    # Twice the size at which it is shown: sharp in print.
    command = [job["program"], "picture", str(folder / source), "--size=320,256", "--log-json",
               f"--output={folder / 'thumbnail.png'}"]
    if job["labels"] and source.endswith(".vtp"):
        command.append("--color=label")
    run_program(command, folder / "thumbnail.log")


def remove_old(folder):
    """What an earlier run has left does not belong to this one."""
    for path in Path(folder).iterdir():
        if path.name.startswith(("surface", "report.", "thumbnail.", "mesh.", "labelmap.", FORGOTTEN)):
            path.unlink()


def segment(job, folder, memory_mb, threads):
    """Runs the program and writes outcome.json last."""
    folder = Path(folder)
    remove_old(folder)
    plan = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
    outcome = plan.get("outcome")
    if outcome is None:
        command = segment_command(job, folder, memory_mb, threads)
        status, _, log = run_program(command, folder / "segment.log")
        outcome = outcome_of(job, status, log)
        draw_thumbnail(job, folder)
    write_json(folder / "outcome.json", outcome)


def _read_outcome(folder):
    """Of the last try, also where it is forgotten."""
    for name in ("outcome.json", FORGOTTEN):
        try:
            return json.loads((folder / name).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            continue
    return None


def read_outcomes(out, names):
    """The outcomes of the samples, and of a job that left none what can be said of it."""
    line = "the job left no outcome: not run, or ended from outside (see the logs)"
    return [_read_outcome(Path(out) / "runs" / name) or
            {"sample": name, "status": None, "line": line, "warnings": []} for name in names]


def has_html(program):
    """Whether `mesamis segment` knows --html."""
    try:
        done = subprocess.run([program, "segment", "--help"], stdin=subprocess.DEVNULL,
                              capture_output=True, check=False)
    except (OSError, ValueError):
        return False
    return b"--html" in done.stdout.split()


def failures(outcomes):
    """One line for each scan without a surface that can be used."""
    def line(outcome):
        status = outcome["status"]
        known = "" if status is None else f"status {status}: "
        return f"{outcome['sample']}: {known}{outcome['line']}"
    return [line(outcome) for outcome in outcomes if outcome["status"] not in DONE]


def forget_unfinal(out, outcomes):
    """Moves outcomes that another try may change: the next run of the workflow makes it."""
    for outcome in outcomes:
        path = Path(out) / "runs" / outcome["sample"] / "outcome.json"
        if outcome["status"] not in FINAL and path.exists():
            os.replace(path, path.with_name(FORGOTTEN))


def give_verdict(sheet, out):
    """Returns the lines of the failures. Writes OUT/verdict if there are none."""
    names = [sample.name for sample in read_sheet(sheet)[0]]
    outcomes = read_outcomes(out, names)
    failed = failures(outcomes)
    forget_unfinal(out, outcomes)
    if not failed:
        (Path(out) / "verdict").write_text(f"{len(names)} scans\n", encoding="utf-8")
    return failed


def main(arguments=None):
    parser = argparse.ArgumentParser()
    parser.add_argument("step", choices=("plan", "segment", "verdict"))
    parser.add_argument("job", help="JSON; of verdict the sample sheet")
    parser.add_argument("--folder", required=True)
    parser.add_argument("--memory-mb", type=int, default=0)
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args(arguments)
    if options.step == "verdict":
        return 1 if give_verdict(options.job, options.folder) else 0
    job = json.loads(options.job)
    Path(options.folder).mkdir(parents=True, exist_ok=True)
    if options.step == "plan":
        make_plan(job, options.folder)
    else:
        segment(job, options.folder, options.memory_mb, options.threads)
    return 0


if __name__ == "__main__":
    sys.exit(main())
