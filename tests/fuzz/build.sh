#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the fuzz targets into $OUT, each with its dictionary (NAME.dict) and its seeds
# (NAME_seed_corpus.zip), as OSS-Fuzz wants them.
#
#   CC CXX CFLAGS CXXFLAGS LIB_FUZZING_ENGINE   of OSS-Fuzz: used as they are; all needed libraries
#       with a C++ interface must be there for the same standard library
#   none of them                                the preset "fuzz": clang and libFuzzer of the system
#   OUT    where the targets go                 (default: build/fuzz/out)
#   WORK   where they are built, for OSS-Fuzz   (default: build/oss-fuzz)
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

jobs=${MESAMIS_JOBS:-$(nproc)}
OUT=${OUT:-$PWD/build/fuzz/out}
read -ra cmake_args <<<"${MESAMIS_CMAKE_ARGS:-}"

if [ -n "${LIB_FUZZING_ENGINE:-}" ]; then
  build=${WORK:-$PWD/build/oss-fuzz}
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=None -DMESAMIS_FUZZ=ON -DMESAMIS_BUILD_TESTS=OFF \
    -DMESAMIS_BUILD_EXAMPLES=OFF -DMESAMIS_FUZZ_ENGINE="$LIB_FUZZING_ENGINE" "${cmake_args[@]}"
else
  build=build/fuzz
  cmake --preset fuzz "${cmake_args[@]}"
fi
cmake --build "$build" -j "$jobs"

programs=$build/tests/fuzz
seeds=$build/seeds
mkdir -p "$OUT/lib"
rm -rf "$seeds"
ASAN_OPTIONS=detect_leaks=0 "$programs/fuzz_seeds" "$seeds"  # lib3mf, which writes, leaks
"$programs/fuzz_options" --dictionary | cat tests/fuzz/dictionaries/options.dict - >"$build/options.dict"

# What the targets link and a bare system lacks; they look for it in lib/ beside them.
for program in readers options remesh; do
  ldd "$programs/fuzz_$program" | awk '$3 ~ /^\// { print $3 }'
done | sort -u | grep -vE '/lib(c|m|dl|rt|pthread|gcc_s|resolv|stdc\+\+)\.so' | xargs -r cp -Lu -t "$OUT/lib"

dictionary_of() {  # dictionary_of TARGET: that of the target's format
  case $1 in
    fuzz_options_*) echo "$build/options.dict" ;;
    fuzz_label_dicom | fuzz_label_contours | fuzz_encapsulated) echo tests/fuzz/dictionaries/dicom.dict ;;
    fuzz_label_nrrd | fuzz_label_masks) echo tests/fuzz/dictionaries/nrrd.dict ;;
    fuzz_label_nifti) echo tests/fuzz/dictionaries/nifti.dict ;;
    fuzz_vtu) echo tests/fuzz/dictionaries/vtp.dict ;;
    fuzz_threemf_model | fuzz_threemf_parts) echo tests/fuzz/dictionaries/threemf.dict ;;
    fuzz_sol) echo tests/fuzz/dictionaries/mesh.dict ;;
    *) echo "tests/fuzz/dictionaries/${1#fuzz_}.dict" ;;
  esac
}

add_target() {  # add_target PROGRAM NAME: the same program by another name
  local target=$OUT/$2 dictionary
  ln -f "$programs/$1" "$target" 2>/dev/null || cp -f "$programs/$1" "$target"
  dictionary=$(dictionary_of "$2")
  [ ! -f "$dictionary" ] || cp "$dictionary" "$target.dict"
  rm -f "${target}_seed_corpus.zip"
  [ ! -d "$seeds/$2" ] || zip -qjr "${target}_seed_corpus.zip" "$seeds/$2"
}

for program in fuzz_readers fuzz_options; do
  for target in $("$programs/$program" --list); do
    add_target "$program" "$target"
  done
done
add_target fuzz_remesh fuzz_remesh
