#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Coefficients of the polynomials in src/flexure/quick.h and section_core.h, as C prints them.

Needs python3-mpmath; nothing of the build or the tests does. Weighted least squares in 60 digits,
the weights raised where the error is large (Lawson) until it is nearly even, then rounded to
double. The largest error is printed above each list; the unit tests compare with the functions
themselves.
"""
from mpmath import atanh, cos, cosh, findroot, lu_solve, matrix, mp, mpf, nstr, pi, sin, sinh, sqrt, tan, tanh

mp.dps = 60


def fitted(of, weight, degree, scale, nodes):
    """coefficients of the polynomial nearest to of(z) in weight(z), lowest first, and its error"""
    rows = [[weight(z) * (z / scale) ** k for k in range(degree + 1)] for z in nodes]
    wanted = [weight(z) * of(z) for z in nodes]
    raised = [mpf(1)] * len(nodes)
    for _ in range(12):
        a, b = matrix(len(nodes), degree + 1), matrix(len(nodes), 1)
        for i, row in enumerate(rows):
            root = sqrt(raised[i])
            for k, v in enumerate(row):
                a[i, k] = root * v
            b[i] = root * wanted[i]
        found = lu_solve(a, b)
        off = [abs(sum(v * found[k] for k, v in enumerate(row)) - wanted[i]) for i, row in enumerate(rows)]
        total = sum(r * e for r, e in zip(raised, off))
        raised = [r * e / total * len(nodes) for r, e in zip(raised, off)]
    return [found[k] / scale**k for k in range(degree + 1)], max(off)


def between(low, high, power=1, count=160):
    """Chebyshev's places of the root of this power"""
    return [(low + (high - low) * (1 - cos(pi * (2 * i + 1) / (2 * count))) / 2) ** power for i in range(count)]


def say(name, result, first=()):
    coefficients, off = result
    print(f"{name} (off by {nstr(off, 2)}):")
    print("   ", ", ".join(float(c).hex() for c in [*first, *coefficients]))


def sine_and_cosine():
    places = between(mpf(0), (pi / 4) ** 2 * mpf("1.0001"))
    say("(sin r - r)/r^3 of r^2", fitted(lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, 5, mpf(1), places))
    say("(cos r - 1 + r^2/2)/r^4 of r^2", fitted(lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2, lambda z: z**2, 5, mpf(1), places))


def two_thirds(parts):
    """(1 + d)^(-2/3) for d within half of one of so many equal parts of 1 to 2, and the table for them"""
    rows = []
    for i in range(parts):
        inverse = mpf(float(1 / (1 + (i + mpf("0.5")) / parts)))
        rows.append((inverse, inverse ** (mpf(2) / 3)))
    most = max(abs(rows[i][0] * (1 + mpf(i + j) / parts) - 1) for i in range(parts) for j in (0, 1))
    power = -mpf(2) / 3
    say("(1 + d)^(-2/3)", fitted(lambda d: (1 + d) ** power, lambda d: 1, 7, most, between(-most, most)))
    print("1/m and m^(-2/3):\n   ", ", ".join(f"{{{float(a).hex()}, {float(b).hex()}}}" for a, b in rows))
    print("2^(-2 e/3), e from -5 to 1:\n   ", ", ".join(float(mpf(2) ** (power * e)).hex() for e in range(-5, 2)))


def neutral(most):
    places = between(mpf(0), mpf(most) ** 2)
    say("(1 - u/atanh u)/u^2 of u^2", fitted(lambda z: (1 - sqrt(z) / atanh(sqrt(z))) / z, lambda z: 3, 6, mpf(most) ** 2, places))


def depth(degree, most):
    """over x^4, of denominator the first zeros of (sinh x + sin x)/2x"""
    end = mpf(most) ** 4
    zeros = [4 * findroot(lambda y: tan(y) + tanh(y), (k - mpf(1) / 4) * pi) ** 4 for k in range(1, degree + 1)]
    q = [mpf(1)]
    for zero in zeros:
        q = [(q[i] if i < len(q) else 0) + (q[i - 1] / zero if i else 0) for i in range(len(q) + 1)]
    q = [mpf(float(c)) for c in q]
    below = lambda z: sum(c * z**k for k, c in enumerate(q))
    places = between(mpf(0), mpf(most), 4)

    def bow(z):
        x = z ** (mpf(1) / 4)
        return 2 / x * (cosh(x) - cos(x)) / (sinh(x) + sin(x))

    def inner(z):
        x = z ** (mpf(1) / 4) / 2
        s, c, sh, ch = sin(x), cos(x), sinh(x), cosh(x)
        return (ch * s - sh * c) / (s * c + sh * ch) / x**2

    def outer(z):
        x = z ** (mpf(1) / 4)
        return 4 * (sinh(x) - sin(x)) / (sinh(x) + sin(x)) / x**2

    print("Q:\n   ", ", ".join(float(c).hex() for c in q))
    # f starts from 1 exactly; the other two count times X^2
    say("f Q", fitted(lambda z: (bow(z) * below(z) - 1) / z, lambda z: z / below(z), degree - 1, end, places), [mpf(1)])
    count = lambda z: max(sqrt(z) / 4, mpf("0.001")) / below(z)
    say("-C1 Q", fitted(lambda z: inner(z) * below(z), count, degree, end, places))
    say("edge Q", fitted(lambda z: outer(z) * below(z), count, degree, end, places))


if __name__ == "__main__":
    sine_and_cosine()
    two_thirds(32)
    neutral("0.16")
    depth(7, 8)
