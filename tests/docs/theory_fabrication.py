# SPDX-License-Identifier: GPL-3.0-or-later
"""The worked examples of the pages about drawing, masks and processes, written again from their equations. SI in and out."""
import re
from math import acos, asin, asinh, ceil, cos, exp, floor, log, pi, sin, sqrt, tan

import theory_flexures

COUPONS = "tests/data/theory/coupons.csv"


def masks(g):
    # an outline that is a full circle: chords of the largest step that keeps the sagitta
    n = ceil(2 * pi / (2 * acos(1 - g["eps"] / g["R"])))
    step = 2 * pi / n
    lost, length = n * g["R"] ** 2 / 2 * (step - sin(step)), 2 * n * g["R"] * sin(step / 2)
    return {"chords": n, "edge": g["eps"] + g["g"] / sqrt(2), "lost": lost,
            "bound": lost + length * g["g"] / sqrt(2) + n * g["g"] ** 2 / 4, "radius": g["w"] / sqrt(2),
            "print": 1.5 * sqrt(g["lambda"] * (g["gap"] + g["h"] / 2)), "tip": g["w"] / (2 * tan(g["a"] / 2))}


def mask_files(g):
    parts = ceil(g["w"] / (2 * pi / 3))
    chord = sqrt(8 * g["R"] * g["eps"])
    return {"parts": parts, "bulge": tan(g["w"] / parts / 4), "chord": chord, "change": chord**2 / g["R"],
            "beside": sin(pi * g["most"] / g["chords"])}


def schedule(g):
    """longest paths in the network of three starts; the window is the arc back from step 3 to step 1"""
    start2 = g["p1"] + g["pause"]
    start3 = start2 + g["p2"]
    slack = g["p1"] + g["window"] - start3
    # step 2 may wait until the window closes, its end as near to step 3 as it likes
    return {"start3": start3, "slack": slack, "tight": start3 - g["p1"], "wait": g["pause"] + slack}


def calibrate(g):
    e_line, e_space = (g["line"] - g["drawn"]) / 2, (g["drawn"] - g["space"]) / 2
    mean, u = (e_line + e_space) / 2, g["u"] / 2
    u_read, spread = u / sqrt(2), sqrt(g["u_flow"] ** 2 + g["printed"] ** 2 / 3)
    return {"e_line": e_line, "e_space": e_space, "edge": mean + g["planned"], "u_read": u_read, "spread": spread,
            "u_edge": sqrt(u_read**2 + spread**2),
            "chi2": sum(((e - mean) / u) ** 2 for e in (e_line, e_space))}


def pack(run):
    text = run("calibrate", COUPONS, "--flow", "al-masked-rie")
    return {name: (float(value), float(u)) for name, value, u in re.findall(r'<q id="([\w.-]+)" value="([^"]+)" u="([^"]+)"', text)}


def calibrate_program(run, _):
    value, u = pack(run)["made.al-edge"]
    return {"edge": value * 1e-6, "u_edge": u * 1e-6}


def measurements(g):
    E, u_e = g["D"] * (1 + g["over"]), g["u_w"] / 2 / sqrt(6)
    return {"u_e": u_e, "u_A": sqrt((g["u_w"] / 2) ** 2 / 5 + u_e**2 + ((1 - g["A"]) * g["u_d"]) ** 2) / E,
            "range": 2 * g["gauge"] / g["D"]}


def measurements_program(run, _):
    flow = run("check", "docs/gallery/reference-six-bar/device.xml", "--measurements", "all", "--json")["flows"][0]
    item = {x["id"]: x for x in flow["measurements"]["ranked"]}
    return {"u_e": item["made.al-edge"]["u_measured"] * 1e-6, "u_A": item["rie.A"]["u_measured"],
            "narrower": item["rie.A"]["narrowing"]}


def transmission(x):
    """Knudsen's, of a slot x times as deep as wide"""
    if x < 1e-3:
        return 1 - x / 2 + x * x / 4 - x**3 / 24
    s = sqrt(1 + x * x)
    return (1 + s - x) / 2 - 1.5 * (x - asinh(x)) ** 2 / (x**3 + 3 * x * x + 4 - (x * x + 4) * s)


def transport(w, depth, n=400):
    """J(w, D) by Simpson's rule"""
    return depth / n / 3 * sum((1 if i in (0, n) else 4 if i % 2 else 2) * (1 / transmission(i * depth / n / w) - 1) for i in range(n + 1))


