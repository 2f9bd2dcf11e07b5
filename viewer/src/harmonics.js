// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Real orthonormal spherical harmonics on a mesh of the sphere: P_n^0, sqrt(2) P_n^m cos(m phi), sqrt(2) P_n^m sin(m phi), without the
// Condon-Shortley phase, as librun/src/report/real_coefficients.h says. A field is two products of matrices: over the degrees for each
// colatitude and order, then over the orders for each longitude.

/**
 * P_n^m(cos theta) for n < degrees at one colatitude, and their derivatives by theta; index n(n+1)/2 + m.
 * By the recursion in n from P_m^m, which is stable for the normalised functions (Press et al., Numerical Recipes, 6.7).
 */
export function legendre(degrees, theta) {
  const x = Math.cos(theta);
  const s = Math.sin(theta);
  const at = (n, m) => (n * (n + 1)) / 2 + m;
  const P = new Float64Array((degrees * (degrees + 1)) / 2);
  const D = new Float64Array(P.length);
  let top = Math.sqrt(1 / (4 * Math.PI));
  for (let m = 0; m < degrees; ++m) {
    if (m > 0) top *= s * Math.sqrt((2 * m + 1) / (2 * m));
    P[at(m, m)] = top;
    if (m + 1 < degrees) P[at(m + 1, m)] = x * Math.sqrt(2 * m + 3) * top;
    for (let n = m + 2; n < degrees; ++n) {
      const a = Math.sqrt((4 * n * n - 1) / (n * n - m * m));
      const b = Math.sqrt(((n - 1) ** 2 - m * m) / (4 * (n - 1) ** 2 - 1));
      P[at(n, m)] = a * (x * P[at(n - 1, m)] - b * P[at(n - 2, m)]);
    }
  }
  // dP/dtheta = (n x P_n^m - sqrt((2n+1)/(2n-1) (n^2 - m^2)) P_{n-1}^m) / s; callers keep away from the poles.
  for (let n = 0; n < degrees; ++n)
    for (let m = 0; m <= n; ++m) {
      const below = m < n ? Math.sqrt(((2 * n + 1) / (2 * n - 1)) * (n * n - m * m)) * P[at(n - 1, m)] : 0;
      D[at(n, m)] = (n * x * P[at(n, m)] - below) / s;
    }
  return { P, D };
}

// So near to the poles that no one sees the hole, and so far that a normal is a number.
const poleDistance = 1e-3;

/** Colatitudes and longitudes of a mesh, with the tables for so many degrees. The last longitude is the first once more. */
export class SphereMesh {
  constructor(latitudes, longitudes, degrees) {
    this.rows = latitudes + 1;
    this.columns = longitudes + 1;
    this.degrees = degrees;
    this.size = this.rows * this.columns;
    this.theta = Float64Array.from({ length: this.rows }, (_, j) =>
      Math.min(Math.PI - poleDistance, Math.max(poleDistance, (Math.PI * j) / latitudes)),
    );
    this.tables = Array.from(this.theta, (theta) => legendre(degrees, theta));
    this.cos = new Float64Array(this.columns * degrees);
    this.sin = new Float64Array(this.columns * degrees);
    for (let i = 0; i < this.columns; ++i)
      for (let m = 0; m < degrees; ++m) {
        const angle = (2 * Math.PI * m * (i % longitudes)) / longitudes;
        this.cos[i * degrees + m] = (m > 0 ? Math.SQRT2 : 1) * Math.cos(angle);
        this.sin[i * degrees + m] = (m > 0 ? Math.SQRT2 : 0) * Math.sin(angle);
      }
    this.work = [new Float64Array(degrees), new Float64Array(degrees)];
  }

  indices() {
    const list = new Uint32Array(6 * (this.rows - 1) * (this.columns - 1));
    let at = 0;
    for (let j = 0; j + 1 < this.rows; ++j)
      for (let i = 0; i + 1 < this.columns; ++i) {
        const a = j * this.columns + i;
        const b = a + this.columns;
        list.set([a, b, b + 1, a, b + 1, a + 1], at);
        at += 6;
      }
    return list;
  }

  /** Sums over the degrees at row j: of each order the factors of cos and sin. */
  sumDegrees(values, degrees, table, a, b) {
    a.fill(0);
    b.fill(0);
    for (let n = 0, k = 0; n < degrees; ++n) {
      const base = (n * (n + 1)) / 2;
      a[0] += table[base] * values[k++];
      for (let m = 1; m <= n; ++m) {
        const p = table[base + m];
        a[m] += p * values[k++];
        b[m] += p * values[k++];
      }
    }
  }

  /** Values of a field into every `stride`-th place of `out` from `offset` on. */
  values(values, out, stride = 1, offset = 0, derivative = "none") {
    const degrees = Math.min(this.degrees, Math.round(Math.sqrt(values.length)));
    const [a, b] = this.work;
    let at = offset;
    for (let j = 0; j < this.rows; ++j) {
      this.sumDegrees(values, degrees, derivative === "theta" ? this.tables[j].D : this.tables[j].P, a, b);
      for (let i = 0; i < this.columns; ++i, at += stride) {
        let sum = 0;
        const row = i * this.degrees;
        if (derivative === "phi")
          for (let m = 1; m < degrees; ++m) sum += m * (b[m] * this.cos[row + m] - a[m] * this.sin[row + m]);
        else for (let m = 0; m < degrees; ++m) sum += a[m] * this.cos[row + m] + b[m] * this.sin[row + m];
        out[at] = sum;
      }
    }
  }

  /** Positions and unit normals of a surface, three numbers a vertex; normals are those of the harmonics, not of facets. */
  surface(columns, positions, normals, work) {
    for (let c = 0; c < 3; ++c) {
      this.values(columns[c], positions, 3, c);
      this.values(columns[c], work.theta, 3, c, "theta");
      this.values(columns[c], work.phi, 3, c, "phi");
    }
    const { theta: t, phi: p } = work;
    for (let k = 0; k < 3 * this.size; k += 3) {
      const x = t[k + 1] * p[k + 2] - t[k + 2] * p[k + 1];
      const y = t[k + 2] * p[k] - t[k] * p[k + 2];
      const z = t[k] * p[k + 1] - t[k + 1] * p[k];
      const length = Math.hypot(x, y, z) || 1;
      normals[k] = x / length;
      normals[k + 1] = y / length;
      normals[k + 2] = z / length;
    }
  }
}
