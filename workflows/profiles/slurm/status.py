#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Prints running, success or failed for the number of a Slurm job.

scontrol knows jobs that run or have just ended; older ones only sacct does, where it keeps books.
"""
import re
import subprocess
import sys
import time

GOING = ("PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED", "RESIZING",
         "STAGE_OUT", "SIGNALING", "STOPPED", "SPECIAL_EXIT", "REQUEUE_HOLD", "REQUEUE_FED",
         "RESV_DEL_HOLD")


def answer(command):
    try:
        done = subprocess.run(command, text=True, capture_output=True, check=False)
    except OSError:
        return "", "not found"
    return done.stdout if done.returncode == 0 else "", done.stderr


def verdict(state):
    """What Snakemake wants to hear of a state of Slurm, such as "CANCELLED by 0"."""
    word = state.split()[0].rstrip("+") if state.split() else ""
    if word == "COMPLETED":
        return "success"
    return "running" if word in GOING else "failed"


def state_of(job):
    """The state of a job; "" where nobody knows the job; None where nobody answers."""
    out, error = answer(["scontrol", "show", "job", "-o", job])
    found = re.search(r"\bJobState=(\S+)", out)
    if found:
        return found[1]
    out, _ = answer(["sacct", "-j", job, "-X", "-n", "-P", "-o", "State"])
    if out.strip():
        return out.strip().splitlines()[-1]
    return "" if "Invalid job id" in error else None


def main(job, tries=3):
    for n in range(tries):
        state = state_of(job)
        if state:
            return verdict(state)
        if n + 1 < tries:
            time.sleep(2)
    return "running" if state is None else "failed"  # a controller that is away comes back


if __name__ == "__main__":
    print(main(sys.argv[1]))
