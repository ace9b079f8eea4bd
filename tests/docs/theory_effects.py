# SPDX-License-Identifier: GPL-3.0-or-later
"""The worked examples of docs/theory/effects, written again from their equations. SI in and out. Functions are effect_NAME; the
program's own bound of an effect, and the true change of the largest peak without it, are asked for in the same way everywhere."""
from math import asin, atan2, cos, exp, hypot, log, pi, sin, sqrt, tanh

import theory_flexures

LEVER = "tests/data/theory/lever.xml"
CART = "tests/data/theory/cart.xml"
PORTAL = "tests/data/theory/portal.xml"
STOPPED = "tests/data/theory/stopped.xml"
PLATE = "tests/data/theory/plate.xml"
RING = "tests/data/theory/ring.xml"
EPS0 = 8.8541878128e-12


def simulate(run, device, scene, *options):
    return run("simulate", device, "--scene", scene, "--accuracy", "1e-6", "--json", *options)


def peak(document):
    return max((abs(p["angle_rad"]) for p in document["peaks"]), default=0.0)


def entry(document, effect):
    return next(e for e in document["effects"] if e["id"] == effect)


def left_out(run, device, scene, effect, *options):
    """the bound of the ledger, and by how much the largest peak changes in truth"""
    whole = simulate(run, device, scene, "--effects", "all", *options)
    others = [e["id"] for e in whole["effects"] if e["active"] and e["id"] != effect]
    without = simulate(run, device, scene, "--effects", ",".join(others), *options)
    return {"bound": entry(whole, effect)["bound"], "change": abs(peak(without) / peak(whole) - 1)}


def at_rest(run, device, scene, *options):
    return run("statics", device, "--scene", scene, "--json", *options)


def root(f, low, high):
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if (f(low) > 0) == (f(middle) > 0) else (low, middle)
    return (low + high) / 2


def lever(g):
    """inertia about the foot and angular frequency of the bar on its spring"""
    foot = g["J"] + g["m"] * g["arm"] ** 2
    return foot, sqrt(g["k"] / foot)


def step_peak(zeta):
    """of a damped mode under a constant load, over the static value"""
    return 1 + exp(-pi * zeta / sqrt(1 - zeta * zeta))


def effect_joint_elasticity(g):
    theta = g["torque"] / g["k"]
    return {"theta": theta, "energy": g["k"] * theta**2 / 2, "f": lever(g)[1] / (2 * pi)}


def effect_joint_elasticity_program(run, _):
    return {"theta": at_rest(run, LEVER, "kick")["hinges"][0]["angle_rad"],
            "f": run("modes", LEVER, "--scene", "kick", "--json")["modes"][0]["f_Hz"]}


def effect_joint_damping(g):
    zeta = g["c"] / (2 * sqrt(g["k"] * lever(g)[0]))
    return {"zeta": zeta, "peak": g["torque"] / g["k"] * step_peak(zeta)}


DAMPED = ("--set", "damping=2e-12 N m s/rad")


def effect_joint_damping_program(run, _):
    return {"peak": peak(simulate(run, LEVER, "kick", *DAMPED)), **left_out(run, LEVER, "kick", "joint-damping", *DAMPED)}


def effect_material_damping(g):
    K = theory_flexures.arc(g)["K"]
    foot = g["J"] + g["m"] * g["arm"] ** 2
    omega = sqrt(K / foot)
    return {"K": K, "omega": omega, "c": g["eta"] * K / omega, "zeta": g["eta"] / 2, "peak": g["torque"] / K * step_peak(g["eta"] / 2)}


def effect_material_damping_program(run, _):
    found = simulate(run, RING, "kick", "--hinge-model", "revolute", "--effects", "all")
    return {"peak": peak(found), **left_out(run, RING, "kick", "material-damping", "--hinge-model", "revolute")}


