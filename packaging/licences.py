# SPDX-License-Identifier: Apache-2.0
"""The licences of what the tar and the packages hold beside our own files, as SPDX expressions.

Keys are Debian 12's binary packages. A library that is not here is not bundled: read its copyright
file first. Nothing under the GPL may come in without an exception for linking."""

import sys

LIBRARIES = {
    "lib3mf1": "BSD-2-Clause",
    "libaec0": "BSD-2-Clause",
    "libblosc1": "BSD-3-Clause AND MIT AND Zlib",
    "libbrotli1": "MIT",
    "libbz2-1.0": "bzip2-1.0.6",
    "libcharls2": "BSD-3-Clause",
    "libdeflate0": "MIT",
    "libexpat1": "MIT",
    "libfmt9": "MIT",
    "libgcc-s1": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "libgdcm3.0": "BSD-3-Clause",
    "libhdf5-103-1": "BSD-3-Clause",
    "libjpeg62-turbo": "IJG AND BSD-3-Clause AND Zlib",
    "libjson-c5": "MIT",
    "liblerc4": "Apache-2.0",
    "liblz4-1": "BSD-2-Clause",
    "liblzma5": "0BSD",
    "libopenjp2-7": "BSD-2-Clause",
    "libopenmesh1": "BSD-3-Clause",
    "libsnappy1v5": "BSD-3-Clause",
    "libspdlog1.10": "MIT",
    "libssl3": "Apache-2.0",
    "libstdc++6": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "libsz2": "BSD-2-Clause",
    "libtbb12": "Apache-2.0",
    "libtiff6": "libtiff",
    "libuuid1": "BSD-3-Clause",
    "libwebp7": "BSD-3-Clause",
    "libzip4": "BSD-3-Clause",
    "libzstd1": "BSD-3-Clause",
    "zlib1g": "Zlib",
}

# Libraries that are not brought: sources of what stands in their place, and versions of its symbols.
STAND_INS = {"libjbig.so.0": ("jbig_absent.c", None), "libcurl.so.4": ("curl_absent.c", "curl_absent.map")}

# Headers that are compiled into our files. The last column: what of ours holds them.
HEADERS = {
    "libcli11-dev": ("BSD-3-Clause", ("mesamis",)),
    "libeigen3-dev": ("MPL-2.0", ("mesamis", "libmesamis-dev", "python3-mesamis")),
    "fonts-dejavu-core": ("Bitstream-Vera", ("mesamis", "libmesamis-dev")),
    "libopenmesh-dev": ("BSD-3-Clause", ("mesamis", "libmesamis-dev", "python3-mesamis")),
    "libstb-dev": ("MIT", ("mesamis", "libmesamis-dev")),
    "nlohmann-json3-dev": ("MIT", ("mesamis", "libmesamis-dev", "python3-mesamis")),
    "pybind11-dev": ("BSD-3-Clause", ("python3-mesamis",)),
}


def require_known(library, package):
    """Ends the script if the package of a library that would be brought has no licence above."""
    if package not in LIBRARIES:
        sys.exit(f"packaging: error: {library} of {package}: expected a licence in packaging/licences.py, found none")


def compiled_into(*ours):
    """The packages whose headers any of our packages holds, with their licences."""
    return {name: licence for name, (licence, holders) in HEADERS.items() if set(ours) & set(holders)}
