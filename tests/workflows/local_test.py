# SPDX-License-Identifier: Apache-2.0
"""The workflow on one machine: five scans, one of them broken; repeated, mended, killed."""
import json
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from support import PROGRAM, main, make_scans, phantom, run_workflow, snakemake_command, \
    write_program

NAMES = ["a", "b.2", "c_3", "d-4", "broken"]
OPTIONS = "--preview"


def configure(folder, program=PROGRAM, **more):
    config = {"program": str(program), "options": OPTIONS, "html": False, **more}
    (folder / "config.yaml").write_text(json.dumps(config))


def times(folder, pattern):
    return {p.name + p.parent.name: p.stat().st_mtime_ns for p in folder.glob(pattern)}


class Local(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.folder = Path(keep.name)
        self.out = self.folder / "results"
        make_scans(self.folder, NAMES)

    def outcome(self, name):
        return json.loads((self.out / "runs" / name / "outcome.json").read_text())

    def jobs_not_ended(self):
        """Snakemake's own marks: it repeats a job that has written its output but is not noted as ended."""
        return len(list((self.folder / ".snakemake/incomplete").glob("*")))

    def test_a_broken_scan_leaves_the_others(self):
        configure(self.folder)
        status, said = run_workflow(self.folder, "--cores", "2")
        self.assertEqual(status, 1, said)
        self.assertIn("1 of 5 scans failed:\nbroken: status 3: ", said)
        for name in NAMES[:-1]:
            self.assertEqual(self.outcome(name)["status"], 0)
            files = {p.name for p in (self.out / "runs" / name).iterdir()}
            self.assertLessEqual({"surface.stl", "report.json"}, files)
        self.assertEqual(self.outcome("broken")["status"], 3)
        page = (self.out / "table.html").read_text()
        self.assertIn("5 scans: 4 done, 0 not converged, 1 failed", page)
        self.assertIn(self.outcome("broken")["line"].split(": ")[1], page)

        # Again: no scan is touched, and the status tells of the broken one again.
        before = times(self.out, "runs/*/*"), (self.out / "table.html").read_bytes()
        status, said = run_workflow(self.folder, "--cores", "2")
        self.assertEqual(status, 1, said)
        self.assertIn("broken: status 3: ", said)
        self.assertEqual(before, (times(self.out, "runs/*/*"),
                                  (self.out / "table.html").read_bytes()))

        # Mended: it alone is run; then there is nothing to do.
        before = times(self.out, "runs/*/outcome.json")
        phantom(self.folder / "broken.nrrd")
        status, said = run_workflow(self.folder, "--cores", "2")
        self.assertEqual(status, 0, said)
        after = times(self.out, "runs/*/outcome.json")
        self.assertEqual({k for k in after if after[k] != before[k]}, {"outcome.jsonbroken"})
        self.assertIn("5 scans: 5 done", (self.out / "table.html").read_text())
        status, said = run_workflow(self.folder, "--cores", "2")
        self.assertEqual(status, 0, said)
        self.assertIn("Nothing to be done", said)

    def test_a_killed_run_resumes(self):
        program, hung, ended = (self.folder / name for name in ("program", "hung", "ended"))
        # The first try of one scan never ends, that of another one is killed.
        write_program(program, f"""case "$*" in *--plan*) ;;
*d-4.nrrd*) [ -e '{hung}' ] || {{ touch '{hung}'; exec sleep 300; }};;
*c_3.nrrd*) [ -e '{ended}' ] || {{ touch '{ended}'; kill -KILL $$; }};; esac""")
        configure(self.folder, program, thumbnails=False)
        run = subprocess.Popen(snakemake_command("--cores", "2"), cwd=self.folder,
                               start_new_session=True, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        end = time.monotonic() + 120
        while time.monotonic() < end and run.poll() is None and not (
                hung.exists() and len(times(self.out, "runs/*/outcome.json")) == 4 and
                self.jobs_not_ended() == 1):
            time.sleep(0.1)
        self.assertIsNone(run.poll())
        self.assertEqual(self.jobs_not_ended(), 1)
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        before = times(self.out, "runs/*/outcome.json")
        self.assertEqual(len(before), 4)
        self.assertFalse((self.out / "runs" / "d-4" / "outcome.json").exists())
        run_workflow(self.folder, "--cores", "1", "--unlock")
        status, said = run_workflow(self.folder, "--cores", "2", "--rerun-incomplete")
        self.assertEqual(status, 1, said)
        self.assertIn("2 of 5 scans failed", said)
        self.assertEqual(self.outcome("d-4")["status"], 0)
        after = times(self.out, "runs/*/outcome.json")
        self.assertEqual({name for name in before if before[name] != after.get(name)},
                         {"outcome.jsonc_3"})
        # What may go well another time is told, and tried again.
        self.assertIn("ended by SIGKILL (out of memory?)", (self.out / "table.html").read_text())
        status, said = run_workflow(self.folder, "--cores", "2")
        self.assertIn("1 of 5 scans failed", said)
        self.assertEqual(self.outcome("c_3")["status"], 0)

    def test_errors_of_sheet_and_configuration_are_all_told(self):
        (self.folder / "samples.tsv").write_text("sample\tscan\toptions\n../x\ta.nrrd\t\n"
                                                 "a\ta.nrrd\t-o elsewhere.stl\n")
        configure(self.folder)
        status, said = run_workflow(self.folder, "--cores", "1")
        self.assertEqual(status, 1)
        self.assertIn("samples.tsv:2: sample: expected ", said)
        self.assertIn("samples.tsv:3: options: expected ", said)
        configure(self.folder, colour="red", threads=0)
        status, said = run_workflow(self.folder, "--cores", "1")
        self.assertIn("config: expected one of ", said)
        self.assertIn("config: threads: expected a count from 1, found 0", said)
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    main("snakemake", PROGRAM)
