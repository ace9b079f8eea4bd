# SPDX-License-Identifier: GPL-3.0-or-later
"""The worked examples of the pages about motion, rest, workspace and verdict, written again from their equations. SI in and out."""
from math import acos, atan2, cos, hypot, pi, sin, sqrt

import theory_flexures

FLEXURES = "tests/data/theory/flexures.xml"
MAST = "tests/data/theory/mast.xml"
SLIDER = "tests/data/theory/slider.xml"
SIX_BAR = "docs/gallery/reference-six-bar/device.xml"


def verdict(g):
    hinge = theory_flexures.arc(g)
    theta = g["torque"] / hinge["K"]
    turn = g["axis"] + theta / 2
    fx, fy = g["force"] * cos(turn), -g["force"] * sin(turn)
    moment = {side: g["torque"] + hinge["xW"] * fy + g["r"] * (fx * sin(b) - fy * cos(b))
              for side, b in (("low", -g["angle"] / 2), ("high", g["angle"] / 2))}
    inside = 0.0  # largest |M| between the ends, without the roots' concentration
    for k in range(-2, 3):
        b = atan2(fx, -fy) + k * pi
        if abs(b) <= g["angle"] / 2:
            inside = max(inside, abs(g["torque"] + hinge["xW"] * fy + g["r"] * (fx * sin(b) - fy * cos(b))))
    x = g["t"] / g["rho"]
    tension = 0.4675 + 0.2494 * x ** (2 / 3) + 0.5447 * x**0.3
    strain = inside / hinge["Kt"] * hinge["bound"] / hinge["K"]
    for side, b in (("low", -(g["angle"] + theta) / 2), ("high", (g["angle"] + theta) / 2)):  # a root turns with its body
        axial = -fx * sin(b) + fy * cos(b)
        strain = max(strain, hinge["bound"] / hinge["K"] * abs(moment[side]) + tension * abs(axial) / (g["E"] * g["t"] * g["h"]))
    limit = g["limit"] / (g["safety"] * g["E"])
    return {"theta": theta, "Fx": fx, "Fy": fy, **moment, "Ktt": tension, "N": axial, "strain": strain, "U": strain / limit}


def verdict_program(run, _):
    found = run("check", FLEXURES, "--json", "--corners", "none", "--advice", "none", "--effects", "joint-elasticity,applied-load",
                "--hinge-model", "revolute")["hinges"][0]
    return {"theta": found["peak_angle_rad"], "strain": found["peak_strain"], "U": found["utilisation"]}


def dynamics(g):
    foot = g["J"] + g["m"] * g["arm"] ** 2
    omega = sqrt(g["k"] / foot)
    return {"foot": foot, "omega": omega, "peak": 2 * g["torque"] / g["k"], "t_peak": pi / omega,
            "force": g["m"] * g["arm"] * g["torque"] / foot}


def kick(run, *options):
    return run("simulate", MAST, "--scene", "kick", "--accuracy", "1e-6", "--json", *options)


def dynamics_program(run, _):
    found = kick(run)
    peak, force = found["peaks"][0], found["reactions"][0]
    return {"peak": peak["angle_rad"], "t_peak": peak["t_s"], "force": force["force_N"]}


def methods(g):
    """M a + G' l = Q, G a = 0 for one bar whose pin is c below its centre of mass: G = (1, 0, c; 0, 1, 0)"""
    across = g["m"] * g["c"]
    alpha = g["torque"] / (g["J"] + across * g["c"])
    answers = {"alpha": alpha, "lambda_x": across * alpha}
    for digits in (3, 4, 5):
        answers[f"filter_{digits}"] = 1 - (1e-8 / (10.0 ** (-2 * digits) + 1e-8)) ** 6
    return answers


def methods_program(run, _):
    return {f"peak_{letter}": kick(run, "--method", name)["peaks"][0]["angle_rad"]
            for letter, name in zip("abcd", ("chain", "minimal", "svd", "udwadia-kalaba"))}


