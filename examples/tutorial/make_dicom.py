#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a phantom as a folder of CT slices in DICOM, without other libraries: input for docs/tutorial.md.

    mesamis phantom hemipelvis --size 102,122,152 --spacing 2,2,2 --noise 5 --type short -o hip.nrrd
    examples/tutorial/make_dicom.py hip.nrrd FOLDER

Grey values become HU: 120, the surroundings of a phantom, is 0 HU, and each further grey value 10 HU more.
"""
import pathlib
import re
import struct
import sys

CT_IMAGE, EXPLICIT_LITTLE = "1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.1.2.1"
SERIES = "2.25.4711"  # and below it the slices


def element(group, number, vr, value):
    """A data element in explicit VR, little endian, of even length."""
    if isinstance(value, str):
        value = value.encode()
    if len(value) % 2:
        value += b"\0" if vr in ("UI", "OB") else b" "
    long = vr in ("OB", "OW")
    length = struct.pack("<HI", 0, len(value)) if long else struct.pack("<H", len(value))
    return struct.pack("<HH", group, number) + vr.encode() + length + value


def us(number):
    return struct.pack("<H", number)


def read_nrrd(path):
    """Sizes, spacing and origin along x, y, z, and the samples, of a phantom with --type short."""
    header, samples = path.read_bytes().split(b"\n\n", 1)
    text = header.decode()
    field = dict(re.findall(r"^([\w ]+):=? ?(.*)$", text, re.M))
    if field.get("type") not in ("short", "int16") or field.get("encoding") != "raw":
        sys.exit("make_dicom: expected a phantom made with --type short")
    vectors = [[float(x) for x in v.split(",")] for v in re.findall(r"\(([^)]*)\)", field["space directions"])]
    origin = [float(x) for x in field["space origin"].strip("()").split(",")]
    return [int(n) for n in field["sizes"].split()], [vectors[a][a] for a in range(3)], origin, samples


def slice_file(k, size, spacing, origin, pixels):
    """The bytes of slice k."""
    uid = f"{SERIES}.{k + 1}"
    place = "\\".join(f"{x:g}" for x in (origin[0], origin[1], origin[2] + k * spacing[2]))
    meta = (element(2, 2, "UI", CT_IMAGE) + element(2, 3, "UI", uid) + element(2, 0x10, "UI", EXPLICIT_LITTLE))
    meta = element(2, 0, "UL", struct.pack("<I", len(meta))) + meta
    data = (element(8, 0x16, "UI", CT_IMAGE) + element(8, 0x18, "UI", uid) + element(8, 0x60, "CS", "CT")
            + element(8, 0x103E, "LO", "Phantom of a hip bone") + element(0x10, 0x10, "PN", "Phantom")
            + element(0x18, 0x50, "DS", f"{spacing[2]:g}") + element(0x20, 0xD, "UI", "2.25.4710")
            + element(0x20, 0xE, "UI", SERIES) + element(0x20, 0x13, "IS", str(k + 1))
            + element(0x20, 0x32, "DS", place) + element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0")
            + element(0x28, 2, "US", us(1)) + element(0x28, 4, "CS", "MONOCHROME2")
            + element(0x28, 0x10, "US", us(size[1])) + element(0x28, 0x11, "US", us(size[0]))
            + element(0x28, 0x30, "DS", f"{spacing[1]:g}\\{spacing[0]:g}")
            + element(0x28, 0x100, "US", us(16)) + element(0x28, 0x101, "US", us(16))
            + element(0x28, 0x102, "US", us(15)) + element(0x28, 0x103, "US", us(1))
            + element(0x28, 0x1052, "DS", "-1200") + element(0x28, 0x1053, "DS", "10")
            + element(0x7FE0, 0x10, "OW", pixels))
    return bytes(128) + b"DICM" + meta + data


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    size, spacing, origin, samples = read_nrrd(pathlib.Path(sys.argv[1]))
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    plane = 2 * size[0] * size[1]
    for k in range(size[2]):
        (folder / f"{k + 1:04}.dcm").write_bytes(
            slice_file(k, size, spacing, origin, samples[k * plane:(k + 1) * plane]))


if __name__ == "__main__":
    main()
