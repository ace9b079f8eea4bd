# SPDX-License-Identifier: GPL-3.0-or-later
"""What every checker of a workspace's certificate reads it with."""
import math


class Refused(Exception):
    """the certificate does not prove what it says"""


def number(text):
    if not isinstance(text, str):
        raise Refused("numbers are written as their bits")
    value = float.fromhex(text)
    if not math.isfinite(value):
        raise Refused("a number is not finite")
    return value


def vector(pair):
    x, y = (number(t) for t in pair)
    return x, y
