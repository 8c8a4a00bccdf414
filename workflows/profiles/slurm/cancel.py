#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Cancels Slurm jobs by their numbers."""
import subprocess
import sys

if __name__ == "__main__":
    sys.exit(subprocess.run(["scancel", *sys.argv[1:]], check=False).returncode)
