#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes an SPDX 2.3 list of what is in the tar, or in the Debian packages, as JSON.

  spdx.py tar --prefix FOLDER --name NAME --version VERSION --out FILE
  spdx.py debian --version VERSION --out FILE PACKAGE.deb...

The date is SOURCE_DATE_EPOCH, the name space a hash of the content: the same files, the same list."""

import argparse
import datetime
import hashlib
import json
import os
import re
import subprocess

import licences

OURS = "Apache-2.0"


def spdx_id(*parts):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", "-".join(parts))


def digest(path, name):
    with open(path, "rb") as file:
        return hashlib.new(name, file.read()).hexdigest()


def checksums(path, *names):
    return [{"algorithm": name.upper(), "checksumValue": digest(path, name)} for name in names]


def installed_version(package):
    answer = subprocess.run(["dpkg-query", "--show", "--showformat=${Version}", package],
                            capture_output=True, text=True)
    return answer.stdout or "NOASSERTION"


def package_entry(name, version, licence, supplier, **more):
    return {"SPDXID": spdx_id("Package", name), "name": name, "versionInfo": version, "supplier": supplier,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": licence,
            "licenseDeclared": licence, "copyrightText": "NOASSERTION", **more}


def debian_entry(name, licence):
    version = installed_version(name)
    purl = {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
            "referenceLocator": f"pkg:deb/debian/{name}@{version.replace('+', '%2B')}"}
    return package_entry(name, version, licence, "Organization: Debian", externalRefs=[purl])


def our_entry(name, version, **more):
    return package_entry(name, version, OURS, "Organization: The mesamis developers", **more)


def relation(one, kind, other):
    return {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other}


def document(name, packages, files, relations, described):
    """The name space is unique, as it must be, and the same for the same content."""
    content = hashlib.sha256(json.dumps([packages, files, relations], sort_keys=True).encode()).hexdigest()
    created = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": name,
            "documentNamespace": f"https://spdx.org/spdxdocs/{name}-{content[:32]}",
            "creationInfo": {"created": created.strftime("%Y-%m-%dT%H:%M:%SZ"),
                             "creators": ["Tool: mesamis-packaging", "Organization: The mesamis developers"]},
            "packages": packages, "files": files,
            "relationships": [relation("SPDXRef-DOCUMENT", "DESCRIBES", one) for one in described] + relations}


def owner_of(path, prefix):
    """The Debian package of a file in the tar, told by the file of the same name on this system."""
    name = os.path.basename(path)
    if not path.startswith(f"{prefix}/lib/mesamis") or name in licences.STAND_INS:
        return None
    answer = subprocess.run(["dpkg-query", "--search", f"*/{name}"], capture_output=True, text=True).stdout
    owners = {line.split(":")[0] for line in answer.splitlines()} & licences.LIBRARIES.keys()
    return min(owners)


def file_entry(path, prefix, licence):
    name = "./" + os.path.relpath(path, prefix)
    return {"SPDXID": spdx_id("File", name[2:].replace("+", "-plus-").replace("_", "-underscore-")),
            "fileName": name, "checksums": checksums(path, "sha1", "sha256"), "licenseConcluded": licence,
            "licenseInfoInFiles": ["NOASSERTION"], "copyrightText": "NOASSERTION"}


def files_of(prefix):
    return sorted(os.path.join(folder, name) for folder, _, names in os.walk(prefix) for name in names)


def tar_document(arguments):
    main = our_entry("mesamis", arguments.version)
    packages, files, relations = {"mesamis": main}, [], []
    for path in files_of(arguments.prefix):
        owner = owner_of(path, arguments.prefix)
        if path.startswith(f"{arguments.prefix}/share/doc/mesamis/licences/"):
            licence = "NOASSERTION"  # the text of a licence
        else:
            licence = licences.LIBRARIES[owner] if owner else OURS
        entry = file_entry(path, arguments.prefix, licence)
        files.append(entry)
        if owner and owner not in packages:
            packages[owner] = debian_entry(owner, licence)
            relations.append(relation(main["SPDXID"], "DYNAMIC_LINK", packages[owner]["SPDXID"]))
        relations.append(relation(packages[owner or "mesamis"]["SPDXID"], "CONTAINS", entry["SPDXID"]))
    for name, licence in licences.compiled_into("mesamis").items():
        packages[name] = debian_entry(name, licence)
        relations.append(relation(main["SPDXID"], "STATIC_LINK", packages[name]["SPDXID"]))
    return document(arguments.name, list(packages.values()), files, relations, [main["SPDXID"]])


def deb_field(deb, field):
    answer = subprocess.run(["dpkg-deb", "--field", deb, field], check=True, capture_output=True, text=True)
    return answer.stdout.strip()


def dependencies(deb):
    """Names alone; of alternatives the first."""
    parts = (part for part in deb_field(deb, "Depends").split(",") if part.strip())
    return sorted({re.match(r"\s*([a-z0-9.+-]+)", part)[1] for part in parts})


def debian_document(arguments):
    packages, relations, described = {}, [], []
    for deb in sorted(arguments.packages):
        name = deb_field(deb, "Package")
        packages[name] = our_entry(name, deb_field(deb, "Version"), packageFileName=os.path.basename(deb),
                                   checksums=checksums(deb, "sha256"))
        described.append(packages[name]["SPDXID"])
    for deb in sorted(arguments.packages):
        name = deb_field(deb, "Package")
        wanted = [(other, "DEPENDS_ON", licences.LIBRARIES.get(other, "NOASSERTION"))
                  for other in dependencies(deb)]
        wanted += [(other, "STATIC_LINK", licence) for other, licence in licences.compiled_into(name).items()]
        for other, kind, licence in wanted:
            packages.setdefault(other, debian_entry(other, licence))
            relations.append(relation(packages[name]["SPDXID"], kind, packages[other]["SPDXID"]))
    name = f"mesamis-{arguments.version}-debian"
    return document(name, list(packages.values()), [], relations, described)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    kinds = parser.add_subparsers(dest="kind", required=True)
    tar, debian = kinds.add_parser("tar"), kinds.add_parser("debian")
    for one in (tar, debian):
        one.add_argument("--version", required=True)
        one.add_argument("--out", required=True)
    tar.add_argument("--prefix", required=True)
    tar.add_argument("--name", required=True)
    debian.add_argument("packages", nargs="+")
    arguments = parser.parse_args()
    made = tar_document(arguments) if arguments.kind == "tar" else debian_document(arguments)
    with open(arguments.out, "w", encoding="utf-8") as file:
        json.dump(made, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
