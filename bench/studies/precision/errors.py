# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Errors of runs against a reference: position of the membrane whatever its mesh, and courses of numbers.

A state is what is kept of a run: the membranes by time, as markers (latitudes, longitudes, 3), and the rows of its diagnostics. States with
the same mesh and times can be combined linearly, which is how references are extrapolated: the mesh follows the shape, so that a
marker's position depends as smoothly on spacing and step as the shape does.
"""

import numpy as np

from harness import outputs, spectral
from harness.outputs import turned

SAMPLES = 20  # latitudes of the points whose distance is taken
ROUND = 9  # decimals of times that are the same


def read(folder):
    """The state of a run that has reached its end."""
    membranes = {}
    for shot in outputs.membranes(folder):
        membranes[round(shot["time"], ROUND)] = spectral.on_mesh(shot["points"], shot["latitudes"])
    return {"membranes": membranes, "course": outputs.course(folder)}


def combination(parts):
    """sum of w X over [(w, state)], weights adding up to 1; angles, which count modulo 180 degrees, are those nearest to the first's."""
    assert abs(sum(w for w, _ in parts) - 1) < 1e-12
    times = lambda state: [round(t, ROUND) for t in state["course"]["time"]]  # noqa: E731
    # A run that was interrupted has a row and a snapshot more than others.
    rows = sorted(set.intersection(*(set(times(state)) for _, state in parts)))
    shots = sorted(set.intersection(*(set(state["membranes"]) for _, state in parts)))
    chosen = [[times(state).index(t) for t in rows] for _, state in parts]
    membranes = {time: sum(w * state["membranes"][time] for w, state in parts) for time in shots}
    course = {}
    for key in parts[0][1]["course"]:
        columns = [state["course"][key][of] for (_, state), of in zip(parts, chosen)]
        if key == "inclination_angle_deg":
            columns = [columns[0] + turned(column - columns[0]) for column in columns]
        course[key] = columns[0] if key in ("step", "time", "vesicle") else sum(w * column for (w, _), column in zip(parts, columns))
    return {"membranes": membranes, "course": course}


class Surface:
    """A membrane as a surface: normals and second fundamental form on a mesh so fine that distances are good to 1e-6 radii and 3e-4 of themselves."""

    def __init__(self, markers, latitudes=96):
        x = spectral.analysis(markers)
        degree, order = np.arange(x.shape[1])[None, :, None], np.arange(x.shape[0])[:, None, None]
        sampled = lambda c, derivative=None: spectral.synthesis(c, latitudes, derivative)  # noqa: E731
        cosine = spectral.nodes(latitudes)[0][:, None, None]
        sine = np.sqrt(1 - cosine**2)
        theta, phi, phi_phi = sampled(x, "theta"), sampled(x, "phi"), sampled(-order**2 * x)
        # By Legendre's equation: no second derivatives of the harmonics are needed.
        theta_theta = sampled(-degree * (degree + 1) * x) - phi_phi / sine**2 - cosine / sine * theta
        normal = np.cross(theta, phi)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        self.second = [np.sum(d * normal, axis=-1).ravel() for d in (theta_theta, sampled(1j * order * x, "theta"), phi_phi)]
        self.points, self.theta, self.phi, self.normal = (a.reshape(-1, 3) for a in (sampled(x), theta, phi, normal))

    def distance(self, points):
        """Signed, outward: from the plane at the nearest mesh point, less the surface's own bend towards the point."""
        nearest = np.empty(len(points), dtype=int)
        squares = np.sum(self.points**2, axis=1)
        for start in range(0, len(points), 256):
            part = points[start:start + 256]
            nearest[start:start + 256] = np.argmin(squares - 2 * part @ self.points.T, axis=1)
        offset = points - self.points[nearest]
        height = np.sum(offset * self.normal[nearest], axis=1)
        theta, phi = self.theta[nearest], self.phi[nearest]
        dot = lambda a, b: np.sum(a * b, axis=1)  # noqa: E731
        e, f, g = dot(theta, theta), dot(theta, phi), dot(phi, phi)
        p, q = dot(offset, theta), dot(offset, phi)
        a, b = (g * p - f * q) / (e * g - f * f), (e * q - f * p) / (e * g - f * f)
        ll, m, n = (s[nearest] for s in self.second)
        return height - 0.5 * (ll * a * a + 2 * m * a * b + n * b * b)


def position_error(markers, surface):
    """Distance of a membrane from a surface: root of the mean square over the membrane's area."""
    coefficients = spectral.analysis(markers)
    points, theta, phi = (spectral.synthesis(coefficients, SAMPLES, d) for d in (None, "theta", "phi"))
    cosine, weights = spectral.nodes(SAMPLES)
    area = np.linalg.norm(np.cross(theta, phi), axis=-1) * (weights / np.sqrt(1 - cosine**2))[:, None]
    distance = surface.distance(points.reshape(-1, 3)).reshape(area.shape)
    return float(np.sqrt(np.sum(area * distance**2) / np.sum(area)))


class Reference:
    """What errors are measured against, from time `since` on where a course counts (positions count at all times but 0)."""

    def __init__(self, state, columns, since):
        self.state, self.columns, self.since = state, columns, since
        self.surfaces = {time: Surface(markers) for time, markers in state["membranes"].items() if time > 0}

    def errors(self, state):
        """position: largest over the times, in effective radii; columns: relative, root of the mean square over the course; area and
        volume: largest of the course; largest: of all. Only times that both have: adaptive runs share the end."""
        found = {"position": max(position_error(markers, self.surfaces[time])
                                 for time, markers in state["membranes"].items() if time in self.surfaces)}
        mine, own = _common(state["course"], self.state["course"], self.since)
        for name, column in self.columns.items():
            a, b = state["course"][column][mine], self.state["course"][column][own]
            difference = turned(a - b) if column == "inclination_angle_deg" else a - b
            found[name] = float(np.sqrt(np.mean(difference**2) / np.mean(b**2)))
        for name in ("area", "volume"):
            found[name] = float(np.max(np.abs(state["course"][f"{name}_error"])))
        found["largest"] = max(found.values())
        return found


def _common(course, reference, since):
    times, wanted = np.round(course["time"], ROUND), np.round(reference["time"], ROUND)
    _, mine, own = np.intersect1d(times, wanted[wanted >= since - 1e-9], return_indices=True)
    return mine, own + np.searchsorted(wanted, since - 1e-9)
