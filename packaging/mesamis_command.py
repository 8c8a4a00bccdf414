#!python
# SPDX-License-Identifier: Apache-2.0
"""The command `mesamis` of the wheel: becomes the program that lies in the package."""
import importlib.util
import os
import sys

package = os.path.dirname(importlib.util.find_spec("mesamis").origin)
os.execv(os.path.join(package, "bin", "mesamis"), sys.argv)
