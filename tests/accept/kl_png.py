# SPDX-License-Identifier: GPL-3.0-or-later
# kl_png.py: klayout -b -r kl_png.py -rd f=FILE -rd png=OUT.png [-rd w=1600 -rd h=1600] [-rd lyp=FILE.lyp] [-rd box=x1,y1,x2,y2 um] [-rd bg=#ffffff]
import pya, sys
g = globals()
lv = pya.LayoutView(); lv.set_config("background-color", g.get("bg", "#ffffff")); lv.set_config("grid-visible", "false"); lv.set_config("text-visible", "true")
lv.load_layout(f, True); lv.max_hier()
if "lyp" in g: lv.load_layer_props(g["lyp"])
b = pya.DBox(*[float(v) for v in g["box"].split(",")]) if "box" in g else lv.active_cellview().cell.dbbox()
lv.zoom_box(b.enlarged(b.width()*0.02, b.height()*0.02))
lv.save_image_with_options(g["png"], int(g.get("w", 1600)), int(g.get("h", 1600)), 0, 2, 0, b.enlarged(b.width()*0.02, b.height()*0.02), False)
print("png", g["png"], b)
