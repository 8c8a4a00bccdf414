# SPDX-License-Identifier: Apache-2.0
"""The functions of the workflow, without Snakemake."""
import importlib.util
import json
import math
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from support import WORKFLOWS, main

import jobs
import outliers
import sheet
import table


def profile_module(name):
    spec = importlib.util.spec_from_file_location(name, WORKFLOWS / f"profiles/slurm/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class InFolder(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.folder = Path(keep.name).resolve()

    def read(self, text, name="samples.tsv"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return sheet.read_sheet(str(path))


class Sheet(InFolder):
    def errors(self, row, header="sample\tscan\tlabels\tlabel\toptions"):
        return [e.split(":", 2)[2].strip() for e in self.read(f"{header}\n{row}\n")[1]]

    def test_reads_tabs_and_commas_alike(self):
        for name, mark in (("s.tsv", "\t"), ("s.csv", ",")):
            rows = ["# a comment", "sample|scan|label|labels|options|group", "",
                    "a.1|x y.nii|left; 2|/m.nii|--tau 0.1 --seed '1 2'|hips"]
            samples, errors = self.read("\n".join(rows).replace("|", mark), name)
            self.assertEqual(errors, [])
            self.assertEqual(samples, [sheet.Sample(
                "a.1", str(self.folder / "x y.nii"), "/m.nii", ["left", "2"],
                ["--tau", "0.1", "--seed", "1 2"], "", "hips")])

    def test_reads_what_spreadsheets_write(self):
        samples, errors = self.read("\ufeffsample,scan\r\n\"a\",\"b,c.nii\"\r\n", "s.csv")
        self.assertEqual(errors, [])
        self.assertTrue(samples[0].scan.endswith("/b,c.nii"))

    def test_refuses_hostile_names(self):
        for name in ("../a", "a/b", "", ".a", "-a", "a b", "a;b", "$(a)", "a\x00", "ä", "a" * 65,
                     "a{b}", "a.", "<b>", "'a'", "\u202ea"):
            errors = self.errors(f"{name}\tx.nii")
            self.assertEqual(len(errors), 1, name)
            self.assertIn("sample: expected", errors[0])
            self.assertTrue(errors[0].isascii() and errors[0].isprintable())

    def test_refuses_names_that_differ_in_case_alone(self):
        errors = self.errors("a\tx.nii\nA\ty.nii")
        self.assertEqual(len(errors), 1)
        self.assertIn("'A' again", errors[0])

    def test_refuses_options_that_are_the_workflows(self):
        for option in ("-o x.stl", "-ox.stl", "--output=x.stl", "--report r.json", "--threads 4",
                       "--plan", "-h", "--tau 1 -- x", "--html=a.html", "'-o' x"):
            self.assertIn("expected none of the options", self.errors(f"a\tx\t\t\t{option}")[0])
        self.assertIn("closed quotes", self.errors("a\tx\t\t\t--name \"b")[0])
        self.assertEqual(self.errors("a\tx\t\t\t--tau 0.1 --level -300"), [])

    def test_tells_all_errors_with_their_lines(self):
        _, errors = self.read("sample\tscan\n../a\tx\nb\tx\tmore\nc\t\n")
        self.assertEqual([re.search(r":(\d+): ", e)[1] for e in errors], ["2", "3", "4"])

    def test_refuses_cells_that_mean_nothing(self):
        for row in ("a\t", "a\tx\x07", "a\tx\t\tlabel", "a\tx\tm\tb;;c", "a\tx{y}.nii",
                    "a\tx\tm\t--help"):
            self.assertEqual(len(self.errors(row)), 1, row)

    def test_refuses_sheets_that_are_none(self):
        for text in ("", "sample\n", "scan\nx\n", "sample\tscan\tcolour\na\tx\tred\n",
                     "sample\tscan\n", "sample\tscan\tscan\n", b"\xff\xfe\x00",
                     'sample\tscan\n"a\tx'):
            samples, errors = self.read(text)
            self.assertEqual(len(errors), 1, text)
            self.assertEqual(samples, [])
        self.assertIn("cannot be read", sheet.read_sheet(str(self.folder / "none.tsv"))[1][0])

    def test_the_example_is_right(self):
        self.assertEqual(sheet.read_sheet(str(WORKFLOWS / "samples.tsv"))[1], [])


class Configuration(unittest.TestCase):
    def test_defaults_are_right_and_written_down(self):
        self.assertEqual(sheet.check_config({}), (sheet.DEFAULTS, []))
        lines = (WORKFLOWS / "config.yaml").read_text().splitlines()
        self.assertEqual([line.split(":")[0] for line in lines if not line.startswith("#")],
                         list(sheet.DEFAULTS))

    def test_refuses_what_is_unknown_or_out_of_range(self):
        for key, value in (("colour", 1), ("threads", 0), ("threads", "2"), ("formats", ["jpg"]),
                           ("formats", []), ("html", "maybe"), ("memory_margin", 0.5),
                           ("out", "a{b}"), ("mesh", "yes"), ("outlier_z", float("nan")),
                           ("options", "--report x.json"), ("samples", "")):
            self.assertEqual(len(sheet.check_config({key: value})[1]), 1, (key, value))


class Jobs(InFolder):
    def job(self, **more):
        return {**json.loads(jobs.job_of(sheet.Sample("a", "/s.nii"), sheet.DEFAULTS, False)),
                **more}

    def test_options_of_a_scan_replace_those_of_all(self):
        self.assertEqual(jobs.merged_options(["--level", "-300", "--preview", "--tau=1"],
                                             ["--level=5", "--tau", "2"]),
                         ["--preview", "--level=5", "--tau", "2"])
        self.assertEqual(jobs.merged_options([], []), [])

    def test_the_command_says_what_the_sheet_says(self):
        command = jobs.segment_command(
            self.job(labels="/l.nii", label=["left", "2"], formats=["stl"], mesh=True, html=True),
            "/out", 1500, 3)
        for word in ("/s.nii", "--labels=/l.nii", "--label=left", "--label=2", "--memory=1.5",
                     "--threads=3", "--output=/out/surface.stl", "--output=/out/surface.vtp",
                     "--mesh=/out/mesh.vtu", "--html=/out/report.html"):
            self.assertIn(word, command)
        self.assertNotIn("--html", " ".join(jobs.segment_command(self.job(), "/out", 1, 1)))

    def test_the_outcome_is_one_line(self):
        log = "\n".join(['{"level":"progress"}', '{"level":"warning","message":"w"}', "noise", "[]",
                         '{"level":"error","message":"first"}',
                         '{"level":"error","message":"last"}'])
        self.assertEqual(jobs.outcome_of(self.job(), 3, log),
                         {"sample": "a", "status": 3, "line": "last", "warnings": ["w"]})
        self.assertIn("SIGKILL (out of memory?)", jobs.last_line(-9, log))
        self.assertIn("status 1 and said nothing", jobs.last_line(1, ""))
        self.assertEqual(jobs.last_line(0, ""), "")

    def test_a_program_that_is_not_there_is_told(self):
        job = self.job(program=str(self.folder / "none"))
        jobs.make_plan(job, self.folder)
        jobs.segment(job, self.folder, 100, 1)
        outcome = json.loads((self.folder / "outcome.json").read_text())
        self.assertEqual(outcome["status"], 127)
        self.assertIn("none", outcome["line"])
        self.assertFalse(jobs.has_html(job["program"]))

    def test_what_may_go_well_another_time_is_forgotten_and_told(self):
        for name, status in (("a", 0), ("b", 3), ("c", -9), ("d", 5), ("e", 4)):
            folder = self.folder / "runs" / name
            folder.mkdir(parents=True)
            jobs.write_json(folder / "outcome.json", jobs.outcome_of({"sample": name}, status, ""))
        self.read("sample\tscan\n" + "".join(f"{n}\tx\n" for n in "abcdef"))
        failed = jobs.give_verdict(str(self.folder / "samples.tsv"), self.folder)
        self.assertEqual([line.split(":")[0] for line in failed], ["b", "c", "d", "f"])
        self.assertFalse((self.folder / "runs/c/outcome.json").exists())
        self.assertTrue((self.folder / "runs/b/outcome.json").exists())
        self.assertIn("SIGKILL", jobs.read_outcomes(self.folder, ["c"])[0]["line"])
        self.assertFalse((self.folder / "verdict").exists())


class Outliers(unittest.TestCase):
    def marked(self, key, values, kind="k"):
        rows = [{"kind": kind, "figures": {key: v}} for v in values]
        outliers.mark_outliers(rows, 3.5)
        return [n for n, row in enumerate(rows) if row["outliers"]]

    def test_scores_are_those_of_the_formula(self):
        level = next(f for f in outliers.FIGURES if f.key == "level")
        values = [100, 102, 104, 106, 130]  # median 104, deviations 4 2 0 2 26: MAD 2
        z = [s.z for s in outliers.scores_of(level, values)]
        for found, value in zip(z, values):
            self.assertAlmostEqual(found, (value - 104) / (1.4826 * 2))

    def test_twice_and_half_are_equally_far(self):
        volume = next(f for f in outliers.FIGURES if f.key == "volume")
        z = [s.z for s in outliers.scores_of(volume, [50, 99, 100, 101, 200])]
        self.assertAlmostEqual(z[0], -z[4])

    def test_one_outlier_does_not_hide_itself_nor_another(self):
        self.assertEqual(self.marked("volume", [10, 10.5, 9.8, 10.2, 9.9, 1000, 900]), [5, 6])

    def test_equal_runs_are_not_judged_by_crumbs(self):
        self.assertEqual(self.marked("volume", [10, 10, 10, 10, 10.1]), [])
        self.assertEqual(self.marked("parts", [1, 1, 1, 1, 2]), [4])
        self.assertEqual(self.marked("parts", [1, 2, 3, 2, 1, 3]), [])
        self.assertEqual(self.marked("level", [0, 0, 0, 0, 7]), [])

    def test_few_or_unknown_values_are_not_judged(self):
        self.assertEqual(self.marked("volume", [1, 1, 1, 100]), [])
        self.assertEqual(self.marked("volume", [1, 1, 1, None, float("nan"), 0, 100]), [])

    def test_only_the_like_are_compared(self):
        rows = [{"kind": n % 2, "figures": {"volume": 10 + 990 * (n % 2)}} for n in range(12)]
        outliers.mark_outliers(rows, 3.5)
        self.assertFalse(any(row["outliers"] for row in rows))


def report(volume, seconds=2.0):
    return {"surface": {"volume_mm3": volume, "area_mm2": 600, "islands": 1, "level_native": 150},
            "quality": {"expected_error_mm": {"mean": 0.1}}, "seconds": seconds}


class Table(InFolder):
    def fill(self, volumes, line="", name="s{}"):
        samples = []
        for n, volume in enumerate(volumes):
            sample = sheet.Sample(name.format(n), "/x")
            folder = self.folder / "runs" / sample.name
            folder.mkdir(parents=True)
            jobs.write_json(folder / "outcome.json", {"sample": sample.name, "line": line,
                                                      "warnings": [line] if line else [],
                                                      "status": 3 if volume is None else 0})
            if volume is not None:
                jobs.write_json(folder / "report.json", report(volume))
                (folder / "thumbnail.png").write_bytes(b"\x89PNG" + bytes(10))
            samples.append(sample)
        table.write_table(self.folder, samples, 3.5)
        return (self.folder / "table.html").read_text(encoding="utf-8")

    def test_says_what_failed_and_which_figure_is_the_reason(self):
        page = self.fill([1000, 1010, 990, 1005, 9000, None], "no such file")
        self.assertIn("6 scans: 5 done, 0 not converged, 1 failed; 1 with a figure", page)
        self.assertIn("<b>s5</b> failed (exit status 3): no such file", page)
        self.assertRegex(page, r"<b>s4</b>: volume 9 cm³, far above the median 1.005 cm³ \(z = \+\d")
        self.assertEqual(page.count("<tr class="), 6)
        self.assertEqual(page.count("data:image/png;base64,"), 5)

    def test_is_the_same_again(self):
        first = self.fill([1000, 2000])
        table.write_table(self.folder, [sheet.Sample("s0"), sheet.Sample("s1")], 3.5)
        self.assertEqual(first, (self.folder / "table.html").read_text(encoding="utf-8"))

    def test_needs_nothing_from_outside_and_shows_text_as_text(self):
        page = self.fill([1000, None], "<script>alert(1)</script> \"'& \x1b[31m \u202e @ROWS@")
        self.assertNotIn("<script>alert", page)
        self.assertIn("&lt;script&gt;alert(1)&lt;/script&gt; &quot;&#x27;&amp; \\u001b[31m \\u202e",
                      page)
        self.assertEqual(page.count("<tr class="), 2)
        self.assertEqual(page.count("@ROWS@"), 5)  # a finding; a note and a warning of both scans
        self.assertNotRegex(page, r"https?://|url\(|@import|<link")
        self.assertIn("default-src 'none'", page)

    def test_broken_reports_are_no_harm(self):
        self.fill([1000, 1000])
        for text in ("", "[]", "{\"surface\": 3}", "{\"object\": {\"surfaces\": [3, null]}}",
                     "{\"seconds\": \"x\"}", "{\"surface\": {\"volume_mm3\": 1e999}}"):
            (self.folder / "runs/s0/report.json").write_text(text)
            table.write_table(self.folder, [sheet.Sample("s0"), sheet.Sample("s1")], 3.5)
            self.assertIn("2 scans: 2 done", (self.folder / "table.html").read_text("utf-8"))

    def test_each_object_of_labels_has_a_row(self):
        found = table.figures_of({"seconds": 3, "object": {
            "surfaces": [{"name": "left", "volume_mm3": 2000, "islands": 2,
                          "expected_error_mm": {"mean": 0.2}}, {"name": "right"}],
            "boundaries": [{"between": [None, "left"], "level_native": 170,
                            "placed_by": "image"}]}})
        self.assertEqual([name for name, _ in found], ["left", "right"])
        self.assertEqual(found[0][1], {"volume": 2.0, "area": None, "parts": 2.0, "level": 170.0,
                                       "error": 0.2, "seconds": 3.0})
        self.assertIsNone(found[1][1]["seconds"])

    def test_links_are_safe(self):
        folder = self.folder / "runs" / "a"
        folder.mkdir(parents=True)
        (folder / "surface-\"x' #%ä.stl").write_text("")
        links = table._links(folder, "a")
        self.assertIn('href="runs/a/surface-%22x%27%20%23%25%C3%A4.stl"', links)
        self.assertNotIn("\"x'", links)

    @unittest.skipUnless(shutil.which("chromium-headless-shell"), "needs chromium-headless-shell")
    def test_a_browser_sorts_it(self):
        page = self.fill([3000, None, 1000, 10000])
        click = "<script>document.querySelectorAll('thead button')[2].click()</script>"
        path = self.folder / "clicked.html"
        for clicks, order, sort in ((1, ["s2", "s0", "s3", "s1"], "ascending"),
                                    (2, ["s3", "s0", "s2", "s1"], "descending")):
            path.write_text(page.replace("</body>", click * clicks + "</body>"), encoding="utf-8")
            dom = subprocess.run(["chromium-headless-shell", "--headless", "--no-sandbox",
                                  "--dump-dom", path.as_uri()], capture_output=True, text=True,
                                 check=True, timeout=60).stdout
            self.assertEqual(re.findall(r'<th scope="row" data-v="(\w+)"', dom), order)
            self.assertIn(f'aria-sort="{sort}"', dom)

    def test_numbers_have_four_digits(self):
        for value, text in ((0, "0"), (12, "12"), (12.345, "12.35"), (0.012345, "0.01235"),
                            (-3.14159, "-3.142"), (123456.7, "123457"), (1e-9, "1.000e-09"),
                            (None, "")):
            self.assertEqual(table.number(value), text)
        self.assertTrue(math.isfinite(float(table.number(2.5e20))))


class Slurm(InFolder):
    def test_memory_time_and_threads_go_to_sbatch(self):
        script = self.folder / "job.sh"
        job = {"rule": "segment", "wildcards": {"sample": "a"}, "threads": 2,
               "resources": {"mem_mb": 700, "runtime": 45}}
        script.write_text(f"#!/bin/sh\n# properties = {json.dumps(job)}\n")
        submit = profile_module("submit")
        command = submit.sbatch_command(submit.properties_of(script), str(script), "logs")
        for word in ("--parsable", "--mem=700M", "--time=45", "--cpus-per-task=2",
                     "--job-name=mesamis-segment-a"):
            self.assertIn(word, command)
        self.assertEqual(command[-1], str(script))
        script.write_text("#!/bin/sh\n")
        self.assertRaises(SystemExit, submit.properties_of, script)

    def test_states_of_slurm_are_understood(self):
        verdict = profile_module("status").verdict
        for state, meaning in (("COMPLETED", "success"), ("PENDING", "running"),
                               ("RUNNING", "running"), ("COMPLETING", "running"),
                               ("CANCELLED by 0", "failed"), ("OUT_OF_MEMORY", "failed"),
                               ("TIMEOUT", "failed"), ("NODE_FAIL", "failed"), ("", "failed")):
            self.assertEqual(verdict(state), meaning)


if __name__ == "__main__":
    main()
