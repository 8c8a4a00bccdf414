# SPDX-License-Identifier: Apache-2.0
# The module in C++ is not for use by itself: its names are not described.
from typing import Any

def __getattr__(name: str) -> Any: ...