def effect_joint_stop(g):
    def energy(theta):
        return g["torque"] * theta - g["k"] * theta**2 / 2 - g["ks"] * max(0, theta - g["stop"]) ** 2 / 2
    touch = sqrt(2 * energy(g["stop"]) / lever(g)[0])
    return {"free": 2 * g["torque"] / g["k"], "touch": touch, "peak": root(energy, g["stop"], 2 * g["torque"] / g["k"])}


def effect_joint_stop_program(run, _):
    return {"peak": peak(simulate(run, STOPPED, "kick")),
            "far": entry(simulate(run, STOPPED, "kick", "--set", "reach=1 rad"), "joint-stop")["bound"]}


def tip(g, theta):
    return -g["L"] * sin(theta), g["L"] * cos(theta)


def effect_point_spring(g):
    def length(theta):
        x, y = tip(g, theta)
        return hypot(x - g["ax"], y - g["ay"])

    def energy(theta):
        return g["k"] * theta**2 / 2 + g["ks"] * (length(theta) - g["l0"]) ** 2 / 2 - g["F"] * tip(g, theta)[0]
    step = 1e-5
    theta = root(lambda t: energy(t + step) - energy(t - step), -1, 1)
    return {"theta": theta, "l": length(theta), "tension": g["ks"] * (length(theta) - g["l0"])}


def effect_point_spring_program(run, _):
    return {"theta": at_rest(run, LEVER, "push", "--set", "spring=0.5 N/m")["hinges"][0]["angle_rad"]}


def effect_applied_load(g):
    work = g["F"] * g["L"]
    return {"linear": work / g["k"], "theta": root(lambda t: work * cos(t) - g["k"] * t, 0, 1),
            "peak": root(lambda t: work * sin(t) - g["k"] * t * t / 2, 0.1, 1)}


def effect_applied_load_program(run, _):
    return {"theta": abs(at_rest(run, LEVER, "push")["hinges"][0]["angle_rad"]), "peak": peak(simulate(run, LEVER, "push"))}


def effect_gravity(g):
    lean = g["m"] * g["gx"] * g["arm"]

    def energy(theta):
        return g["torque"] * theta - lean * sin(theta) - g["k"] * theta**2 / 2
    most = root(energy, 0.1, 0.4)
    return {"static": lean / g["k"], "peak": most, "less": 1 - most / (2 * g["torque"] / g["k"])}


def effect_gravity_program(run, _):
    return {"peak": peak(simulate(run, LEVER, "weight", "--effects", "all")), **left_out(run, LEVER, "weight", "gravity")}


def effect_initial_velocity(g):
    return {"v": g["arm"] * g["omega0"], "peak": g["omega0"] / lever(g)[1]}


def effect_initial_velocity_program(run, _):
    return {"peak": peak(simulate(run, LEVER, "moving"))}


def shock(g):
    """largest rotation behind a half sine that is shorter than the half period"""
    ratio = pi / g["rise"] / lever(g)[1]
    return abs(2 * ratio * cos(pi / (2 * ratio)) / (ratio**2 - 1))


def effect_base_motion(g):
    static = g["m"] * g["a"] * g["arm"] / g["k"]
    return {"static": static, "ratio": shock(g), "peak": static * shock(g)}


def effect_base_motion_program(run, _):
    return {"peak": peak(simulate(run, LEVER, "shock")), **left_out(run, LEVER, "shaken", "base-motion")}


def sinc(x):
    return sin(x) / x


