#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# The check of dependencies finds what it is meant to find: each case breaks a copy of the sources in one way.
# usage: tests/scripts/check_dependencies.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/good"
cp -r scripts common apps lib* "$scratch/good"
mkdir "$scratch/good/tests" "$scratch/good/python"
cp -r python/src "$scratch/good/python"
cp -r tests/vesicle tests/fluid "$scratch/good/tests"
failed=0

# A copy of the sources, to break one of them.
fresh() {
  rm -rf "$scratch/case"
  cp -r "$scratch/good" "$scratch/case"
  cd "$scratch/case"
}

# adds FILE LINE: appends the line to the file, which may be new.
adds() {
  mkdir -p "$(dirname "$1")"
  printf '%s\n' "$2" >>"$1"
}

# refused WORDS...: the check of the broken copy fails, and one line of what it says has all the words.
refused() {
  local said line word all
  if said=$(scripts/check_dependencies.sh 2>&1); then
    echo "not found: $*" >&2
    failed=1
    return
  fi
  while IFS= read -r line; do
    all=1
    for word in "$@"; do [[ $line == *"$word"* ]] || all=0; done
    [[ $all -eq 0 ]] || return 0
  done <<<"$said"
  printf 'no line of it has all of: %s\n%s\n' "$*" "$said" >&2
  failed=1
}

fresh
scripts/check_dependencies.sh

# Arrows upward: to a private header, to a public one, between public headers with angle brackets, and between folders of a room.
adds libvesicle/src/harmonics/lanes.h '#include "surface/columns.h"'
refused "room harmonics may not include room surface" libvesicle/src/harmonics/lanes.h '"surface/columns.h"'
fresh
adds libvesicle/src/mesh/mesh_quality.cpp '#include "vesicle/diagnostics.h"'
refused "room mesh may not include room forces" libvesicle/src/mesh/mesh_quality.cpp '"vesicle/diagnostics.h"'
fresh
adds libfluid/include/fluid/field.h '  #  include <fluid/navier_stokes.h>'
refused "room grid may not include room step" libfluid/include/fluid/field.h '"fluid/navier_stokes.h"'
fresh
adds libfluid/src/elliptic/fft/fft_solver.cpp '#include "elliptic/pcg/pcg_solver.h"'
refused "room elliptic/fft may not include room elliptic/pcg" libfluid/src/elliptic/fft/fft_solver.cpp

# Mistakes in the table.
fresh
sed -i 's/^room vesicle harmonics src$/& surface/' scripts/rooms.txt
refused "room harmonics of libvesicle would include room surface" circle
fresh
sed -i 's/^library fluid$/& coupling/' scripts/rooms.txt
refused "libfluid would include libcoupling"
fresh
sed -i 's/^room vesicle io .*//' scripts/rooms.txt
refused "no line for room io" libvesicle/src/io/obj_file.cpp
refused "no line for room io" tests/vesicle/io
fresh
adds scripts/rooms.txt 'header vesicle forces volume'
refused "no line is needed" vesicle/volume.h
fresh
adds scripts/rooms.txt 'header vesicle forces surface_tension'
refused "there is no public header vesicle/surface_tension.h"
fresh
adds scripts/rooms.txt 'chamber vesicle io'
refused "not understood" "chamber vesicle io"

# Headers and folders that the table does not know.
fresh
adds libvesicle/include/vesicle/constants.h '#pragma once'
refused "no line says the room" vesicle/constants.h
fresh
adds libvesicle/src/cellar/wine.cpp '#include "vesicle/types.h"'
refused "no line for room cellar" libvesicle/src/cellar/wine.cpp
fresh
adds tests/fluid/cellar/wine_test.cpp '#include "fluid/grid.h"'
refused "no line for room cellar" tests/fluid/cellar

# Paths that do not say the room.
fresh
adds libvesicle/src/harmonics/hemispheres.cpp '#include "lanes.h"'
refused "path from src or include" libvesicle/src/harmonics/hemispheres.cpp '"lanes.h"'
fresh
adds libvesicle/src/surface/surface.cpp '#include "../harmonics/lanes.h"'
refused "path from src or include" libvesicle/src/surface/surface.cpp '"../harmonics/lanes.h"'

# Libraries.
fresh
adds tests/vesicle/harmonics/coefficients_test.cpp '#include "fluid/grid.h"'
refused "libvesicle knows no libfluid" tests/vesicle/harmonics/coefficients_test.cpp
fresh
adds libfluid/src/message.h '#include <coupling/simulation.h>'
refused "libfluid knows no libcoupling" libfluid/src/message.h
fresh
adds common/short_waits.h '#include "vesicle/types.h"'
refused "common knows no library" common/short_waits.h

# What public headers and apps may show.
fresh
adds libfluid/include/fluid/grid.h '#include <fftw3.h>'
refused "no third-party library but Eigen" libfluid/include/fluid/grid.h fftw3.h
fresh
adds libfluid/include/fluid/grid.h '#include "message.h"'
refused "public headers include no private one" libfluid/include/fluid/grid.h message.h
fresh
adds apps/scene/vesicles.cpp '#include "../libvesicle/src/check.h"'
refused "apps include public headers only" apps/scene/vesicles.cpp
fresh
adds apps/scene/vesicles.cpp '#include "harmonics/lanes.h"'
refused "apps include public headers and common/ only" apps/scene/vesicles.cpp '"harmonics/lanes.h"'

# The Python package: public headers only, and of a module of one library those of that library.
fresh
adds python/src/run_module.cpp '#include "run/recorder.h"'
refused "the Python package includes public headers only" python/src/run_module.cpp '"run/recorder.h"'
fresh
adds python/src/fluid_module.cpp '#include "vesicle/surface.h"'
refused "vesiflow.fluid knows no libvesicle" python/src/fluid_module.cpp '"vesicle/surface.h"'

# Libraries of numerics know no files, no logger, no signals.
for header in '<toml++/toml.h>' '<nlohmann/json.hpp>' '<spdlog/spdlog.h>' '<hdf5.h>' '<csignal>'; do
  fresh
  adds libcoupling/src/step/simulation.cpp "#include $header"
  refused "libraries of numerics" libcoupling/src/step/simulation.cpp
done
fresh
adds libcoupling/src/motion/gmres.cpp '#include "step/immersed_vesicle.h"'
refused "room motion may not include room step" libcoupling/src/motion/gmres.cpp
fresh
adds libcoupling/src/step/simulation.cpp '#include "run/scene.h"'
refused "libcoupling knows no librun" libcoupling/src/step/simulation.cpp

[[ $failed -eq 0 ]] && echo "the check of dependencies finds what it is meant to find"
exit $failed
