# SPDX-License-Identifier: Apache-2.0
"""The workflow under a real Slurm of one node, whose daemons the test starts and ends."""
import json
import os
import secrets
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from support import PROGRAM, WORKFLOWS, main, make_scans, run_workflow, write_program

MPI_PROGRAM = os.environ.get("MESAMIS_MPI_PROGRAM", "")
NAMES = ["a", "b", "c", "d", "broken"]
CONFIG = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/builtin
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MailProg=/bin/true
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=2000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Slurm:
    """munged, slurmctld and slurmd with all their files in a folder of their own."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        for name in ("state", "spool"):
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o400)
        host = socket.gethostname().split(".")[0]
        (folder / "slurm.conf").write_text(
            CONFIG.format(host=host, folder=folder, ports=free_ports(2)))
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}

    def start(self):
        self._daemon("munged", "--force", "--foreground", f"--key-file={self.folder}/munge.key",
                     *(f"--{kind}={self.folder}/munge.{kind.split('-')[0]}"
                       for kind in ("socket", "pid-file", "log-file", "seed-file")))
        self._daemon("slurmctld", "-D")
        self._daemon("slurmd", "-D")
        return self._is_idle()

    def _daemon(self, *command):
        with open(self.folder / f"{command[0]}.out", "w") as log:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=log,
                                                 stderr=subprocess.STDOUT,
                                                 stdin=subprocess.DEVNULL))

    def _is_idle(self, seconds=30):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            done = subprocess.run(["sinfo", "--noheader", "--format=%T"], env=self.environment,
                                  capture_output=True, text=True, check=False)
            if done.stdout.strip() == "idle":
                return True
            if any(d.poll() is not None for d in self.daemons):
                return False
            time.sleep(0.3)
        return False

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def what_was_said(self):
        return "\n".join(p.read_text(errors="replace")[-1500:]
                         for p in sorted(self.folder.glob("*.out")))


class OnSlurm(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.folder = Path(keep.name)
        place = self.folder / "slurm"
        place.mkdir(mode=0o755)
        self.slurm = Slurm(place)
        self.addCleanup(self.slurm.stop)
        if not self.slurm.start():
            self.skipTest("no Slurm can be started here: " + self.slurm.what_was_said())

    def test_each_scan_is_a_job_with_the_memory_that_it_needs(self):
        make_scans(self.folder, NAMES)
        calls, program = self.folder / "calls", self.folder / "program"
        # Writes down what Slurm gave to each run. The first try of one is cancelled from outside.
        write_program(program, f"""case "$*" in *"segment --log-json"*)
echo "$SLURM_JOB_ID|$SLURM_JOB_NAME|$SLURM_MEM_PER_NODE|$*" >> '{calls}'
case "$*" in *d.nrrd*) [ -e '{self.folder}/cancelled' ] ||
{{ touch '{self.folder}/cancelled'; scancel "$SLURM_JOB_ID"; exec sleep 300; }};; esac;; esac""")
        (self.folder / "config.yaml").write_text(json.dumps(
            {"program": str(program), "options": "--preview", "html": False,
             "thumbnails": False}))
        status, said = run_workflow(self.folder, "--profile", str(WORKFLOWS / "profiles/slurm"),
                                    "--latency-wait", "5", env=self.slurm.environment)
        self.assertEqual(status, 1, said)
        self.assertIn("1 of 5 scans failed:\nbroken: status 3", said)
        self.assertIn("5 scans: 4 done", (self.folder / "results/table.html").read_text())
        runs = [line.split("|") for line in calls.read_text().splitlines()]
        self.assertEqual(sorted(name for _, name, _, _ in runs),
                         sorted(f"mesamis-segment-{name}" for name in [*NAMES, "d"]))
        self.assertEqual(len({number for number, *_ in runs}), 6)
        tries = []
        for number, name, memory, words in runs:
            sample = name.split("-")[-1]
            plan = json.loads((self.folder / f"results/runs/{sample}/plan.json").read_text())
            tries += [round(int(memory) / (1.25 * plan["memory_mb"]))] if sample == "d" else []
            if sample != "d":
                self.assertEqual(int(memory), int(1.25 * plan["memory_mb"]) + 1)
            self.assertIn(f"--memory={int(memory) / 1000:g} ", words)
            self.assertTrue(list(self.folder.glob(f".snakemake/slurm/{name}-{number}.log")))
        self.assertEqual(tries, [1, 2])  # the second try asks for twice as much
        states = subprocess.run(["scontrol", "show", "job", "-o"], env=self.slurm.environment,
                                capture_output=True, text=True, check=True).stdout
        self.assertEqual(states.count("JobState=COMPLETED"), 5)
        self.assertEqual(states.count("JobState=CANCELLED"), 1)
        self.assertIn(f"MinMemoryNode={runs[0][2]}M", states)
        self.assertIn("TimeLimit=00:30:00", states)

    @unittest.skipUnless(MPI_PROGRAM and shutil.which("mpirun"), "mesamis-mpi or mpirun is missing")
    def test_processes_of_a_job_share_a_run(self):
        subprocess.run([PROGRAM, "phantom", "sphere", "--size=32,32,128", "--quiet",
                        f"--output={self.folder}/a.nrrd"], check=True, stdout=subprocess.DEVNULL)
        options = "segment a.nrrd --slabs 2 --max-tets 8000 --quiet"
        subprocess.run(f"{PROGRAM} {options} -o alone.stl", shell=True, check=True, cwd=self.folder)
        job = (f"mpirun --allow-run-as-root --oversubscribe -np 2 {MPI_PROGRAM} {options} "
               "-o together.stl --report together.json")
        subprocess.run(["sbatch", "--wait", "--ntasks=2", "--mem=1500", "--output=job.out",
                        f"--wrap={job}"], env=self.slurm.environment, cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL)
        self.assertEqual((self.folder / "together.stl").read_bytes(),
                         (self.folder / "alone.stl").read_bytes())
        report = json.loads((self.folder / "together.json").read_text())
        self.assertEqual((report["slabs"]["count"], report["slabs"]["processes"]), (2, 2))


if __name__ == "__main__":
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    main("snakemake", "munged", "slurmctld", "slurmd", "sbatch", PROGRAM,
         also="" if os.getuid() == 0 else "Slurm's daemons are started by root alone")
