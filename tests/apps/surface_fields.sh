#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# surface_fields.sh SURFACE_FIELDS: its tables have the promised columns and the right numbers, it reads coefficients and
# meshes, bad input gives one clear error and the documented exit code.
set -u
app=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# 1:1:2 by coefficients (x = sin(theta) cos(phi) is 2 Re f Y_1^1 with f = sqrt(2 pi / 3), z = f Y_1^0) and an octahedron.
printf '1 1  1.4472025091165353 0  0 -1.4472025091165353  0 0\n1 0  0 0  0 0  4.093306831785954 0\n' >spheroid.txt
cat >octahedron.OBJ <<'OBJ'
v 1 0 0
v 0 1 0
v -1 0 0
v 0 -1 0
v 0 0 1
v 0 0 -1
f 1 2 5
f 2 3 5
f 3 4 5
f 4 1 5
f 2 1 6
f 3 2 6
f 4 3 6
f 1 4 6
OBJ

# table NAME ARGUMENTS...: tables in the folder NAME, int K dA / 4 pi = 1 in the summary.
table() {
  local name=$1 curvature
  shift
  "$app" "$@" --out "$name" --quiet >"$name.txt" || { echo "FAILED: $*"; failures=$((failures + 1)); return; }
  curvature=$(sed -n 's|^int K dA / 4 pi *||p' "$name.txt")
  if ! python3 -c "assert abs($curvature - 1) < 1e-6"; then
    echo "FAILED: $*: int K dA / 4 pi = $curvature"
    failures=$((failures + 1))
  fi
}
table sphere sphere --latitudes 16
table prolate prolate --latitudes 24 --reduced-volume 0.95
table oblate oblate --latitudes 24 --reduced-volume 0.95
table ellipsoid ellipsoid --latitudes 24 --axes 1 1 2
table biconcave biconcave --latitudes 48
table file "$work/spheroid.txt" --latitudes 24

# A red cell as binary STL and with a byte order mark as OBJ, of a sphere of 1026 vertices pushed onto the Evans-Fung disc.
python3 - <<'PYTHON'
import math, struct
vertices = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
triangles = [t for k in range(4) for t in ((k, (k + 1) % 4, 4), ((k + 1) % 4, k, 5))]
for _ in range(4):
    middles, finer = {}, []
    def middle(a, b):
        key = min(a, b), max(a, b)
        if key not in middles:
            m = [p + q for p, q in zip(vertices[a], vertices[b])]
            middles[key] = len(vertices)
            vertices.append(tuple(c / math.hypot(*m) for c in m))
        return middles[key]
    for a, b, c in triangles:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    triangles = finer
def disc(x, y, z):
    rho = x * x + y * y
    return x, y, z / 2 * (0.207161 + 2.002558 * rho - 1.122762 * rho * rho)
cell = [disc(*v) for v in vertices]
with open("cell.obj", "w", encoding="utf-8-sig") as f:
    f.writelines("v %.9g %.9g %.9g\n" % v for v in cell)
    f.writelines("f %d %d %d\n" % tuple(i + 1 for i in t) for t in triangles)
with open("cell.stl", "wb") as f:
    f.write(b"solid, but binary".ljust(80) + struct.pack("<I", len(triangles)))
    for t in triangles:
        f.write(struct.pack("<12f2x", 0, 0, 0, *(c for i in t for c in cell[i])))
PYTHON
table cell_obj cell.obj --latitudes 32
table cell_stl cell.stl --latitudes 32
for name in biconcave cell_obj cell_stl; do sed -n 's/^reduced volume *//p' $name.txt; done | python3 -c "
disc, *cells = map(float, __import__('sys').stdin)
assert len(cells) == 2 and all(abs(cell - disc) < 1e-4 for cell in cells), (disc, cells)" || failures=$((failures + 1))

python3 - <<'PYTHON' || failures=$((failures + 1))
import csv, math

def read(path):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}

