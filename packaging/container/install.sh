#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The steps of both containers, in a Debian 12 that holds nothing else: the wheel beside this script,
# in an environment of its own.
set -eu
here=$(dirname "$(readlink -f "$0")")
export DEBIAN_FRONTEND=noninteractive
apt-get update --quiet
apt-get install --yes --quiet --no-install-recommends python3 python3-venv ca-certificates
python3 -m venv /opt/mesamis
/opt/mesamis/bin/pip install --no-cache-dir "$here"/mesamis-*-cp311-*.whl
ln -s /opt/mesamis/bin/mesamis /usr/local/bin/mesamis
apt-get clean
rm -rf /var/lib/apt/lists/*
mesamis --version
/opt/mesamis/bin/python -c 'import mesamis'