def effect_nonlinear_hinge(g):
    found = theory_flexures.arc(g)
    L, dL, a, E, theta = found["L"], found["dL"], g["angle"] / 2, g["E"], g["theta"]
    share, area = L / (L + 2 * dL), g["t"] * g["h"]
    bend, shear = found["K"] * (L + 2 * dL), 5 / 6 * E / (2 * (1 + 0.31)) * area
    x = a + share * theta / 2
    z, slope = sinc(2 * x), (cos(x) - sinc(x)) / x
    axial, across = L / (2 * E * area), L / (2 * shear)
    along = L**3 / (8 * bend) * (1 - z) / x**2 + dL * L**2 / (2 * bend) * sinc(x) ** 2 + axial * (1 - z) + across * (1 + z)
    beside = (L**3 / (8 * bend) * (1 + z - 2 * sinc(x) ** 2) / x**2 + share * dL * L**2 / (2 * bend) * slope**2
              + axial * (1 + z) + across * (1 - z))
    return {"delta": theory_flexures.axis_drift({**g, "gap": 1e-6})["delta"], "kx": 1 / along, "ky": 1 / beside,
            "give": g["F"] * along}


def effect_nonlinear_hinge_program(run, _):
    level = theory_flexures.hinge(run, "A")[1]["compliance"]
    return {"delta": level["limit_drift_m"], "kx": level["kx_N_per_m"], "ky": level["ky_N_per_m"]}


def effect_contact(g):
    modulus = g["E"] / (2 * (1 - g["nu"] ** 2))
    relative = g["Rc"] * (g["Rc"] + g["g0"]) / g["g0"]
    half = sqrt(4 * g["F"] * relative / (pi * g["h"] * modulus))
    x = (g["push"] + g["kc"] * g["gap"]) / (g["k"] + g["kc"])
    return {"b": half, "kline": pi * g["h"] * modulus / (2 * log(4 * g["Rc"] / half) - 1), "x": x, "N": g["kc"] * (x - g["gap"])}


def effect_contact_program(run, _):
    return {"x": at_rest(run, CART, "bump")["q"]["plate"][0]}


def effect_friction(g):
    hold, load = g["mu"] * g["N"], g["F"]
    places, sense = [0.0], 1
    while abs(load - g["k"] * places[-1]) > hold:
        places.append(2 * (load - sense * hold) / g["k"] - places[-1])
        sense = -sense
    return {"hold": hold, "first": places[1], "back": places[2], "rest": places[-1], "swings": len(places) - 1,
            "around": hold / g["k"]}


def effect_friction_program(run, _):
    rub = simulate(run, CART, "rub")
    return {"first": rub["travels"][0]["travel_m"], "rest": rub["final"]["q"]["plate"][0],
            "held": simulate(run, CART, "hold")["travels"][0]["travel_m"],
            "around": at_rest(run, CART, "rub")["friction_range"]["within"]["plate"][0]}


def effect_tendon(g):
    def length(theta):
        x, y = tip(g, theta)
        return hypot(g["ex"] - x, g["ey"] - y)

    def lowest(energy):
        return root(lambda t: energy(t + 1e-5) - energy(t - 1e-5), -1, 1)
    pulled = lowest(lambda t: g["k"] * t * t / 2 + g["pull"] * length(t))
    drawn = lowest(lambda t: g["k"] * t * t / 2 + g["kc"] * (length(t) + g["draw"] - length(0)) ** 2 / 2)
    return {"L0": length(0), "pulled": pulled, "drawn": drawn, "T": g["kc"] * (length(drawn) + g["draw"] - length(0))}


def effect_tendon_program(run, _):
    return {"pulled": at_rest(run, LEVER, "cable")["hinges"][0]["angle_rad"],
            "drawn": at_rest(run, LEVER, "winch")["hinges"][0]["angle_rad"]}


def effect_comb_drive(g):
    force = EPS0 * g["h"] * g["N"] * g["V"] ** 2 / g["gap"]
    depth, gap = g["h"], g["plate"]
    return {"force": force, "x": force / g["k"], "pullin": sqrt(8 * g["k"] * gap**3 / (27 * EPS0 * g["l"] * depth))}


def effect_comb_drive_program(run, _):
    pull_in = at_rest(run, CART, "plate", "--effects", "none")["pull_in"][0]
    return {"x": at_rest(run, CART, "comb", "--effects", "none")["q"]["plate"][0], "pullin": pull_in["voltage_V"]}