def assembly(g):
    def piston(theta):
        return g["r"] * cos(theta) + sqrt(g["l"] ** 2 - (g["r"] * sin(theta)) ** 2)
    step, theta = 1e-3, g["theta"]
    slope = (piston(theta - 2 * step) - 8 * piston(theta - step) + 8 * piston(theta + step) - piston(theta + 2 * step)) / (12 * step)
    curve = (-piston(theta - 2 * step) + 16 * piston(theta - step) - 30 * piston(theta) + 16 * piston(theta + step)
             - piston(theta + 2 * step)) / (12 * step**2)
    return {"x": piston(theta), "v": slope * g["omega"], "a": curve * g["omega"] ** 2, "gap": hypot(g["guess"], 1e-3)}


def assembly_program(run, _):
    found = run("assemble", SLIDER, "--json")
    return {"x": found["after"]["piston"][0], "v": found["velocity"]["piston"][0], "a": found["acceleration"]["piston"][0],
            "gap": found["gap_before_m"]}


def statics_and_modes(g):
    foot = g["J"] + g["m"] * g["L"] ** 2 / 4
    theta = g["torque"] / g["k"]
    for _ in range(200):
        theta = (g["torque"] + g["P"] * g["L"] * sin(theta)) / g["k"]
    return {"theta": theta, "f_rest": sqrt(g["k"] / foot) / (2 * pi),
            "f_lean": sqrt((g["k"] - g["P"] * g["L"] * cos(theta)) / foot) / (2 * pi), "buckling": g["k"] / g["L"]}


def statics_and_modes_program(run, _):
    path = run("statics", MAST, "--scene", "press", "--path", "--json")["path"]
    split = next(e for e in path["events"] if e["kind"] == "bifurcation")
    return {"theta": run("statics", MAST, "--scene", "lean", "--json")["hinges"][0]["angle_rad"],
            "f_rest": run("modes", MAST, "--scene", "lean", "--json")["modes"][0]["f_Hz"],
            "f_lean": run("modes", MAST, "--scene", "lean", "--at", "equilibrium", "--json")["modes"][0]["f_Hz"],
            "buckling": split["load_factor"] * 2e-3}


POINTS = {"A": (0.70e-3, 0.15e-3), "B": (0.20e-3, 1.40e-3), "C": (0.80e-3, 2.70e-3), "D": (2.20e-3, 2.75e-3),
          "E": (2.85e-3, 1.45e-3), "F": (2.30e-3, 0.15e-3)}


def workspace(g):
    middle = (1.5e-3, 2.875e-3)

    def moved(point):
        x, y, c, s = point[0] - middle[0], point[1] - middle[1], cos(g["phi"]), sin(g["phi"])
        return middle[0] + g["x"] + c * x - s * y, middle[1] + g["y"] + s * x + c * y

    def leg(o, elbow, q, to):
        """alpha and beta with the platform's point at `to`"""
        first, second = hypot(elbow[0] - o[0], elbow[1] - o[1]), hypot(q[0] - elbow[0], q[1] - elbow[1])
        side = 1 if (elbow[0] - o[0]) * (q[1] - elbow[1]) - (elbow[1] - o[1]) * (q[0] - elbow[0]) > 0 else -1
        v = to[0] - o[0], to[1] - o[1]
        beta = side * acos((v[0] ** 2 + v[1] ** 2 - first**2 - second**2) / (2 * first * second))
        return atan2(v[1], v[0]) - atan2(second * sin(beta), first + second * cos(beta)), beta
    answers = {}
    for names, sense in (("ABC", 1), ("FED", -1)):
        o, elbow, q = (POINTS[n] for n in names)
        drawn, now = leg(o, elbow, q, q), leg(o, elbow, q, moved(q))
        turns = [now[0] - drawn[0], now[1] - drawn[1]]
        turns.append(g["phi"] - sum(turns))
        answers.update({name: sense * turn for name, turn in zip(names, turns)})
    c = moved(POINTS["C"])
    answers["d"] = hypot(c[0] - POINTS["A"][0], c[1] - POINTS["A"][1])
    if "opposite" not in g:
        answers["R_A"] = leg_force(g, workspace({**g, "x": -g["x"], "y": -g["y"], "phi": -g["phi"], "opposite": True}))
    return answers


def leg_force(g, angle):
    """size of the force of the left leg from its hinges' moments, no outer force on its links"""
    at, phi, link = complex(*POINTS["A"]), 0.0, []
    for hinge, towards in (("A", "B"), ("B", "C")):
        phi += angle[hinge]
        drawn = complex(*POINTS[towards]) - complex(*POINTS[hinge])
        link.append(drawn * complex(cos(phi), sin(phi)))
        at += link[-1]
    m_A, m_B, m_C = (g["K_" + name] * angle[name] for name in "ABC")
    a, b = link
    return abs(((m_B - m_A) * b - (m_C - m_B) * a) / (a.conjugate() * b).imag)


