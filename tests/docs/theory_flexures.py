# SPDX-License-Identifier: GPL-3.0-or-later
"""The worked examples of the pages about flexures, written again from their equations. SI units in and out."""
import pathlib
import re
from math import atanh, cos, cosh, log, radians, sin, sinh, sqrt

DEVICE = "tests/data/theory/flexures.xml"


def root_length(t, rho):
    """equation (6)"""
    x = min(max(rho / t, 0.05), 2.0)
    return t * (0.4192 - 0.5972 * x - 0.1167 * x * x)


def sum_of_table(*values):
    """G of (11a), its terms as the table STRIP lists them"""
    rows = (pathlib.Path(__file__).resolve().parents[2] / "src/flexure/roots.def").read_text(encoding="utf-8")
    total = 0.0
    for number, powers in re.findall(r"^STRIP\(([-+.0-9e]+), ([^)]*)\)$", rows, re.M):
        term = float(number)
        for value, power in zip(values, powers.split(","), strict=False):
            term *= value ** int(power)
        total += term
    return total


def arc(g):
    """everything that equations (1) to (11a) have of an isotropic arc"""
    r, a, t, rho, h = g["r"], g["angle"] / 2, g["t"], g["rho"], g["h"]
    E, nu = g.get("E", 150e9), g.get("nu", 0.31)
    L, u, x, s, c = 2 * a * r, t / (2 * r), rho / t, sin(a), cos(a)
    rn = r * u / atanh(u)
    e, area, inertia, shear = r - rn, h * t, h * t**3 / 12, E / (2 * (1 + nu))
    dL, Kt = root_length(t, rho), 0.944 + 0.2113 * x ** (-2 / 3)
    X = h * (3 * (1 - nu * nu)) ** 0.25 / sqrt(r * t)
    f = 2 / X * (cosh(X) - cos(X)) / (sinh(X) + sin(X))
    D = (1 - nu * nu * f) / (1 - nu * nu)
    xW = (L * rn * s / a + 2 * dL * r * c) / (L + 2 * dL)
    K = E * inertia * D * (1 - 2 / 15 * u * u - u**4 / 21) / (L + 2 * dL)
    y_B, x_B = r * s, r * c - xW
    C_xx = (r * rn * (a - s * c) / (E * area * e * D) + 2 * dL * y_B**2 / (E * inertia * D)
            + r * (a + s * c) * 1.2 / (shear * area))
    C_yy = (rn * (r * (a + s * c) - 4 * xW * s + 2 * a * xW**2 / rn) / (E * area * e * D)
            + 2 * dL * x_B**2 / (E * inertia * D) + r * (a - s * c) * 1.2 / (shear * area))
    sh, ch, si, co, l = sinh(X / 2), cosh(X / 2), sin(X / 2), cos(X / 2), X / h
    N = si * co + sh * ch
    C1, C2 = nu * (sh * co - ch * si) / (2 * l * l * N), nu * (ch * si + sh * co) / (2 * l * l * N)
    inner, outer = 1 - C1 / (r * t / 2), 1 + (C1 * ch * co + C2 * sh * si) / (r * t / 2)
    p, w, reach = h / (h + 4 * t), t / (3 * r), h * f / sqrt(6 * (1 + nu))
    d = nu * nu * f * reach * reach / (reach + 0.4192 * t)
    G = sum_of_table(2 * log(x / 0.1) / log(12.5) - 1, 2 * (p - 1 / 9) / (10 / 14 - 1 / 9) - 1, nu, nu * f, sqrt(20 * w))
    bend, least = t / (2 * (L + 2 * dL)), t / (2 * (L + 2 * dL - 2 * d))
    return {"L": L, "dL": dL, "Kt": Kt, "D": D, "f": f, "xW": xW, "K": K, "kx": 1 / C_xx, "ky": 1 / C_yy, "F_i": inner,
            "F_o": outer, "G": G, "fit": bend * Kt * max((1 + w) * inner, (1 - w) * outer),
            "d": d, "bound": least * max(Kt * (1 + w) * G, (1 + w) * inner, (1 - w) * outer), "bow": nu * nu * f}


def hinge(run, which, device=DEVICE):
    document = run("hinge", device, "--json")
    found = next(h for h in document["hinges"] if h["id"] == which)
    return found, {level["level"]: level for level in found["levels"]}


def flexure(g):
    return arc(g)


def flexure_program(run, _):
    level = hinge(run, "A")[1]["closed-form"]
    return {"K": level["stiffness_Nm_per_rad"], "kx": level["kx_N_per_m"], "ky": level["ky_N_per_m"]}


def root_strain(g):
    found = arc(g)
    found["limit"] = g["strength"] / (g["safety"] * g["E"] * found["bound"])
    return found


def root_strain_program(run, _):
    found = hinge(run, "A")[0]
    return {"fit": found["strain_fit_per_rad"], "bound": found["strain_bound_per_rad"]}


def sinc_and_slope(x):
    return sin(x) / x, (cos(x) - sin(x) / x) / x


def axis_drift(g):
    r, a, theta = g["r"], g["angle"] / 2, g["theta"]
    L = 2 * a * r
    share = L / (L + 2 * root_length(g["t"], g["rho"]))

    def drift(angle):
        rest, slope = sinc_and_slope(a)
        return L * (sinc_and_slope(a + share * angle / 2)[0] - cos(angle / 2) * rest - share * sin(angle / 2) * slope)
    step = 1e-3
    curve = (drift(step) - 2 * drift(0) + drift(-step)) / step**2
    return {"delta": drift(theta), "meet": sqrt(2 * g["gap"] / abs(curve))}


