#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Checks who includes whom, by the table scripts/rooms.txt: see "The libraries" in CONTRIBUTING.md.
# usage: scripts/check_dependencies.sh
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
no_more_options "$@"
table=scripts/rooms.txt
failed=0

complain() {
  printf '%s\n' "$*" >&2
  failed=1
}

# has WORD LIST...: whether the word is one of the list.
has() {
  local word=$1 item
  shift
  for item in "$@"; do [[ $item != "$word" ]] || return 0; done
  return 1
}

# The table. What a library or a room may include is kept with spaces around, so that " name " finds a whole name.
libraries=()
declare -A below=()      # of a library; of a room under "library room"
declare -A header_room=() # of the public header "library/header.h"
while read -r kind library room names; do
  case $kind in
    '' | '#'*) ;;
    library)
      for name in $room $names; do
        has "$name" "${libraries[@]}" || complain "$table: lib$library would include lib$name, which no line above it defines"
      done
      libraries+=("$library")
      below[$library]=" $room $names "
      ;;
    room)
      [[ -n ${below[$library]+defined} ]] || complain "$table: a room of lib$library, which no line above it defines"
      for name in $names; do
        [[ -n ${below[$library $name]+defined} ]] ||
          complain "$table: room $room of lib$library would include room $name, which no line above it defines: a circle or a mistake"
      done
      below[$library $room]=" $names "
      ;;
    header)
      [[ -n ${below[$library $room]+defined} ]] || complain "$table: headers of room $room of lib$library, which no line above it defines"
      for name in $names; do
        header_room[$library/$name.h]=$room
        [[ -e lib$library/include/$library/$name.h ]] || complain "$table: there is no public header $library/$name.h"
      done
      ;;
    *) complain "$table: not understood: $kind $library $room $names" ;;
  esac
done <"$table"

