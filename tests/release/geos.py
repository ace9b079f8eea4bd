# SPDX-License-Identifier: GPL-3.0-or-later
"""A few calls of the GEOS library: union, difference, buffers with round corners, areas."""
import ctypes
import ctypes.util

NAME = ctypes.util.find_library("geos_c") or "libgeos_c.so.1"


class Geos:
    def __init__(self):
        self.c = ctypes.CDLL(NAME)
        self.c.GEOS_init_r.restype = ctypes.c_void_p
        self.h = ctypes.c_void_p(self.c.GEOS_init_r())
        self.made, geometry = [], ctypes.c_void_p
        self.c.GEOSGeom_destroy_r.argtypes = [ctypes.c_void_p, geometry]
        for name, arguments in {"GEOSGeomFromWKT_r": [ctypes.c_char_p], "GEOSUnaryUnion_r": [geometry],
                                "GEOSDifference_r": [geometry] * 2, "GEOSIntersection_r": [geometry] * 2,
                                "GEOSBuffer_r": [geometry, ctypes.c_double, ctypes.c_int],
                                "GEOSClipByRect_r": [geometry] + [ctypes.c_double] * 4,
                                "GEOSBoundary_r": [geometry]}.items():
            function = getattr(self.c, name)
            function.restype = geometry
            function.argtypes = [ctypes.c_void_p] + arguments
        for name in ("GEOSArea_r", "GEOSDistance_r"):
            getattr(self.c, name).restype = ctypes.c_int
        self.c.GEOSArea_r.argtypes = [ctypes.c_void_p, geometry, ctypes.POINTER(ctypes.c_double)]
        self.c.GEOSDistance_r.argtypes = [ctypes.c_void_p, geometry, geometry, ctypes.POINTER(ctypes.c_double)]

    def of(self, g):
        if not g:
            raise RuntimeError("GEOS gives nothing")
        self.made.append(ctypes.c_void_p(g))
        return self.made[-1]

    def free(self):
        """everything that was made"""
        for g in self.made:
            self.c.GEOSGeom_destroy_r(self.h, g)
        self.made = []

    def polygons(self, rings):
        text = ",".join("((%s))" % ",".join("%.6f %.6f" % tuple(p) for p in list(ring) + [ring[0]]) for ring in rings)
        parts = self.of(self.c.GEOSGeomFromWKT_r(self.h, ("MULTIPOLYGON(%s)" % text).encode()))
        return self.of(self.c.GEOSUnaryUnion_r(self.h, parts))

    def point(self, x, y):
        return self.of(self.c.GEOSGeomFromWKT_r(self.h, ("POINT(%.9f %.9f)" % (x, y)).encode()))

    def buffer(self, g, by, quarter=16):
        return self.of(self.c.GEOSBuffer_r(self.h, g, by, quarter))

    def minus(self, g, other):
        return self.of(self.c.GEOSDifference_r(self.h, g, other))

    def both(self, g, other):
        return self.of(self.c.GEOSIntersection_r(self.h, g, other))

    def within(self, g, box):
        """what lies in a rectangle x0, y0, x1, y1"""
        return self.of(self.c.GEOSClipByRect_r(self.h, g, *box))

    def boundary(self, g):
        return self.of(self.c.GEOSBoundary_r(self.h, g))

    def area(self, g):
        value = ctypes.c_double()
        self.c.GEOSArea_r(self.h, g, ctypes.byref(value))
        return value.value

    def distance(self, g, other):
        value = ctypes.c_double()
        self.c.GEOSDistance_r(self.h, g, other, ctypes.byref(value))
        return value.value
