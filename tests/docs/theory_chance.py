# SPDX-License-Identifier: GPL-3.0-or-later
"""The worked example of the page about chance, written again from its equations."""
from math import erfc, exp, log, log1p, sqrt


def normal_cdf(u):
    return erfc(-u / sqrt(2)) / 2


def chance(g):
    s1, s2 = sqrt(log1p(g["v1"] ** 2)), sqrt(log1p(g["v2"] ** 2))
    r = log1p(g["rho"] * g["v1"] * g["v2"]) / (s1 * s2)
    # ln U = ln x1 + ln x2 with z1 = u1, z2 = r u1 + sqrt(1 - r^2) u2
    slope1, slope2 = s1 + r * s2, s2 * sqrt(1 - r * r)
    mean, sd = log(g["mean"]) - s1**2 / 2 - s2**2 / 2, sqrt(slope1**2 + slope2**2)
    beta = -mean / sd
    p = normal_cdf(-beta)
    return {"r": r, "beta": beta, "P": p, "share": (slope1 / sd) ** 2,
            "cv": sqrt((normal_cdf(-2 * beta) * exp(beta**2) / p**2 - 1) / g["N"]), "counted": sqrt((1 - p) / p / g["N"]),
            "none": 1 - 0.025 ** (1 / g["N"])}
