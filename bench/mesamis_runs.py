# SPDX-License-Identifier: Apache-2.0
"""How the studies here run mesamis: the one in build/release, or that of the variable MESAMIS."""
import json
import os
import pathlib
import subprocess
import sys

MESAMIS = os.environ.get("MESAMIS", str(pathlib.Path(__file__).parent / "../build/release/mesamis"))
RESTORED_IMAGE = str(pathlib.Path(MESAMIS).parent / "bench/bench_restored_image")


def run(*arguments):
    """Runs mesamis and returns what it did, with stdout and stderr; ends with its message if it fails. Not converged (4)
    is no failure."""
    done = subprocess.run([MESAMIS, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in (0, 4):
        sys.exit(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return done


def once(report, *arguments):
    """The report of a run. Runs only if the report is not there."""
    if not report.exists():
        run(*arguments, "--report", report)
    return json.loads(report.read_text())
