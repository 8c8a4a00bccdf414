#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Hands a job script of Snakemake to sbatch and prints the number of the job.

Memory, time and processors are those of the rule. What else sbatch should know comes from its own
variables (SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_QOS, ...).
"""
import json
import os
import subprocess
import sys


def properties_of(script):
    """What Snakemake has written into the job script about the job."""
    with open(script, encoding="utf-8") as file:
        for line in file:
            if line.startswith("# properties = "):
                return json.loads(line[len("# properties = "):])
    raise SystemExit(f"submit.py: {script}: expected a line of properties, found none")


def sbatch_command(job, script, logs):
    resources, wildcards = job.get("resources", {}), job.get("wildcards", {})
    name = "-".join(["mesamis", job.get("rule", "job"), *wildcards.values()])
    command = ["sbatch", "--parsable", f"--job-name={name}", "--no-requeue",
               f"--output={os.path.join(logs, name)}-%j.log",
               f"--cpus-per-task={job.get('threads', 1)}"]
    if "mem_mb" in resources:
        command.append(f"--mem={resources['mem_mb']}M")
    if "runtime" in resources:
        command.append(f"--time={resources['runtime']}")
    return [*command, script]


def main():
    script, logs = sys.argv[-1], os.path.join(".snakemake", "slurm")
    os.makedirs(logs, exist_ok=True)
    done = subprocess.run(sbatch_command(properties_of(script), script, logs), text=True,
                          stdout=subprocess.PIPE, check=False)
    if done.returncode == 0:
        print(done.stdout.strip().split(";")[0])  # NUMBER or NUMBER;CLUSTER
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
