# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools > Flexwright: plan a device, show where its masks break rules, do both again, check the rules of what is shown."""
import os
import pathlib
import re

import pya

from . import library, program

RULES = program.HERE / "tech"
actions = []  # KLayout keeps no reference
planned = {}  # of a view's GDSII file: (device file, {parameter: value})


def technology(flow):
    """name of the flow's technology; loaded where KLayout has not found it by itself"""
    name, file = "flexwright-" + flow, RULES / ("flexwright-" + flow) / (flow + ".lyt")
    if not pya.Technology.has_technology(name):
        if not file.exists():
            return ""
        pya.Technology.create_technology(name).load(str(file))
    return name


def results(path):
    return pathlib.Path(path).with_name(pathlib.Path(path).stem + "-plan")


def plan(path, settings=None, out=None, window=None):
    """plans the device, shows the mask of every flow, and where one breaks rules its markers; the views' indices"""
    window = window or pya.MainWindow.instance()
    settings, out = settings or {}, pathlib.Path(out or results(path))
    arguments = [program.program(), "plan", str(path), "-o", str(out), "--force", "--color", "never", "--no-progress", "-q"]
    for name, value in sorted(settings.items()):
        arguments += ["--set", "%s=%s" % (name, value)]
    status, _, said = program.wait(arguments)
    masks = [p for p in sorted((out / "masks").glob("*.gds")) if not re.search(r"-coupons|-wafer|-plate|\.violations", p.name)]
    drawn = {p.stem for p in masks}
    # a flow whose mask is not made has the outlines with their markers all the same
    masks += [p for p in sorted((out / "masks").glob("*.violations.gds")) if p.name[:-len(".violations.gds")] not in drawn]
    if not masks:
        raise program.Failure(program.errors(said, status))
    return [show(gds, path, settings, window) for gds in masks]


def show(gds, path, settings, window):
    flow = gds.name[:-len(".gds")].replace(".violations", "")
    index = next((i for i in range(window.views()) for c in range(window.view(i).cellviews())
                  if os.path.realpath(window.view(i).cellview(c).filename()) == os.path.realpath(gds)), None)
    if index is None:
        window.load_layout(str(gds), technology(flow), 1)
        index = window.current_view_index
        view = window.view(index)
        view.max_hier()
    else:
        window.current_view_index = index
        view = window.view(index)
        view.reload_layout(0)
    if gds.with_suffix(".lyp").exists():
        view.load_layer_props(str(gds.with_suffix(".lyp")))
    planned[os.path.realpath(gds)] = (str(path), dict(settings))
    while view.num_rdbs() > 0:
        view.remove_rdb(0)
    markers = gds.with_name(flow + ".violations.lyrdb")
    if markers.exists():
        rdb = view.create_rdb("Flexwright: " + flow)
        view.rdb(rdb).load(str(markers))
        view.show_rdb(rdb, 0)
    return index


def reload(window=None):
    """plans again what the view shows, with the same parameters: after a change of the file"""
    window = window or pya.MainWindow.instance()
    view = window.current_view()
    file = os.path.realpath(view.cellview(0).filename()) if view and view.cellviews() else ""
    if file not in planned:
        raise program.Failure(["this view shows no mask that was planned from here: Tools > Flexwright > Plan a device"])
    path, settings = planned[file]
    return plan(path, settings, pathlib.Path(file).parents[1], window)


def check(window=None):
    """the rules of the view's flow on what it shows"""
    window = window or pya.MainWindow.instance()
    view = window.current_view()
    if not view or not view.cellviews():
        raise program.Failure(["no layout is shown: open a mask first"])
    cell = view.active_cellview()
    flow = re.sub("^flexwright-", "", cell.technology)
    script = RULES / ("flexwright-" + flow) / "drc" / (flow + ".lydrc")
    if not script.exists():
        raise program.Failure(["the view's technology '%s' has no rules of ours; choose one of: %s"
                               % (cell.technology, ", ".join(sorted(p.parent.parent.name for p in RULES.glob("*/drc/*.lydrc"))))])
    pya.Macro(str(script)).run()


def selected(window):
    """device file and changed parameters of the selected instance of our library; None"""
    view = window.current_view()
    for thing in view.each_object_selected() if view else []:
        if not thing.is_cell_inst():
            continue
        instance = thing.inst()
        declaration = instance.pcell_declaration() if instance.is_pcell() else None
        if isinstance(declaration, library.DevicePCell):
            values = instance.pcell_parameters_by_name()
            return declaration.path or values["file"], declaration.changed(values)
    return None


def guarded(what):
    def run():
        try:
            what(pya.MainWindow.instance())
        except program.Failure as failure:
            pya.MessageBox.warning("Flexwright", "\n\n".join(failure.sentences[:8]), pya.MessageBox.Ok)
    return run


def ask_and_plan(window):
    found = selected(window)
    if not found:
        file = pya.FileDialog.ask_open_file_name("Device file", "", "Device files (*.xml)")
        if not file:
            return
        found = file, {}
    plan(*found, window=window)


def settings(window):
    application = pya.Application.instance()
    for name, text in (("program", "The program flexwright (empty: found by itself)"), ("devices", "Folders with device files, with %s between" % os.pathsep)):
        value = pya.InputDialog.ask_string("Flexwright", text, application.get_config("flexwright-" + name) or "")
        if value is None:
            return
        application.set_config("flexwright-" + name, value)
    application.commit_config()
    library.Flexwright()


def install(window):
    menu = window.menu()
    if menu.is_valid("tools_menu.flexwright"):
        return
    menu.insert_menu("tools_menu.end", "flexwright", "Flexwright")
    for name, title, what in (("plan", "Plan a device, show masks and violations ...", ask_and_plan), ("reload", "Plan again and reload", reload),
                              ("check", "Check the rules of this view", check), ("settings", "Settings ...", settings)):
        action = pya.Action()
        action.title = title
        action.on_triggered = guarded(what)
        actions.append(action)
        menu.insert_item("tools_menu.flexwright.end", name, action)
