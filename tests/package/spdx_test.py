#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the SPDX lists beside the packages: well-formed, complete, and true to the files.

  spdx_test.py FOLDER        the folder of scripts/package"""

import glob
import hashlib
import json
import re
import sys
import tarfile

# The identifiers of the SPDX licence list that we use; a new one is looked up there before it is added.
LICENCES = {"0BSD", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "Beerware", "FTL", "GPL-3.0-or-later", "IJG", "ISC",
            "Bitstream-Vera", "MIT", "MPL-2.0", "X11", "Zlib", "bzip2-1.0.6", "libpng-2.0", "libtiff"}
EXCEPTIONS = {"GCC-exception-3.1"}
KINDS = {"DESCRIBES", "CONTAINS", "DYNAMIC_LINK", "STATIC_LINK", "DEPENDS_ON"}
IDENTIFIER = re.compile(r"SPDXRef-[A-Za-z0-9.-]+")

faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def is_licence(text):
    """NAME [WITH EXCEPTION] joined by AND: all that our lists use of the grammar."""
    if text == "NOASSERTION":
        return True
    for part in text.split(" AND "):
        name, _, exception = part.partition(" WITH ")
        if name not in LICENCES or (exception and exception not in EXCEPTIONS):
            return False
        if name.startswith("GPL") and not exception:
            return False
    return True


def check_head(document):
    expect(document["spdxVersion"] == "SPDX-2.3", "spdxVersion")
    expect(document["dataLicense"] == "CC0-1.0", "dataLicense")
    expect(document["SPDXID"] == "SPDXRef-DOCUMENT", "SPDXID of the document")
    expect(re.fullmatch(r"https://\S+", document["documentNamespace"]) and "#" not in document["documentNamespace"],
           "documentNamespace")
    created = document["creationInfo"]["created"]
    expect(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", created), f"created: {created}")
    for creator in document["creationInfo"]["creators"]:
        expect(re.match(r"(Person|Organization|Tool): \S", creator), f"creator: {creator}")


def check_packages(document):
    for package in document["packages"]:
        name = package["name"]
        for field in ("SPDXID", "downloadLocation", "versionInfo", "licenseConcluded", "licenseDeclared",
                      "copyrightText"):
            expect(package.get(field), f"{name}: no {field}")
        expect(package["filesAnalyzed"] is False, f"{name}: files are not analysed, and it does not say so")
        expect(is_licence(package["licenseConcluded"]), f"{name}: licence {package['licenseConcluded']}")
        for one in package.get("checksums", []):
            check_checksum(name, one)


def check_checksum(name, checksum):
    length = {"SHA1": 40, "SHA256": 64}.get(checksum["algorithm"], 0)
    expect(re.fullmatch(f"[0-9a-f]{{{length}}}", checksum["checksumValue"]), f"{name}: checksum")


def check_relationships(document):
    elements = [document["SPDXID"]] + [one["SPDXID"] for one in document["packages"] + document["files"]]
    expect(len(elements) == len(set(elements)), "an SPDXID stands for two elements")
    for element in elements:
        expect(IDENTIFIER.fullmatch(element), f"SPDXID: {element}")
    described = 0
    for one in document["relationships"]:
        expect(one["relationshipType"] in KINDS, f"relationship {one['relationshipType']}")
        expect(one["spdxElementId"] in elements and one["relatedSpdxElement"] in elements, f"loose end: {one}")
        described += one["relationshipType"] == "DESCRIBES"
    expect(described > 0, "nothing is described")


def check_tar(document, path):
    """Every file of the tar is in the list, with its hash; and no other."""
    listed = {one["fileName"]: one for one in document["files"]}
    with tarfile.open(path) as tar:
        for member in tar:
            if not member.isfile():
                continue
            entry = listed.pop("./" + member.name.split("/", 1)[1], None)
            expect(entry, f"{member.name}: not in the list")
            if entry:
                found = hashlib.sha256(tar.extractfile(member).read()).hexdigest()
                expect({"algorithm": "SHA256", "checksumValue": found} in entry["checksums"], f"{member.name}: hash")
                expect(is_licence(entry["licenseConcluded"]), f"{member.name}: licence")
    expect(not listed, f"listed, and not in the tar: {list(listed)}")
    contained = [one["relatedSpdxElement"] for one in document["relationships"] if one["relationshipType"] == "CONTAINS"]
    expect(sorted(contained) == sorted(one["SPDXID"] for one in document["files"]), "files without a package")


def check_debs(document, folder):
    named = {one["packageFileName"]: one for one in document["packages"] if "packageFileName" in one}
    debs = glob.glob("*.deb", root_dir=folder)
    expect(sorted(named) == sorted(debs), f"packages listed: {sorted(named)}, found: {sorted(debs)}")
    for name, package in named.items():
        with open(f"{folder}/{name}", "rb") as file:
            found = hashlib.sha256(file.read()).hexdigest()
        expect(package["checksums"][0]["checksumValue"] == found, f"{name}: hash")


def main(folder):
    lists = sorted(glob.glob(f"{folder}/*.spdx.json"))
    expect(len(lists) == 2, f"expected two lists, found {lists}")
    for path in lists:
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
        check_head(document)
        check_packages(document)
        check_relationships(document)
        if path.endswith("-debian.spdx.json"):
            check_debs(document, folder)
        else:
            check_tar(document, path.replace(".spdx.json", ".tar.xz"))
    print("\n".join(faults) or f"{len(lists)} lists are well-formed and true")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