vectors = ("position", "normal", "bending_force", "tension_force")
scalars = ("colatitude", "longitude", "area_weight", "mean_curvature", "gaussian_curvature", "laplacian_of_mean_curvature", "tension")
for name, n in (("sphere", 16), ("prolate", 24), ("oblate", 24), ("ellipsoid", 24), ("biconcave", 48), ("file", 24)):
    t = read(f"{name}/markers.csv")
    assert set(t) == set(scalars) | {f"{v}_{c}" for v in vectors for c in "xyz"}, (name, t.keys())
    assert all(len(column) == 2 * n * n and all(map(math.isfinite, column)) for column in t.values()), name
    total = sum(k * a for k, a in zip(t["gaussian_curvature"], t["area_weight"]))
    assert abs(total / (4 * math.pi) - 1) < 1e-6, (name, total)
    volume = sum(sum(t[f"position_{c}"][k] * t[f"normal_{c}"][k] for c in "xyz") * t["area_weight"][k] for k in range(2 * n * n)) / 3
    assert abs(volume / (4 * math.pi / 3) - 1) < 1e-6, (name, volume)
    for c in "xyz":  # no force on the whole
        assert abs(sum(f * a for f, a in zip(t[f"bending_force_{c}"], t["area_weight"]))) < 1e-6, name
    s = read(f"{name}/spectrum.csv")
    assert list(s) == ["degree", "positions", "mean_curvature", "mean_curvature_law"] and s["degree"] == list(range(n)), name

sphere, file, ellipsoid = read("sphere/markers.csv"), read("file/markers.csv"), read("ellipsoid/markers.csv")
for name, value in (("mean_curvature", 1), ("gaussian_curvature", 1), ("tension", 0), ("laplacian_of_mean_curvature", 0)):
    assert all(abs(x - value) < 1e-8 for x in sphere[name]), name
for name in ellipsoid:  # the same surface
    scale = max(map(abs, ellipsoid[name]))
    assert all(abs(a - b) < 1e-6 * scale + 1e-9 for a, b in zip(file[name], ellipsoid[name])), name
PYTHON

code=2
# refused PATTERN ARGUMENTS...
refused() {
  local pattern=$1 message status
  shift
  message=$("$app" "$@" 2>&1)
  status=$?
  if [[ $status -ne $code || ! $message =~ ^"error: ".*($pattern) || $(wc -l <<<"$message") -ne 1 ]]; then
    echo "FAILED ($status, expected $code and '$pattern'): $* -> $message"
    failures=$((failures + 1))
  else
    echo "ok: $message"
  fi
}

touch a_file
refused 'surface = nosuch: neither a file nor one of sphere, .*biconcave' nosuch
refused 'cannot be read' /
refused '--latitudes 3: must be from 4 to 512' --latitudes 3
refused '--latitudes 100000: must be' --latitudes 100000
refused '--latitudes many: must be a whole number' --latitudes many
refused '--nosuch' --nosuch
for volume in 0 -1 1.0001 nan inf; do
  refused 'reduced_volume = .*in \(0, 1\]' prolate --reduced-volume "$volume"
  refused 'reduced_volume = .*in \(0, 1\]' oblate --reduced-volume "$volume"
done
refused 'degenerate surface|reduced_volume' prolate --reduced-volume 1e-30
refused '--axes.*3' ellipsoid --axes 1 2
refused 'semi-axis proportion = 0: must be in' ellipsoid --axes 1 0 2
refused 'semi-axis proportion = -1: must be in' ellipsoid --axes -1 1 2
refused 'semi-axis proportion = nan: must be in' ellipsoid --axes nan 1 2
refused '--axes .*x.*: must be a number' ellipsoid --axes 1 x 2
code=4
refused 'a_file.*cannot be made' sphere --out a_file
refused 'a_file/below: cannot be made' sphere --out a_file/below
refused '/proc/nosuch: cannot be made' sphere --out /proc/nosuch
mkdir -p full && ln -sf /dev/full full/markers.csv
refused 'markers.csv: cannot be written' sphere --latitudes 8 --out full
code=2
refused 'degrees = 2: the fit needs .* vertices' octahedron.OBJ
refused 'degrees = 16: the fit needs .* vertices' octahedron.OBJ --fit-degrees 16
refused 'degrees = 0: must be >= 2' octahedron.OBJ --fit-degrees 0
refused 'a_file: no coefficients' a_file
head -c 3000 "$app" >garbage.txt
refused 'garbage.txt:1: ' garbage.txt
cp garbage.txt garbage.off
refused 'garbage.off: not known as a mesh' garbage.off
printf 'glTF' >mesh.glb
refused 'mesh.glb: this is binary glTF' mesh.glb
: >empty.obj
refused 'empty.obj: the file is empty' empty.obj
head -12 octahedron.OBJ >open.obj
refused 'edge between vertices .* is open' open.obj

echo "$failures failures"
exit $((failures > 0))