def process(g):
    J1, J2 = (transport(g[w] - 2 * g["edge"], g[d]) for w, d in (("w1", "d1"), ("w2", "d2")))
    S = (g["d2"] - g["d1"]) / (J1 - J2)
    rate = g["D"] / g["t"]
    return {"J1": J1, "S_meas": S, "R_meas": (g["d1"] + S * J1) / g["t"],
            "t_slot": (g["D"] + g["S"] * transport(g["w1"], g["D"])) / rate,
            "plating": g["copper"] * g["density"] * 2 * 96485.33212 / (g["molar"] * g["current"])}


def process_program(run, _):
    found = pack(run)
    return {"S_meas": found["rie.S"][0], "R_meas": found["rie.R"][0] * 1e-6 / 60}


def etching(g):
    def ratio(E):
        top, bottom = g["w"] - 2 * (1 - g["A"]) * E, g["w"] - 2 * (1 - g["A"]) * (E - g["D"])
        if bottom == top:
            return (top / g["w"]) ** 3
        return (max(bottom, 0) ** 4 - max(top, 0) ** 4) / (4 * (bottom - top) * g["w"] ** 3)

    def left(S):
        """(3) at mid-depth by plain iteration: m, and E"""
        m = 0.0
        for _ in range(200):
            w = g["w"] - 2 * m
            E = (1 + g["overrun"]) * (g["D"] + (S * transport(w, g["D"]) if S else 0))
            m = (1 - g["A_gap"]) * (E - 0.5 * g["D"])
        return m, E
    m0, m1 = left(0)[0], left(g["S"])
    return {"top": g["w"] - 2 * (1 - g["A"]) * g["D"], "ratio": ratio(g["D"]), "over": ratio((1 + g["overrun"]) * g["D"]),
            "gone": 1 - g["w"] / (2 * g["D"]), "b0": g["w"] - 2 * (m0 + g["wet"]), "b1": g["w"] - 2 * (m1[0] + g["wet"]),
            "time": m1[1] / (50e-6 / 5400)}


def films(g):
    low, high = 0.0, g["E"]
    for _ in range(60):
        z = (low + high) / 2
        low, high = (z, high) if z + g["S"] * transport(g["w"], z) < g["E"] else (low, z)
    inner = sqrt(g["r1"] ** 2 - g["t"] ** 2)
    return {"inner": inner, "cut": sqrt(g["r2"] ** 2 - g["t"] ** 2) - inner, "z": low}


def wafer(g):
    """dies whose far corners lie in the circle, in the best of four centrings; unit squares likewise"""
    def count(radius, die, pitch, shift_x, shift_y):
        n = int(radius / pitch) + 2
        return sum(1 for i in range(-n, n + 1) for j in range(-n, n + 1)
                   if (abs((i + shift_x) * pitch) + die / 2) ** 2 + (abs((j + shift_y) * pitch) + die / 2) ** 2 <= radius**2 * (1 + 1e-12))
    usable = g["R"] - g["e"]
    n = int(g["n"])
    squares = count(g["n"], 1, 1, 0.5, 0.5)
    if squares != 4 * sum(floor(sqrt(n * n - k * k)) for k in range(1, n + 1)):
        raise RuntimeError("the closed form does not count the unit squares")
    return {"centred": count(usable, g["die"], g["pitch"], 0, 0), "dies": max(count(usable, g["die"], g["pitch"], x, y) for x in (0, 0.5) for y in (0, 0.5)), "squares": squares,
            "reach": sqrt(g["R"] ** 2 - (g["flat"] / 2) ** 2) - g["e"]}


def as_fabricated(g):
    drawn = theory_flexures.arc(g)
    made = theory_flexures.arc({**g, "t": g["t"] - 2 * g["edge"], "rho": g["rho"] + g["edge"],
                                "angle": g["angle"] + 2 * g["edge"] / g["r"]})
    flare = g["h"] * tan(g["slope"])
    return {"K_edge": made["K"] / drawn["K"] - 1, "flare": flare, "section": (flare / g["t"]) ** 2, "per_um": 3 * 0.2e-6 / g["t"]}


def as_fabricated_program(run, g):
    def stiffness(*options):
        found = run("hinge", theory_flexures.DEVICE, "--level", "closed-form", "--json", *options)["hinges"]
        return next(h for h in found if h["id"] == "A")["used_stiffness_Nm_per_rad"]
    made = stiffness("--set", f"flexure[arc]/@width={(g['t'] - 2 * g['edge']) * 1e6:g} um",
                     "--set", f"flexure[arc]/@fillet={(g['rho'] + g['edge']) * 1e6:g} um",
                     "--set", f"flexure[arc]/@angle={g['angle'] + 2 * g['edge'] / g['r']:.12g} rad")
    return {"K_edge": made / stiffness() - 1}