def bars(gap, width, depth):
    """what the edges of two bars add to C, over eps0 and length, and its slope by the gap"""
    A, root = (-0.049 + 3.028 * sqrt(width / depth) + 8.066 * width / depth) * depth / gap, sqrt(width / depth)
    B, D = 1.993 + 1.472 * root / (1 + root), 4.084 / (1 + 0.449 * sqrt(root)) * sqrt(depth / gap)
    return 2 / pi * log(A + B + D), -2 / pi * (A + D / 2) / (A + B + D) / gap


def effect_fringe_field(g):
    x = g["gap"] / g["w"]
    F = (2 * log(1 + 2 * x) - 2 * log(x) + log(1 + 2 * x) / x) / pi
    plate = bars(g["gp"], g["b"], g["h"])
    end = [0.21 * one + 0.58 * two * more for one, two, more in
           zip(bars(g["gp"], g["b"], g["l"]), bars(2 * g["gp"], g["b"], g["l"]), (1, 2))]

    def pull(at):  # over V^2/2
        edge, ends = bars(g["gp"] - at, g["b"], g["h"])[1], [bars(n * (g["gp"] - at), g["b"], g["l"])[1] for n in (1, 2)]
        return EPS0 * (g["l"] * (g["h"] / (g["gp"] - at) ** 2 - edge) - 2 * g["h"] * (0.21 * ends[0] + 1.16 * ends[1]))
    volts = max(sqrt(2 * g["k"] * at / pull(at)) for at in (g["gp"] * i / 20000 for i in range(5000, 9000)))
    return {"F": F, "share": F * g["gap"] / g["h"], "x": EPS0 * g["N"] * (g["h"] / g["gap"] + F) * g["V"] ** 2 / g["k"],
            "Fp": plate[0], "E": end[0], "more": -g["gp"] ** 2 * (plate[1] / g["h"] + 2 * end[1] / g["l"]), "pullin": volts,
            "left": -g["gp"] ** 2 * plate[1] / g["h"] / 2}


def effect_fringe_field_program(run, _):
    pull_in = at_rest(run, CART, "plate")["pull_in"][0]
    return {"x": at_rest(run, CART, "comb")["q"]["plate"][0], "pullin": pull_in["voltage_V"], "left": pull_in["fringe"]}


def fringe(m, w):
    """F of fringe-field (3), its first and second derivative by the gap"""
    x, ln = m / w, log(1 + 2 * m / w)
    return ((2 * (ln - log(x)) + ln / x) / pi, -ln / (pi * x * x * w), (2 * ln / x - 2 / (1 + 2 * x)) / (pi * x * x * w * w))


def effect_body_compliance(g):
    second = g["h"] * g["w"] ** 3 / 12
    bent = g["L"] ** 3 / (3 * g["E"] * second)
    sheared = 1.2 * g["L"] * 2 * (1 + g["nu"]) / (g["E"] * g["w"] * g["h"])
    return {"bent": bent, "sheared": sheared, "left": 1 / (1 + (bent + sheared) * g["k"])}


