# SPDX-License-Identifier: GPL-3.0-or-later
"""The library "Flexwright": a PCell for each device file, with its parameters, and one for any file."""
import re
import tempfile
import textwrap

import pya

from . import program

NOTES = pya.LayerInfo(63, 0, "NOTES")  # the documentation layer of all our tables: never exposed
LINE_UM = 60.0


class DevicePCell(pya.PCellDeclarationHelper):
    """One device file. Parameters are texts with units, as in the file: "250 um", "2*link". What is as in the file is not passed on, so
    that a change of the file is seen at the next redraw."""

    def __init__(self, name, path):
        super().__init__()
        self.title, self.path = name, str(path) if path else None
        root = program.read(path) if path else None
        self.own = {}
        if path is None:
            self.param("file", self.TypeString, "Device file", default="")
            self.param("set", self.TypeString, "Parameters (link=120 um; arc=230 deg)", default="")
        for key, value, doc in program.parameters(root) if root is not None else []:
            self.own["p_" + key] = key
            self.param("p_" + key, self.TypeString, doc, default=value)
        flows = program.flows(root) if root is not None else []
        self.param("flow", self.TypeString, "Flow", default=flows[0] if flows else "", choices=[[f, f] for f in flows] or None)
        self.param("layers", self.TypeString, "Layers (all, or 1/0, 2/0 ...)", default="all")

    def display_text_impl(self):
        return "%s, %s" % (self.title or self.file, self.flow)

    def changed(self, values):
        """{parameter: value} of what is not as in the file; values: all of the PCell's by name"""
        if self.path is None:
            pairs = [p.split("=", 1) for p in re.split(r"[;\n]", values["set"]) if p.strip()]
            if any(len(p) != 2 for p in pairs):
                raise program.Failure(["'%s': parameters are written NAME=VALUE, with ; between, for example link=120 um; arc=230 deg" % values["set"]])
            return {k.strip(): v.strip() for k, v in pairs}
        root = program.read(self.path)
        now = {k: v for k, v, _ in program.parameters(root)} if root is not None else {}
        return {key: values[name] for name, key in self.own.items() if values[name].strip() != now.get(key, "").strip()}

    def wanted(self, info):
        return self.layers.strip() in ("", "all") or "%d/%d" % (info.layer, info.datatype) in re.split(r"[\s,;]+", self.layers)

    def produce_impl(self):
        try:
            values = {name: getattr(self, name) for name in self.own} or {"set": getattr(self, "set", "")}
            data, rejected, broken = program.mask(self.path or self.file, self.flow, self.changed(values))
            self.draw(data)
            if rejected:
                self.say(["REJECTED: a hinge leaves its elastic range; flexwright check says which, and what would be accepted"])
            if broken:
                self.say(broken)
        except program.Failure as failure:
            self.say(failure.sentences)

    def draw(self, data):
        source = pya.Layout()
        with tempfile.NamedTemporaryFile(suffix=".gds") as file:
            file.write(data)
            file.flush()
            source.read(file.name)
        top = source.top_cell()
        scale = source.dbu / self.layout.dbu
        for index in source.layer_indexes():
            info = source.get_info(index)
            if self.wanted(info):
                to = self.cell.shapes(self.layout.layer(info))
                if scale == 1:
                    to.insert(top.begin_shapes_rec(index))
                else:
                    to.insert(top.begin_shapes_rec(index), pya.ICplxTrans(scale))

    def say(self, sentences):
        """below what is drawn, on the layer of notes"""
        box = self.cell.dbbox()
        x, y = (0.0, 0.0) if box.empty() else (box.left, box.bottom - LINE_UM)
        shapes = self.cell.shapes(self.layout.layer(NOTES))
        for line in [part for s in sentences[:8] for part in textwrap.wrap(s, 110) or [""]]:
            shapes.insert(pya.DText(line, x, y))
            y -= LINE_UM


def declared(name, path):
    """a PCell of a class of its own: KLayout's helper makes parameters attributes of the class"""
    return type("DevicePCell", (DevicePCell,), {})(name, path)


class Flexwright(pya.Library):
    def __init__(self):
        super().__init__()
        self.description = "Flexwright: compliant micromanipulators"
        for name, path in program.device_files().items():
            self.layout().register_pcell(name, declared(name, path))
        self.layout().register_pcell("device file", declared("", None))
        self.register("Flexwright")