def limits_of_materials(g):
    m, Kt = g["m"], 0.944 + 0.2113 * (g["t"] / g["rho"]) ** (2 / 3)
    area = ((g["L"] * g["h"] + g["L"] * g["t"] / (m + 1)) / Kt**m
            + 2 * (pi / 2 * g["rho"] * g["h"] + g["rho"] * g["t"] / (m + 1)))
    sigma = g["sigma0"] * (g["A0"] / area * log(1 / (1 - g["P"]))) ** (1 / m)
    half = g["peak"] / 2  # from 0 to the peak: amplitude and mean are half of it
    equal = sqrt((half + half) * half)
    return {"Kt": Kt, "A_eff": area, "sigma": sigma, "sigma_ar": equal,
            "D": g["N"] / (g["N1"] * (equal / g["sigma1"]) ** (1 / g["b"])), "u": equal / (g["sigma1"] * (g["N"] / g["N1"]) ** g["b"])}


def limits_of_materials_program(run, _):
    found = run("check", "tests/data/theory/silicon-leaf.xml", "--json", "--corners", "none", "--advice", "none",
                "--effects", "joint-elasticity,applied-load")
    return {"sigma": found["hinges"][0]["limit_Pa"]}


def tradeoff(g):
    decades = log(g["err0"] / g["err1"]) / log(10)
    return {"digit": (g["c1"] / g["c0"]) ** (1 / decades) - 1, "order": log(g["err0"] / g["err1"]) / log(g["c1"] / g["c0"]),
            "stiff": 6 * g["e"] / g["w"], "exact": (1 + 2 * g["e"] / g["w"]) ** 3 - 1}


def layout(g):
    r, a, t, rho = g["r"], g["angle"] / 2, g["t"], g["rho"]
    ahead, inner = asin(rho / (r - t / 2 - rho)), r - t / 2
    corner = max(4.2e-6 / sin(a), r - max(40e-6, 4 * t), r / 2)
    step = 2 * (g["w"] + g["gap"])
    return {"g": ahead, "cut": a - ahead, "most": min((inner**2 - (corner + 1e-6) ** 2) / (2 * inner), 0.3 * inner),
            "first": -(g["n"] - 1) / 2 * step, "last": g["n"] / 2 * step, "far": g["p"] / sqrt(2) - g["D"] / 2,
            "sweep": 2 * asin(g["c"] / 2 / g["R"]), "beside": sqrt(g["R"] ** 2 - g["c"] ** 2 / 4),
            "theta": g["strain"] * 2 * g["L"] / g["O"] * (1 - g["wp"] ** 2 / (2 * g["L"] ** 2)) / (1 + 4 / 3 * (g["wp"] / g["O"]) ** 2)}


def release(g):
    need = g["p"] / sqrt(2) - g["D"] / 2
    bears, inertia = g["S"] * g["h"] * g["wt"] ** 2 / 6, g["h"] * g["wt"] ** 3 / 12  # moment; second moment of the section
    free, b = bears / g["at"], g["Lt"] - g["at"]
    return {"need": need, "lost": g["a"] / 2 * (1 - sqrt(g["s"])), "run": need * (1 + g["E"]), "t": need / g["R"],
            "Pfree": free, "way": free * g["at"] ** 3 / (3 * g["Et"] * inertia),
            "Pheld": bears / max(g["at"] ** 2 * b, g["at"] * b**2) * g["Lt"] ** 2}


def plates(g):
    overlay = g["o1"] + g["o2"]
    return {"o": overlay, "side": g["b"] + 2 * overlay, "far": sqrt(2) * (g["m"] + 2 * g["g"]),
            "least": g["d"] + overlay}