def effect_finger_bending(g):
    c11, c12 = 165.7e9, 63.9e9
    E = (c11 - c12) * (c11 + 2 * c12) / (c11 + c12)
    EI = E * g["h"] * g["w"] ** 3 / 12

    def volts(gap):
        return sqrt(3 * EI / (EPS0 * (g["h"] / gap**3 + fringe(gap, g["w"])[2] / 2) * g["L"] ** 4))
    more = 0.0
    for _ in range(200):
        r = (g["V"] / volts(g["gap"])) ** 2 * (g["gap"] / (g["gap"] - g["y"] - more)) ** 3
        more = g["y"] * 1.5 * r / (1 - 1.5 * r)
    n, L = 80, g["L"]
    s = [(i + 0.5) * L / n for i in range(n)]
    green = [[min(a, b) ** 2 * (3 * max(a, b) - min(a, b)) / (6 * EI) * L / n for b in s] for a in s]

    def pull(D):
        near, far = g["gap"] - D, g["gap"] + D
        return EPS0 * g["V"] ** 2 / 2 * (g["h"] / near**2 - g["h"] / far**2 - fringe(near, g["w"])[1] + fringe(far, g["w"])[1])
    u = [0.0] * n
    for _ in range(60):  # the stator's finger comes from the other side
        p = [pull(g["y"] + u[i] + u[n - 1 - i]) for i in range(n)]
        u = [sum(k * q for k, q in zip(row, p)) for row in green]
    beams = max(u[i] + u[n - 1 - i] for i in range(n))
    assert beams < more, "the bound of finger-bending is below its beams"
    return {"E": E, "Vf": volts(g["gap"]), "r": r, "more": more, "beams": beams}


def effect_levitation(g):
    P = g["N"] * g["L"] * EPS0 * g["V"] ** 2 / (2 * g["g"])
    return {"P": P, "z": P / g["k"], "share": P / g["k"] / g["h"]}


def effect_eyelet_friction(g):
    def length(theta):
        x, y = tip(g, theta)
        return hypot(x - g["ex"], y - g["ey"])

    def bend(theta):
        x, y = tip(g, theta)
        return atan2(g["ey"] - y, g["ex"] - x) - atan2(g["ay"] - g["ey"], g["ax"] - g["ex"])

    def rests(sign):
        step = 1e-6
        return root(lambda q: g["k"] * q + g["pull"] * exp(sign * g["mu"] * bend(q)) * (length(q + step) - length(q - step)) / (2 * step),
                    -1, 1)
    q, step = rests(0), 1e-4
    slope = (length(q + step) - length(q - step)) / (2 * step)
    stiff = g["k"] + g["pull"] * (length(q + step) - 2 * length(q) + length(q - step)) / step**2
    return {"beta": bend(q), "without": q, "less": rests(-1), "more": rests(1),
            "range": abs(slope) * g["pull"] * (exp(g["mu"] * bend(q)) - 1) / stiff}


def effect_eyelet_friction_program(run, _):
    rest = at_rest(run, LEVER, "rubbed")
    at, r = rest["hinges"][0]["angle_rad"], rest["friction_range"]
    return {"without": at, "less": at + r["angle_to_rad"]["foot"], "more": at + r["angle_from_rad"]["foot"]}


def effect_temperature(g):
    e = (1 + g["glass"] * g["dT"]) / (1 + g["layer"] * g["dT"]) - 1
    return {"e": e, "theta": asin(e * g["span"] / (2 * g["L"])), "softer": g["beta"] * g["dT"]}


def turned(run, scene):
    return max(abs(h["angle_rad"]) for h in at_rest(run, PORTAL, scene)["hinges"])


def effect_temperature_program(run, _):
    whole = simulate(run, PORTAL, "warm", "--effects", "all")
    return {"theta": turned(run, "warm"), "bound": entry(whole, "temperature")["bound"]}


def effect_residual_stress(g):
    per = (1 - g["nu"]) / g["E"]
    e, kappa = -g["mean"] * per, g["gradient"] * per
    return {"e": e, "theta": asin((1 / (1 + e) - 1) * g["span"] / (2 * g["L"])), "kappa": kappa,
            "rise": kappa * g["span"] ** 2 / 2, "shorter": 1 - sinc(kappa * g["span"] / 2)}


def effect_residual_stress_program(run, _):
    whole = simulate(run, PORTAL, "stressed", "--effects", "all")
    return {"theta": turned(run, "stressed"), "bound": entry(whole, "residual-stress")["bound"]}