def axis_drift_program(run, _):
    found, levels = hinge(run, "A")
    return {"delta": levels["elastica"]["limit_drift_m"], "meet": found["drift"]["contact_rad"][1]}


def flexure_silicon(g):
    c11, c12, c44, L, t, h = g["c11"], g["c12"], g["c44"], g["L"], g["t"], g["h"]
    below = (c11 - c12) * (c11 + 2 * c12)
    s11, s12, s44 = (c11 + c12) / below, -c12 / below, 1 / c44
    s0 = s11 - s12 - s44 / 2
    a0, a1 = s11 - s0 / 4, s0 / 4
    stiff = 1 / (a0 - a1)
    reach = min(h * sqrt(s11 / (3 * s44)), L / 3)
    block, root = 0.4192 * t, root_length(t, g["rho"])
    lost = stiff * s12 * s12 / s11 * reach**2 / (reach + block)
    # of a root, the block gives with the mean a0, the fillet takes away strip with the modulus of the leaf's direction
    ends = stiff * (root * a0 - (root - block) * a1) + t * (0.006 + 0.0335 * min(g["rho"] / t, 1.25) ** 2)
    return {"E_100": 1 / (a0 + a1), "E_110": stiff, "n2": s12 * s12 * stiff / s11, "l": reach, "d": lost,
            "K": stiff * h * t**3 / 12 / (L + 2 * ends - 2 * lost)}


def flexure_silicon_program(run, _):
    found, levels = hinge(run, "B", "tests/data/theory/silicon-leaf.xml")
    return {"K": levels["closed-form"]["stiffness_Nm_per_rad"], "E_110": found["youngs_Pa"]}


def flexure_errors(g):
    found = arc(g)
    t, r, rho, h, a, L = g["t"], g["r"], g["rho"], g["h"], g["angle"] / 2, found["L"]
    ends, root = 0.35 * h * found["bow"], 0.006 * t + 2.3 * t * (t / r) ** 2 * (rho / t) ** 2
    e, stiff = 2 * (ends + root) / L, g["E"] * h * t**3 / 12 * found["D"]
    x, y, s, c = abs(r * cos(a) - found["xW"]), r * sin(a), sin(a), abs(cos(a))
    return {"ends": ends, "root": root, "error_K": 0.001 + e,
            "error_kx": 0.002 + (y * (e * L * y + 0.6 * rho**2 * c) + 3.2 / 12 * t**3 * s * s) * found["kx"] / stiff,
            "error_ky": 0.002 + (x * (e * L * x + 0.6 * rho**2 * s) + 3.2 / 12 * t**3 * c * c) * found["ky"] / stiff,
            "error_W": e * x + 0.6 * rho**2 / L + 2e-4 * r}


def flexure_errors_program(run, _):
    error = hinge(run, "A")[1]["closed-form"]["error"]
    return {"error_K": error["stiffness"], "error_kx": error["kx"], "error_ky": error["ky"], "error_W": error["centre_m"]}


def flexure_path(g):
    L, t0, t1, h, E = g["L"], g["t0"], g["t1"], g["h"], g["E"]
    sag = (t0 - t1) / 2
    radius = (L**2 / 4 + sag**2) / (2 * sag)

    def width(s):
        """the edge's arc stands on the axis of symmetry, with its nearest place t1/2 from the centre line"""
        y = s - L / 2
        return t1 + 2 * (radius - sqrt(radius**2 - y**2))
    n = 2000
    total = sum((1 if i in (0, n) else 4 if i % 2 else 2) / width(i * L / n) ** 3 for i in range(n + 1)) * L / n / 3
    dL = root_length(t0, g["rho"])
    return {"Re": radius, "quarter": width(L / 4), "dL": dL, "K": E * h / 12 / (total + 2 * dL / t0**3),
            "even": E * h * t0**3 / 12 / (L + 2 * dL)}


def flexure_path_program(run, _):
    return {"K": hinge(run, "C")[1]["closed-form"]["stiffness_Nm_per_rad"]}


def beams(g):
    """length, stiffness 1, the force along y; phi(0) = 0, M(1) = 0"""
    def shoot(moment, n=400):
        state, step = [0.0, moment, 0.0, 0.0], 1 / n

        def rates(v):
            return [v[1], -g["load"] * cos(v[0]), cos(v[0]), sin(v[0])]
        for _ in range(n):
            k1 = rates(state)
            k2 = rates([v + step / 2 * k for v, k in zip(state, k1)])
            k3 = rates([v + step / 2 * k for v, k in zip(state, k2)])
            k4 = rates([v + step * k for v, k in zip(state, k3)])
            state = [v + step / 6 * (a + 2 * b + 2 * c + d) for v, a, b, c, d in zip(state, k1, k2, k3, k4)]
        return state
    low, high = 0.0, g["load"]
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if shoot(middle)[1] < 0 else (low, middle)
    phi, _, x, y = shoot(low)
    hinge_a = arc({"r": 100e-6, "angle": radians(270), "t": 8e-6, "rho": 4e-6, "h": 50e-6})
    limit = 500e6 / (1.5 * 150e9 * hinge_a["fit"])
    return {"rotation": phi, "across": y, "along": 1 - x, "linear": g["load"] / 3, "moment": hinge_a["K"] * limit}


def beams_program(run, _):
    return {"moment": hinge(run, "A")[1]["elastica"]["limit_moment_Nm"]}