# includes FOLDER...: "file:what it includes" of every #include of the sources in the folders that are there.
includes() {
  local folder folders=()
  for folder in "$@"; do [[ ! -d $folder ]] || folders+=("$folder"); done
  [[ ${#folders[@]} -gt 0 ]] || return 0
  { grep -rE --include='*.h' --include='*.cpp' '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]' "${folders[@]}" || true; } |
    sed -E 's/^([^:]*):[^<"]*[<"]([^>"]*)[>"].*/\1:\2/'
}

# quoted_includes FOLDER: of these what stands in quotes.
quoted_includes() {
  { grep -rE --include='*.h' --include='*.cpp' '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' "$1" || true; } |
    sed -E 's/^([^:]*):[^"]*"([^"]*)".*/\1:\2/'
}

# room_of PATH: sets `room` to the folder of a path that begins in src.
room_of() {
  if [[ $1 == */* ]]; then room=${1%/*}; else room=src; fi
}

# Rooms of libraries that have any: the folders are in the table, and each public header has one.
with_rooms=()
for library in "${libraries[@]}"; do
  [[ -n ${below[$library src]+defined} ]] || continue
  with_rooms+=("$library")
  declare -A rooms_with=()  # a source of a name: their rooms
  while IFS= read -r path; do
    room_of "$path"
    [[ -n ${below[$library $room]+defined} ]] || complain "$table: no line for room $room of lib$library/src/$path"
    [[ $path != *.cpp ]] || rooms_with[${path##*/}]+="$room "
  done < <(find "lib$library/src" -name '*.h' -printf '%P\n' -o -name '*.cpp' -printf '%P\n')
  if [[ -d tests/$library ]]; then
    while IFS= read -r room; do
      [[ -n ${below[$library $room]+defined} ]] || complain "$table: no line for room $room of tests/$library/$room"
    done < <(find "tests/$library" -mindepth 2 -name '*_test.cpp' -printf '%P\n' | sed 's|/[^/]*$||' | sort -u)
  fi
  while IFS= read -r header; do
    rooms=${rooms_with[${header%.h}.cpp]-}
    if [[ -n ${header_room[$library/$header]+defined} ]]; then
      [[ -z $rooms ]] || complain "$table: the room of $library/$header is that of a source of its name, ${rooms% }; no line is needed"
    elif [[ $rooms =~ ^[^\ ]+\ $ ]]; then
      header_room[$library/$header]=${rooms% }
    else
      complain "$table: no line says the room of the public header $library/$header, and sources of its name are in: ${rooms:-no room}"
    fi
  done < <(find "lib$library/include/$library" -name '*.h' -printf '%P\n')
done

# Libraries: only those below.
for library in "${libraries[@]}"; do
  while IFS=: read -r file included; do
    other=${included%%/*}
    [[ $included != */* || $other == "$library" || ! -e lib$other/include/$included ]] && continue
    [[ ${below[$library]} == *" $other "* ]] || complain "lib$library knows no lib$other: $file includes \"$included\""
  done < <(includes "lib$library" "tests/$library")
done
while IFS=: read -r file included; do
  [[ $included != */* || ! -e lib${included%%/*}/include/$included ]] || complain "common knows no library: $file includes \"$included\""
done < <(includes common)

# Rooms: only those below. A header is included by its path, public ones from include, private ones from src.
for library in "${with_rooms[@]}"; do
  while IFS=: read -r file included; do
    if [[ -e lib$library/include/$included ]]; then
      to=${header_room[$included]-}
    elif [[ -e lib$library/src/$included ]]; then
      [[ $file != lib$library/include/* ]] || complain "public headers include no private one: $file includes \"$included\""
      room_of "$included"
      to=$room
    else
      continue
    fi
    case $file in
      "lib$library/include/"*) from=${header_room[${file#"lib$library/include/"}]-} ;;
      *)
        room_of "${file#"lib$library/src/"}"
        from=$room
        ;;
    esac
    [[ -z $from || -z $to || $from == "$to" || ${below[$library $from]-} == *" $to "* ]] ||
      complain "lib$library: room $from may not include room $to: $file includes \"$included\""
  done < <(includes "lib$library/include" "lib$library/src")
  # What is in quotes is found at one of these places and nowhere else, or is the version that the build writes.
  while IFS=: read -r file included; do
    found=0
    for folder in lib*/include "lib$library/src" common; do [[ ! -e $folder/$included ]] || found=1; done
    [[ $found -eq 1 || $included == build_info.h || $included == vesiflow/version.h ]] ||
      complain "headers are included by their path from src or include: $file includes \"$included\""
  done < <(quoted_includes "lib$library")
done

for library in "${libraries[@]}"; do
  while IFS=: read -r file included; do
    [[ ! $included =~ ^(fftw3|cholmod|suitesparse|sundials|kinsol|cvode|arkode|hdf5|H5|xxhash|omp\.h|toml|nlohmann) ]] ||
      complain "public headers show no third-party library but Eigen: $file includes <$included>"
  done < <(includes "lib$library/include")
done

# Files of scenes and results, a logger and signals are matters of programs: of librun.
for library in vesicle fluid coupling; do
  while IFS=: read -r file included; do
    [[ ! $included =~ ^(toml\+\+|nlohmann|spdlog|hdf5|H5|xxhash|CLI|csignal|signal\.h) ]] ||
      complain "libraries of numerics know no files of scenes or results, no logger and no signals: $file includes <$included>"
  done < <(includes "lib$library")
done

# Apps: what one includes in quotes is a file of the apps, a public header, of common/, or the version that the build writes.
while IFS=: read -r file included; do
  [[ ! $included =~ ^((\.\./)*lib[a-z]+/|.*(src|detail)/) ]] || complain "apps include public headers only: $file includes \"$included\""
done < <(includes apps)
apps_headers=$(find apps -name '*.h' -printf '%p\n')$'\n'
while IFS=: read -r file included; do
  found=0
  for folder in lib*/include common; do [[ ! -e $folder/$included ]] || found=1; done
  [[ $found -eq 1 || $included == build_info.h || $included == vesiflow/version.h || $apps_headers == *"/$included"$'\n'* ]] ||
    complain "apps include public headers and common/ only: $file includes \"$included\""
done < <(quoted_includes apps)

# The Python package: the same, but for what finds equilibrium shapes, which is an app's.
while IFS=: read -r file included; do
  found=0
  for folder in lib*/include python/src apps/membrane/equilibrium_shape; do [[ ! -e $folder/$included ]] || found=1; done
  [[ $found -eq 1 ]] || complain "the Python package includes public headers only: $file includes \"$included\""
done < <(quoted_includes python/src)
# Its modules of one library know no other.
for library in vesicle fluid; do
  while IFS=: read -r file included; do
    [[ $included != */* || ${included%%/*} == "$library" || ! -e lib${included%%/*}/include/$included ]] ||
      complain "vesiflow.$library knows no lib${included%%/*}: $file includes \"$included\""
  done < <(quoted_includes python/src | grep "^python/src/${library}_module.cpp:" || true)
done

[[ $failed -eq 0 ]] && echo "dependencies: as they should be"
exit $failed
