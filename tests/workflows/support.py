# SPDX-License-Identifier: Apache-2.0
"""What the tests of the workflow share. MESAMIS_PROGRAM names the program."""
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WORKFLOWS = ROOT / "workflows"
PROGRAM = os.environ.get("MESAMIS_PROGRAM", "mesamis")
SKIPPED = 77  # the exit status that says so
sys.path.insert(0, str(WORKFLOWS / "scripts"))


def main(*needed, also=""):
    """Runs the tests of the calling file, or says which programs are not there."""
    missing = [name for name in needed if not shutil.which(name)]
    why = f"not installed: {', '.join(missing)}" if missing else also
    if why:
        print("skipped:", why)
        sys.exit(SKIPPED)
    ran = unittest.main(verbosity=2, exit=False).result
    if not ran.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if ran.testsRun and len(ran.skipped) == ran.testsRun else 0)


def phantom(path, *options):
    subprocess.run([PROGRAM, "phantom", "sphere", "--size=20,20,20", "--spacing=2.5,2.5,2.5",
                    "--quiet", *options, f"--output={path}"], check=True,
                   stdout=subprocess.DEVNULL)


def make_scans(folder, names):
    """Small scans of balls, the last of them cut off, and a sheet of them all."""
    for n, name in enumerate(names):
        phantom(folder / f"{name}.nrrd", "--noise=3", f"--seed={n}")
    last = folder / f"{names[-1]}.nrrd"
    last.write_bytes(last.read_bytes()[:2000])
    rows = "".join(f"{name}\t{name}.nrrd\n" for name in names)
    (folder / "samples.tsv").write_text("sample\tscan\n" + rows)


def snakemake_command(*arguments):
    return ["snakemake", "--snakefile", str(WORKFLOWS / "Snakefile"), "--configfile", "config.yaml",
            *arguments]


def run_workflow(folder, *arguments, **more):
    """Exit status and all that was said."""
    done = subprocess.run(snakemake_command(*arguments), cwd=folder, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False, timeout=300, **more)
    return done.returncode, done.stdout


def write_program(path, lines):
    """A program that does something of its own before, or instead of, what mesamis does."""
    path.write_text(f"#!/bin/sh\n{lines}\nexec '{PROGRAM}' \"$@\"\n")
    path.chmod(0o755)