def workspace_program(run, g):
    flow = run("workspace", SIX_BAR, "--flow", "al-masked-rie", "--json")["flows"][0]
    found = next(h for h in flow["required"][0]["hinges"] if h["id"] == "A")
    over = found["angle_rad"][1] / workspace(g)["A"] - 1
    if not 0 <= over <= 1e-3:
        raise RuntimeError(f"the proved range of hinge A ends {over} from what a pose in it has")
    held = run("check", SIX_BAR, "--json")["workspace"]["actuation"]
    worst = next(h for h in held if h["id"] == "A" and h["flow"] == "al-masked-rie")
    if worst["pose"][0] * g["x"] > 0 or worst["actuation"] != "wrench on the platform":
        raise RuntimeError(f"hinge A is strained most at {worst['pose']} by {worst['actuation']}")
    return {"over": over, "R_A": worst["joint_force_N"]}


def hinge_models(g):
    hinge = theory_flexures.arc(g)
    theta = g["torque"] / hinge["K"]
    return {"theta": theta, "drift": theory_flexures.axis_drift({**g, "theta": theta, "gap": 1e-6})["delta"]}


def hinge_models_program(run, _):
    found = {level: run("statics", FLEXURES, "--scene", "turn", "--hinge-model", level, "--json")
             for level in ("revolute", "compliance", "elastica")}
    place = {level: document["q"]["arm"] for level, document in found.items()}

    def between(one, two):
        return hypot(place[one][0] - place[two][0], place[one][1] - place[two][1])
    return {"theta": found["compliance"]["hinges"][0]["angle_rad"], "drift": between("compliance", "revolute"),
            "beam": between("elastica", "compliance")}


def integrators(g):
    rho = g["rho"]
    alpha_m, alpha_f = (2 * rho - 1) / (rho + 1), rho / (rho + 1)

    def oscillator(n):
        """u'' = -u from (1, 0) over one radian by the classical method of order 4"""
        u, v, h = 1.0, 0.0, 1 / n
        for _ in range(n):
            k1, l1 = v, -u
            k2, l2 = v + h / 2 * l1, -(u + h / 2 * k1)
            k3, l3 = v + h / 2 * l2, -(u + h / 2 * k2)
            k4, l4 = v + h * l3, -(u + h * k3)
            u, v = u + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
        return abs(u - cos(1))
    return {"alpha_m": alpha_m, "alpha_f": alpha_f, "gamma": 0.5 - alpha_m + alpha_f, "beta": (1 - alpha_m + alpha_f) ** 2 / 4,
            "error_8": oscillator(8) / cos(1), "fall": oscillator(8) / oscillator(16), "peak": 2 * g["torque"] / g["k"]}


def integrators_program(run, _):
    return {name: kick(run, "--integrator", name)["peaks"][0]["angle_rad"] for name in ("dop853", "radau5", "dopri5")}


def clearance(given):
    turn = abs(given["tb"] - given["ta"])
    s = given["u"] + turn * given["r"] + 0.5 * (given["ta"] ** 2 * given["la"] + given["tb"] ** 2 * given["lb"])
    return {"s": s, "bound": given["D"] - s, "low": given["D"] - given["k"] * given["M"] - 2 * given["e"]}


def probes(g):
    theta = 0.0
    for _ in range(100):
        theta = g["F"] * g["L"] * cos(theta) / g["K"]
    return {"up": g["L"] * sin(theta), "torque": -g["K"] * theta, "k": g["K"] / g["L"] ** 2,
            "f": sqrt(g["K"] / (g["J"] + g["m"] * g["r"] ** 2)) / (2 * pi)}


def probes_program(run, _):
    paddle = "tests/data/probes/paddle.xml"
    rest = {p["id"]: p["value"] for p in run("statics", paddle, "--json")["probes"]}
    small = {p["id"]: p["value"] for p in run("modes", paddle, "--json")["probes"]}
    return {"up": rest["up"], "torque": rest["spring"], "k": small["stiffness"], "f": small["frequency"]}