def rectangle_m4(a, b):
    p, q = min(a, b), max(a, b)
    series = sum(tanh(m * pi * q / (2 * p)) / m**5 for m in range(1, 400, 2))
    return q * p**3 / 3 * (1 - 192 / pi**5 * p / q * series)


def effect_out_of_plane(g):
    L, w, h, E, G = g["L"], g["w"], g["h"], g["E"], g["E"] / (2 * (1 + g["nu"]))
    EI, J, x = E * w * h**3 / 12, rectangle_m4(w, h), g["rho"] / w
    even = (h * h - w * w) / (h * h + w * w)
    warp = sqrt(E * even**2 * (w * h) ** 3 / 144 / (G * J))
    root = w * (1.07 + 0.215 * log(h / w) - 0.52 * x)
    twist = w * (0.5 - 0.012 * h / w - 0.62 * x)
    Cb, Ct = (L + 2 * root) / EI, (L - 2 * warp * tanh(L / (2 * warp)) + 2 * twist) / (G * J)
    Cz = L**3 / (12 * EI) + 2 * root * (L / 2) ** 2 / EI + 1.2 * L / (G * w * h)
    k = 1 / (Cz + Cb * g["dx"] ** 2 + Ct * g["dy"] ** 2)
    return {"EI": EI, "J": J, "l": warp, "root": root, "Cb": Cb, "Ct": Ct, "k": k, "sag": g["m"] * 9.80665 / k}


def effect_out_of_plane_program(run, _):
    return {"k": run("check", PLATE, "--json")["out_of_plane"][0]["stiffness_N_per_m"]}


def effect_adhesion(g):
    modulus, relative = g["E"] / (2 * (1 - g["nu"] ** 2)), g["R"] * (g["R"] + g["gap"]) / g["gap"]
    a = (2 * g["W"] * relative**2 / (pi * modulus)) ** (1 / 3)
    return {"Rr": relative, "a": a, "opens": g["k"] * g["gap"],
            "P": g["h"] * (sqrt(2 * pi * modulus * a * g["W"]) - pi * modulus * a**2 / (4 * relative))}


def effect_air(g):
    mu = 1.458e-6 * g["T"] ** 1.5 / (g["T"] + 110.4)
    path = mu / g["p"] * sqrt(pi * 287.05 * g["T"] / 2)
    film = mu / (1 + 2 * path / g["gap"]) / g["gap"]
    polar = g["A"] ** 2 / (2 * pi)
    c = film * (g["A"] * g["arm"] ** 2 + polar)
    foot, omega = lever(g)
    zeta = c / (2 * foot * omega)
    return {"mu": mu, "path": path, "Kn": path / g["gap"], "cA": film * g["A"], "c": c, "zeta": zeta,
            "peak": g["torque"] / g["k"] * step_peak(zeta)}


def effect_air_program(run, _):
    return {"peak": peak(simulate(run, LEVER, "film", "--effects", "all")), **left_out(run, LEVER, "film", "air")}


def effect_inertia(g):
    omega = lever(g)[1]
    return {"omega": omega, "off": 2 / (g["rise"] * omega)}


def effect_inertia_program(run, _):
    return left_out(run, LEVER, "slow", "inertia")


def effect_envelope(g):
    static = g["torque"] / g["k"]
    most = 2 * static
    # the linear motion less what it may be wrong by, at the best of many phases
    least = max(static * (1 - cos(x)) * (1 - most * (1 + x / 2)) for x in (pi * i / 20000 for i in range(1, 20001)))
    return {"most": most, "margin": 1 + 4 * most, "floor": least, "bound": static * (1 + 4 * most) / least}


def effect_envelope_program(run, _):
    found = left_out(run, LEVER, "kick", "inertia")
    return found


def effect_costs(g):
    return {"six": g["hinges"] * g["each"], "slower": g["general"] / g["fast"]}


def effect_costs_program(run, _):
    return {"four": entry(run("statics", PORTAL, "--scene", "warm", "--json"), "joint-elasticity")["cost"]}