def lost(cantilever):
    """largest q of w'''' = q/(1 - w) over all deflections, shot from the tip, or from the middle of a clamped strip"""
    def end(w, x):
        y = [w, x[0], 0.0, 0.0] if cantilever else [w, 0.0, x[0], 0.0]
        steps = 200
        h = (1 if cantilever else 0.5) / steps

        def slope(y):
            return y[1], y[2], y[3], x[1] / (1 - y[0])
        for _ in range(steps):
            a = slope(y)
            b = slope([p + h / 2 * q for p, q in zip(y, a)])
            c = slope([p + h / 2 * q for p, q in zip(y, b)])
            d = slope([p + h * q for p, q in zip(y, c)])
            y = [p + h / 6 * (i + 2 * j + 2 * k + m) for p, i, j, k, m in zip(y, a, b, c, d)]
        return y[0], y[1]

    x, most = [-0.13, 0.8] if cantilever else [-1.6, 38.0], 0.0
    for i in range(10, 70):
        for _ in range(8):
            r, e = end(i / 100, x), [1e-6 * max(1, abs(x[0])), 1e-6 * x[1]]
            p, q = end(i / 100, [x[0] + e[0], x[1]]), end(i / 100, [x[0], x[1] + e[1]])
            j = [[(p[0] - r[0]) / e[0], (q[0] - r[0]) / e[1]], [(p[1] - r[1]) / e[0], (q[1] - r[1]) / e[1]]]
            det = j[0][0] * j[1][1] - j[0][1] * j[1][0]
            x = [x[0] - (r[0] * j[1][1] - r[1] * j[0][1]) / det, x[1] - (r[1] * j[0][0] - r[0] * j[1][0]) / det]
        most = max(most, x[1])
    return most


def stiction(g):
    stiff, held = g["E"] * g["t"] ** 3 * g["g"] ** 2 / g["L"] ** 4, lost(False)
    more = 1 + g["t"] / g["w"]
    return {"held": held, "free": lost(True), "mine": held * stiff / 12 / more / (2 * g["gamma"]),
            "theirs": 128 / 15 * stiff / g["gamma"] / more, "tip": 2 / 9 * stiff / g["gamma"] / more,
            "peel": 128 / 5 * stiff / g["W"], "peeltip": 3 / 8 * stiff / g["W"],
            "plate": g["k"] * g["g"] ** 2 / (8 * g["A"])}


def wiring(g):
    """Paschen's law with p d in Torr m; A, B per m and Torr"""
    A, B, torr = 15e2, 365e2, 760.0

    def volts(d, gamma):
        loss = log(1 + 1 / gamma)
        least = exp(1) * loss / A
        return B * least if torr * d < least else B * torr * d / (log(A * torr * d) - log(loss))
    return {"E": g["U"] / g["d"], "low": volts(g["d"], 0.02), "high": volts(g["d"], 0.005),
            "at": exp(1) * log(201) / A / torr, "farlow": volts(g["far"], 0.02), "farhigh": volts(g["far"], 0.005)}


def wiring_program(run, _):
    gaps = run("check", "docs/gallery/comb-stage/device.xml", "--json")["flows"][0]["wiring"]["gaps"]
    low, high = gaps[2]["breakdown_V"]
    return {"farlow": low, "farhigh": high}


def contours(g):
    R, w, eps = g["R"], g["w"], g["eps"]
    n = ceil(w / (2 * acos(1 - eps / R)))
    step = w / n
    kappa = step / sin(step)
    rho = n * kappa / (1 + sqrt(1 + n * (n - 2) * kappa))
    kept = R * R / 2 * sin(step) * ((n - 2) * rho**2 + 2 * rho)  # two end triangles have one vertex on the arc
    if abs(kept - w * R * R / 2) > 1e-12 * R * R:
        raise RuntimeError("the polygon does not have the area of its arc")
    return {"n": n, "sagitta": R * (1 - cos(step / 2)), "lost": n * R * R / 2 * (step - sin(step)),
            "A": R * R / 2 * (w - sin(w)), "out": R * (rho - 1),
            "gained": 2 * pi * g["disc"] * g["d"] + pi * g["d"] ** 2}


def continuum(g):
    """the compliance at W is diag(1/kx, 1/ky, 1/K); seen from P = W + (px, py) a rotation moves P by (-py, px)"""
    K, x, y = g["K"], g["px"], g["py"]
    # a force at P has a moment about W, so displacements of P couple with rotations
    C_xx, C_yy, C_xy = 1 / g["kx"] + y * y / K, 1 / g["ky"] + x * x / K, -x * y / K
    C_xth, C_yth, C_thth = -y / K, x / K, 1 / K
    wx, wy = -C_yth / C_thth, C_xth / C_thth
    xx, yy, xy = C_xx - C_xth**2 / C_thth, C_yy - C_yth**2 / C_thth, C_xy - C_xth * C_yth / C_thth
    if abs(xy) > 1e-9 * xx:
        raise RuntimeError("the compliance at W still couples x and y")
    return {"C_xth": C_xth, "C_yth": C_yth, "wx": wx, "wy": wy, "K_back": 1 / C_thth, "kx_back": 1 / xx, "ky_back": 1 / yy,
            "mesh": abs(g["fine"] - g["coarse"]) / (1.5**2 - 1) / g["fine"]}
