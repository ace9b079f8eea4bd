/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every check of process/lint*.c: a pack that is wrong in one place is told so at that place, and
   the packs as they are pass (test_pack.c, packs_are_clean). */
#include "process/pack.h"
#include "pack_fixture.h"
#include "process/calibrate.h"
#include <math.h>

#define DOUBLE "soi-double-sided"
#define SOI "soi-deep-rie"
#define GLASS  "silicon-on-glass"

static void expect(int number, const char *says) {
    const fw_diag *d = said_of(number, says);
    if (!d)
        fail_msg("no FW-D%d with '%s', but '%s'", number, says,
                 diags.count ? diags.item[0].message : "nothing");
    assert_true(d->place.line > 0 && d->place.column > 0);
}

typedef struct change {
    const char *flow, *from, *to;
    int number;
    const char *says;
} change;

/* each one is an error of the flow's own file, and the only kind of error there */
static void mistakes_of_a_flow(void **state) {
    (void)state;
    static const change bad[] = {
        {SILICON, "until=\"rie.kappa", "until=\"rie.kapa", 165, "there is no quantity with this id"},
        /* left on the device, on its back or on its pads, by a pack that says nothing of its end */
        {SILICON, "    <change kind=\"remove\" material=\"thermal-paste\"/>\n", "", 644, "'thermal-paste' left on the back in the structure"},
        {GLASS, "<finished material=\"pad-gold\" is=\"present\" where=\"pad\"/>", "", 644, "'pad-gold' left on the device"},
        /* the cover of the front ashed while resist masks the back */
        {DOUBLE, "    <change kind=\"remove\" material=\"resist\" side=\"back\"/>\n", "", 645,
         "step B22 strips 'resist' off the front, and it lies open on the back"},
        {SOI, "    <change kind=\"remove\" material=\"resist\"/>\n", "", 269,
         "'h.hf-vapour' attacks 'resist'"},
        /* the acid for the mask, with copper beside it */
        {SILICON, "<exposed material=\"aluminium\" rate=\"develop.al\"/>", "", 269,
         "'h.developer' attacks 'aluminium'"},
        {SILICON, "<exposed material=\"aluminium\" selectivity=\"rie.selectivity\"/>", "", 269,
         "step S18"},
        {COPPER, "<exposed material=\"copper-plated\" rate=\"seed.R\"/>", "", 269,
         "'copper-plated', which is exposed"},
        /* below the displacement film, which has holes */
        {COPPER, "<exposed material=\"porous-silicon\" rate=\"develop.R-porous\"/>", "", 269,
         "'porous-silicon'"},
        {SILICON, "<exposed material=\"carrier-wax\" rate=\"rie.R-wax\"/>",
         "<exposed material=\"carrier-wax\" rate=\"rie.R-wax\"/>"
         "<exposed material=\"resist\" rate=\"rie.R-wax\"/>",
         269, "'resist' is not exposed at this step"},
        {SILICON, "<exposed material=\"aluminium\" rate=\"develop.al\"/>",
         "<exposed material=\"aluminium\"/>", 162, "either 'rate' or 'selectivity'"},
        {SILICON, "<exposed material=\"aluminium\" rate=\"develop.al\"/>",
         "<exposed material=\"aluminium\" rate=\"develop.t\"/>", 169, "length per time"},
        {SILICON, "<exposed material=\"aluminium\" selectivity=\"rie.selectivity\"/>",
         "<exposed material=\"aluminium\" selectivity=\"rie.R\"/>", 169, "has no unit"},
        /* what carries, sees, conducts and takes: a carrier, an aligner, an efficiency, a bath */
        {DOUBLE, "title=\"Align to the front and expose the windows, back\" equipment=\"back-aligner\"",
         "title=\"Align to the front and expose the windows, back\" equipment=\"aligner\"", 626, "step B17 aligns to marks of the other face"},
        {GLASS, " sees-back=\"yes\"", "", 626, "step G24 aligns to marks below 'silicon-100'"},
        {COPPER, "<arg name=\"efficiency\" q=\"cu.eta\"/><arg name=\"area\" q=\"mask.plated-area\"/></time>",
         "<arg name=\"area\" q=\"mask.plated-area\"/></time>", 627, "step C22 plates by its charge"},
        {SILICON, "<hazard-ref ref=\"h.plasma\"/>", "<hazard-ref ref=\"h.plasma\"/><!-- --></step>"
         "<step id=\"S16B\" op=\"strip\" title=\"t\" equipment=\"dry-bench\" in-source=\"no\" attended=\"5\"><purpose>p</purpose>"
         "<change kind=\"remove\" material=\"aluminium\"/><time law=\"const\" overrun=\"0\" k=\"2\"><arg name=\"time\" q=\"strip.t\"/></time>"
         "<endpoint>e</endpoint><accept measure=\"m\" lo=\"\" hi=\"0\" unit=\"1\" sites=\"1\" every=\"1\"/><hazard-ref ref=\"h.solvent\"/>"
         "<on-fail if=\"x\" then=\"hold\">y</on-fail>", 629, "step S16B (strip) takes off 'aluminium'"},
        {GLASS, "takes=\"gold\" vacuum=\"yes\">electrodes of graphite", "takes=\"gold\">electrodes of graphite", 505,
         "step G19 (bond) sets a low pressure ('bond.p')"},
        /* what hands and benches do: attendance, times, waits, rinses, metal that lifts, what is read first */
        {SILICON, "mask=\"M1\" batch=\"1\" attended=\"8\"", "mask=\"M1\" batch=\"1\" attended=\"800\"", 577,
         "step S09 is attended for 800 min"},
        {SILICON, "op=\"wet-etch\" title=\"Etch the aluminium mask\" equipment=\"al-bench\" in-source=\"yes\" batch=\"1\" attended=\"22\"",
         "op=\"wet-etch\" title=\"Etch the aluminium mask\" equipment=\"al-bench\" in-source=\"yes\" batch=\"1\" attended=\"0\"",
         174, "step S14 (wet-etch) is done in a liquid and is attended"},
        {COPPER, "equipment=\"plater\" in-source=\"yes\" batch=\"1\" attended=\"6\"",
         "equipment=\"plater\" in-source=\"yes\" batch=\"1\" attended=\"0\"", 174, "step C22 (plate) is done in a liquid"},
        {GLASS, "ghs=\"GHS05 GHS06\" buddy=\"yes\"", "ghs=\"GHS05 GHS06\" buddy=\"no\"", 174, "'h.hf' is hydrofluoric acid that wets"},
        {DOUBLE, "ghs=\"GHS05 GHS06\"", "ghs=\"GHS05 GHS16\"", 171, "'GHS16' is no pictogram"},
        {GLASS, "<ppe>goggles, nitrile gloves, apron; fume hood; it stains</ppe>", "<ppe> </ppe>", 171, "'h.gold': its <ppe>"},
        {SILICON, "id=\"al-rinse.t\" value=\"5\"", "id=\"al-rinse.t\" value=\"1440\"", 577, "step S14 rinses for 1440 min"},
        {SILICON, "id=\"al-rinse.t\" value=\"5\" u=\"0.5\"", "id=\"al-rinse.t\" value=\"0.03\" u=\"0.01\"", 577, "step S14 rinses for 0.03 min"},
        {SILICON, "id=\"rie.break\" value=\"10\"", "id=\"rie.break\" value=\"2000\"", 577, "step S18 pauses between parts for 2000 min"},
        {SILICON, "id=\"hard.t\" value=\"5\"", "id=\"hard.t\" value=\"4000\"", 577, "step S13 (bake) takes 4000 min"},
        {SILICON, "id=\"clean.t\" value=\"35\"", "id=\"clean.t\" value=\"28000\"", 577, "step S02 (clean)"},
        {SILICON, "id=\"develop.t\" value=\"60\" u=\"10\"", "id=\"develop.t\" value=\"1\" u=\"0.2\"", 577, "step S11 (develop)"},
        {SILICON, "id=\"strip.t\" value=\"15\" u=\"2\"", "id=\"strip.t\" value=\"0.05\" u=\"0.01\"", 577, "a plasma strikes and settles"},
        {DOUBLE, "<lag from=\"B03\" max=\"4\" unit=\"h\"/>", "<lag from=\"B03\" max=\"1\" unit=\"s\"/>", 577, "nobody carries a wafer so fast"},
        {SILICON, "<q id=\"si.d\"", "<q id=\"h.pan.wet-longest\" value=\"10\" u=\"0\" unit=\"h\" status=\"assumed\" src=\"guess\"/><q id=\"si.d\"",
         578, "'h.pan.wet-longest' lets a wafer wait for 600 min"},
        {SILICON, "<q id=\"si.d\"", "<q id=\"water.wet-longest\" value=\"72\" u=\"0\" unit=\"h\" status=\"assumed\" src=\"guess\"/><q id=\"si.d\"",
         578, "bears 1440 min at most"},
        {SILICON, "<q id=\"si.d\"", "<q id=\"resist.unbaked-longest\" value=\"200\" u=\"0\" unit=\"h\" status=\"assumed\" src=\"guess\"/><q id=\"si.d\"",
         578, "as under unbaked"},
        {SILICON, "<lag from=\"S21\" max=\"10\" unit=\"min\"/>", "<lag from=\"S21\" max=\"30\" unit=\"h\"/>", 578,
         "step S22 may wait for 1800 min after step S21, but the wafer is wet with deionised water then and bears 240 min"},
        {SILICON, "<uses consumable=\"alcohol\" q=\"alcohol.volume\" per=\"load\"/><uses consumable=\"dioxide\" q=\"dioxide.mass\" per=\"load\"/>\n    <hazard-ref ref=\"h.pressure\"/><hazard-ref ref=\"h.solvent\"/>",
         "<uses consumable=\"dioxide\" q=\"dioxide.mass\" per=\"load\"/>\n    <hazard-ref ref=\"h.pressure\"/>", 591, "step S22 dries at the critical point out of water"},
        {SILICON, "overrun=\"0.2\" k=\"2\"><arg name=\"time\" q=\"develop.t\"/>", "overrun=\"5\" k=\"2\"><arg name=\"time\" q=\"develop.t\"/>", 171, "is not between 0 and 3"},
        {SILICON, "id=\"rie.p\" value=\"80\" u=\"1\" unit=\"mTorr\"", "id=\"rie.p\" value=\"80\" u=\"1\" unit=\"Torr\"", 278, "a plasma that etches a wafer"},
        {DOUBLE, "id=\"overlay.back\" value=\"5\"", "id=\"overlay.back\" value=\"5000\"", 278, "step B17 aligns its mask to 5000 um"},
        {DOUBLE, "id=\"overlay.back\" value=\"5\"", "id=\"overlay.back\" value=\"0\"", 278, "no aligner is exact"},
        {"soi-deep-rie", "<change kind=\"remove\" material=\"buried-oxide\" thickness=\"box.d\"",
         "<change kind=\"remove\" material=\"buried-oxide\" thickness=\"soi.d\"", 349, "step D12 takes 50 um of 'buried-oxide'"},
        {GLASS, "id=\"bond.T\" value=\"400\" u=\"10\" unit=\"Cel\" status=\"typical\" src=\"exchange\"/>", "id=\"bond.T\" value=\"700\" u=\"10\" unit=\"Cel\" status=\"typical\" src=\"exchange\"/>", 271,
         "'glass-carrier' on the wafer tolerates at most 500 Cel"},
        {COPPER, "<lag from=\"C06\" max=\"10\" unit=\"min\"/>", "<lag from=\"C06\" max=\"10\" unit=\"h\"/>", 578, "step C07 may wait"},
        {SILICON, "<finish kind=\"rinse\" q=\"al-rinse.t\"/>",
         "<finish kind=\"rinse\" q=\"al-rinse.t\"/><finish kind=\"rinse\" with=\"h.solvent\">acetone</finish>", 539,
         "step S14 rinses in 'h.solvent', which attacks 'resist'"},
        {GLASS, "id=\"pad.d\" value=\"0.33\"", "id=\"pad.d\" value=\"2.1\"", 579, "step G27 lifts off 2.13 um with 'resist', which is 2 um thick"},
        {GLASS, "id=\"hf.parts\" value=\"10\" u=\"0.2\" unit=\"1\" status=\"typical\" src=\"iliescu\" range=\"parts\"/>\n  <q id=\"hcl.parts\" value=\"1\"",
         "id=\"hf.parts\" value=\"0\" u=\"0\" unit=\"1\" status=\"typical\" src=\"iliescu\" range=\"parts\"/>\n  <q id=\"hcl.parts\" value=\"0\"",
         370, "bath 'hf' is mixed from nothing"},
        {SILICON, "id=\"pan.serves\" value=\"1\"", "id=\"pan.serves\" value=\"2.5\"", 278, "'pan.serves' is 2.5, and counts things"},
        {SILICON, "id=\"wafer.D\" value=\"100\"", "id=\"wafer.D\" value=\"1\"", 278, "'wafer.D' is 1 mm"},
        {DOUBLE, "id=\"handle.d\" value=\"400\"", "id=\"handle.d\" value=\"5\"", 278, "'handle.d' is 5 um, outside its plausible range of 100"},
        {SILICON, "id=\"carrier.d\" value=\"525\"", "id=\"carrier.d\" value=\"5\"", 278, "'carrier.d' is 5 um"},
        {GLASS, "id=\"glass.d\" value=\"500\"", "id=\"glass.d\" value=\"5\"", 278, "'glass.d' is 5 um"},
        {COPPER, "id=\"wafer.d\" value=\"525\"", "id=\"wafer.d\" value=\"5\"", 278, "'wafer.d' is 5 um"},
        {GLASS, "id=\"litho.edge\" value=\"0\" lo=\"-0.15\" hi=\"0.15\"", "id=\"litho.edge\" value=\"5\" u=\"0.1\"", 278,
         "'litho.edge' is 5 um, outside its plausible range of -3 to 3 um"},
        {SILICON, "date=\"2025-01-01\">typical", "date=\"2190-01-01\">typical", 171, "date=\"2190-01-01\" is no day of the years 1800"},
        {SILICON, "date=\"2025-01-01\">typical", "date=\"2025-02-30\">typical", 171, "date=\"2025-02-30\" is no day"},
        {SILICON, "<q id=\"hard.T\" value=\"115\" u=\"3\" unit=\"Cel\" status=\"typical\"", "<q id=\"hard.T\" value=\"115\" u=\"3\" unit=\"Cel\" status=\"measured\"",
         173, "'hard.T' has status measured, but its source is of kind handbook"},
        /* dryers, pores, reworks, what is accepted */
        {SILICON, "equipment=\"cpd\"", "equipment=\"solvent-bench\"", 612,
         "step S22 dries at the critical point at 'solvent-bench'"},
        {GLASS, "brings=\"h.pressure\"", "brings=\"h.solvent\"", 612, "dries at the critical point at 'cpd'"},
        {COPPER, "<finish kind=\"rinse\" q=\"seed.t-off\"/>",
         "<finish kind=\"rinse\" q=\"seed.t-off\"/><finish kind=\"dry\" by=\"nitrogen\"/>", 613,
         "step C25 dries 'porous-silicon' by nitrogen out of water"},
        {SILICON, "goto=\"S02\">strip the aluminium, deposit at lower stress, or mount on a carrier first",
         "goto=\"S02\">clean and deposit at lower stress", 615, "step S04 sends a wafer with open 'aluminium' back to step S02"},
        {SILICON, "<accept measure=\"step height on the witness chip\" lo=\"{=al.d*0.95}\" hi=\"{=al.d*1.05}\"",
         "<accept measure=\"step height on the witness chip\" lo=\"2.85\" hi=\"3.15\"", 616, "is meant to be 1 um thick"},
        {COPPER, "<accept measure=\"thickness\" lo=\"{=cu.d*0.9}\" hi=\"{=cu.d*1.1}\" unit=\"um\" sites=\"5\" every=\"1\"/>",
         "<accept measure=\"thickness\" lo=\"11\" hi=\"13\" unit=\"um\" sites=\"5\" every=\"1\"/>", 616,
         "step C22 accepts a thickness of 11 to 13 um"},
        /* numbers, plates, times and benches that are those of others */
        {SILICON, "<arg name=\"width\" q=\"mask.narrowest-opening\"/>", "<arg name=\"width\" q=\"mask.narrowest-line\"/>", 561,
         "an opening as wide as 'mask.narrowest-line'"},
        {COPPER, "<arg name=\"molar_mass\" q=\"cu.M\"/>", "<arg name=\"molar_mass\" q=\"si.M\"/>", 561,
         "with 'si.M' as its molar_mass, by which step C05 is timed for 'porous-silicon'"},
        {COPPER, "<arg name=\"density\" q=\"cu.rho\"/>", "<arg name=\"density\" q=\"si.rho\"/>", 561, "with 'si.rho' as its density"},
        {COPPER, "overrun=\"0\" k=\"2\">\n      <arg name=\"thickness\" q=\"cu.d\"/>",
         "overrun=\"0.5\" k=\"2\">\n      <arg name=\"thickness\" q=\"cu.d\"/>", 609, "goes on for 50 % longer than its layer takes"},
        {COPPER, "id=\"descum.t\" value=\"10\" u=\"1\"", "id=\"descum.t\" value=\"1\" u=\"0.1\"", 609,
         "step C20 takes 1 min (descum.t), but the times that are set in it are 2 min together"},
        {SILICON, "title=\"Hard bake\" equipment=\"hotplate\" in-source=\"no\" batch=\"1\" attended=\"1\"",
         "title=\"Hard bake\" equipment=\"hotplate\" in-source=\"no\" batch=\"1\" attended=\"66\"", 609, "at step S13 for 66 min"},
        {DOUBLE, "mask=\"window\"", "mask=\"device\"", 559, "step B17 exposes the part 'window', which plate 'window' draws, through mask device"},
        {COPPER, "<finish kind=\"rinse\" q=\"seed.t-off\"/>", "", 606,
         "step C26 is at 'base-bench', and the wafer comes there wet with 'h.oxidiser' from 'copper-bench'"},
        {SILICON, "<finish kind=\"rinse\" q=\"al-rinse.t\"/>\n    <finish kind=\"dry\" by=\"spin\"/>",
         "<finish kind=\"rinse\" q=\"al-rinse.t\"/>\n    <finish kind=\"dry\" by=\"vapour\"/>", 539,
         "step S14 dries in vapour of 'h.solvent', which attacks 'resist'"},
        {SILICON, "then=\"scrap\">stop; new", "then=\"scrap\" goto=\"S14\">stop; new", 276, "says scrap, and goes on with step S14"},
        /* the plate or the resist of the other tone */
        {SILICON, "<change kind=\"pattern\" material=\"resist\" where=\"field\"/>",
         "<change kind=\"pattern\" material=\"resist\" where=\"structure\"/>", 559,
         "step S09 exposes it for the part 'structure'"},
        {COPPER, "<change kind=\"pattern\" material=\"resist\" where=\"structure\"/>",
         "<change kind=\"pattern\" material=\"resist\" where=\"field\"/>", 559, "the part 'field'"},
        /* timed for another layer */
        {SILICON, "pause=\"rie.break\"><arg name=\"depth\" q=\"si.d\"/>",
         "pause=\"rie.break\"><arg name=\"depth\" q=\"al.d\"/>", 561, "step S18 is computed for 1 um"},
        {SILICON, "<time law=\"spin\" overrun=\"0\" k=\"2\"><arg name=\"thickness\" q=\"litho.resist\"/>",
         "<time law=\"spin\" overrun=\"0\" k=\"2\"><arg name=\"thickness\" q=\"al.d\"/>", 561,
         "step S07 is computed for 1 um"},
        /* timed by the rate of another material: whichever comes second is told */
        {SILICON, "<arg name=\"rate\" q=\"pan.R\"/>", "<arg name=\"rate\" q=\"rie.R\"/>", 561,
         "with 'rie.R' as its rate"},
        {SILICON, "<arg name=\"depth\" q=\"si.d\"/><arg name=\"rate\" q=\"rie.R\"/>",
         "<arg name=\"depth\" q=\"si.d\"/><arg name=\"rate\" q=\"pan.R\"/>", 561, "with 'pan.R' as its rate"},
        /* limits in another unit than what they are computed from */
        {SILICON, "hi=\"{=al.d*1.05}\" unit=\"um\"", "hi=\"{=al.d*1.05}\" unit=\"nm\"", 342,
         "is a number in um"},
        {COPPER, "hi=\"{=seed.Rs}\" unit=\"ohm\"", "hi=\"{=seed.Rs}\" unit=\"mohm\"", 342,
         "is a number in ohm"},
        /* back to a resist that was stripped; a window of no width; all wafers of a lot in a machine for one */
        {SILICON, "<on-fail if=\"grass\" then=\"hold\">", "<on-fail if=\"grass\" then=\"rework\" goto=\"S09\">",
         276, "not on the wafer any more"},
        {SILICON, "<time law=\"spin\" overrun=\"0\" k=\"2\">", "<time law=\"spin\" overrun=\"0\" k=\"0\">", 171,
         "k is 0"},
        {SILICON, "equipment=\"rie\" in-source=\"yes\" batch=\"1\"",
         "equipment=\"rie\" in-source=\"yes\" batch=\"99\"", 558, "but is done to every wafer"},
        /* a step of another kind */
        {SILICON, "id=\"S03\" op=\"deposit\"", "id=\"S03\" op=\"dry-etch\"", 562, "step S03 (dry-etch)"},
        {SILICON, "id=\"S16\" op=\"strip\"", "id=\"S16\" op=\"inspect\"", 562, "step S16 (inspect)"},
        /* a coat that no spinner gives: too thick, too thin */
        {SILICON, "id=\"resist.d0\" value=\"1.40\"", "id=\"resist.d0\" value=\"0.05\"", 563,
         "step S07 would spin at"},
        {SILICON, "id=\"resist.d0\" value=\"1.40\"", "id=\"resist.d0\" value=\"9\"", 563,
         "step S07 would spin at"},
        /* a liquid takes all directions alike; a base in silicon does not: below */
        {SILICON, "where=\"field\" profile=\"isotropic\"", "where=\"field\" profile=\"anisotropic\" anisotropy=\"rie.A\"",
         540, "step S14 etches 'aluminium' in 'h.pan'"},
        /* the plate of one side on the other */
        {SILICON, "<change kind=\"pattern\" material=\"resist\" where=\"field\"/>",
         "<align to=\"M1\" side=\"back\" overlay=\"litho.gap\"/><change kind=\"pattern\" material=\"resist\" where=\"field\"/>", 373,
         "aligns a plate of the back"},
        /* a clock that does not know how thick the layer is */
        {SILICON,
         "<time law=\"arrhenius\" overrun=\"al.overetch\" k=\"2\"><arg name=\"thickness\" q=\"al.d\"/><arg name=\"rate\" q=\"pan.R\"/>"
         "<arg name=\"activation_energy\" q=\"pan.Ea\"/><arg name=\"reference_temperature\" q=\"pan.T-reference\"/>"
         "<arg name=\"temperature\" q=\"pan.T\"/></time>",
         "<time law=\"const\" overrun=\"0.1\" k=\"2\"><arg name=\"time\" q=\"strip.t\"/></time>", 541, "takes the time 'strip.t'"},
        {COPPER, "<time law=\"rate\" overrun=\"0.2\" k=\"2\"><arg name=\"thickness\" q=\"seed.d\"/><arg name=\"rate\" q=\"seed.R\"/></time>",
         "<time law=\"const\" overrun=\"0.1\" k=\"2\"><arg name=\"time\" q=\"strip.t\"/></time>", 541, "step C25"},
        {SILICON, "<set name=\"pressure\" q=\"rie.p\" tol-lo=\"78\" tol-hi=\"82\"/>", "", 542, "step S18"},
        /* frozen, boiling, and too warm for what it loses */
        {SILICON, "id=\"pan.T\" unknown=\"true\"", "id=\"pan.T\" value=\"-22\" u=\"1\"", 543, "step S14 is done in 'h.pan'"},
        {SILICON, "id=\"pan.T-reference\" value=\"22\"", "id=\"pan.T-reference\" value=\"220\"", 543, "220 Cel (pan.T-reference)"},
        {SILICON, "name=\"bath temperature\" q=\"clean.T\" tol-lo=\"70\" tol-hi=\"80\"", "name=\"bath temperature\" q=\"peb.T\" tol-lo=\"\" tol-hi=\"\"",
         543, "loses its ammonia"},
        {SILICON, "id=\"pan.T-warm\" value=\"27\"", "id=\"pan.T-warm\" value=\"-27\"", 543, "-27 Cel (pan.T-warm)"},
        {COPPER, "id=\"ps.T\" value=\"22\"", "id=\"ps.T\" value=\"-22\"", 543, "step C05 is done in 'h.hf-organic'"},
        /* lengths that nobody computes a layer from */
        {SILICON, "id=\"read.si.d\" value=\"0.15\"", "id=\"read.si.d\" value=\"-0.15\"", 278, "'read.si.d' is -0.15 um"},
        {COPPER, "id=\"cu.layer\" value=\"116\"", "id=\"cu.layer\" value=\"-116\"", 278, "'cu.layer' is -116 um"},
        /* of orientation, too */
        {SILICON, "id=\"al.R-example\" value=\"40\" urel=\"0.1\" unit=\"nm/min\"",
         "id=\"al.R-example\" value=\"400\" urel=\"0.1\" unit=\"um/min\"", 544, "a rate of 400 um/min (al.R-example)"},
        {COPPER, "id=\"release.R\" unknown=\"true\"", "id=\"release.R\" value=\"400\" urel=\"0.1\"", 544, "step C26"},
        /* etched from below, through carrier and paste */
        {SILICON, "thickness=\"si.d\" where=\"field\" profile",
         "thickness=\"si.d\" side=\"back\" where=\"field\" profile", 564, "'thermal-paste' covers"},
        /* the other face: what is put there, exposed, developed and etched, and by which plate */
        {DOUBLE, "thickness=\"back.resist\" side=\"back\"/>", "thickness=\"back.resist\"/>", 172, "'resist'"},
        {DOUBLE, "where=\"window\" side=\"back\"/>\n    <set name=\"lamp", "where=\"window\"/>\n    <set name=\"lamp", 373,
         "exposes the front (its <change>)"},
        {DOUBLE, "<change kind=\"remove\" material=\"resist\" where=\"window\" side=\"back\"/>",
         "<change kind=\"remove\" material=\"resist\" where=\"window\"/>", 274, "develops 'resist'"},
        {DOUBLE, "where=\"window\" side=\"back\" profile", "where=\"window\" profile", 339, "step B20 works on 'silicon-substrate'"},
        {DOUBLE, "where=\"window\" side=\"back\" profile", "where=\"handle\" side=\"back\" profile", 564,
         "'silicon-substrate' in the structure, handle from the back, where 'resist' covers it"},
        {DOUBLE, "where=\"window\" side=\"back\" profile", "where=\"handle\" side=\"back\" profile", 275,
         "lies open in the structure, window too"},
        {DOUBLE, "thickness=\"handle.d\" where=\"window\" side", "thickness=\"soi.d\" where=\"window\" side", 349, "400 um lie in"},
        {DOUBLE, "<change kind=\"remove\" material=\"resist\" side=\"back\"/>", "", 345, "'resist' is still there"},
        {DOUBLE, "<align to=\"device\" side=\"back\"", "<align to=\"device\"", 373, "aligns a plate of the front"},
        {DOUBLE, "<change kind=\"remove\" material=\"buried-oxide\" thickness=\"box.d\" where=\"window\" side=\"back\"/>", "", 338,
         "nothing frees the device"},
        /* what nothing frees, and what nothing insulates */
        {"soi-deep-rie", " where=\"field\" reach=\"release.reach\"", " where=\"field\"", 338, "nothing frees the device"},
        {"soi-deep-rie", "reach=\"release.reach\"/>", "reach=\"box.d\"/>", 561, "reaches 'box.d' sideways"},
        /* set by another kind, or of none */
        {SILICON, "q=\"hard.T\" tol-lo=\"110\" tol-hi=\"120\"", "q=\"hard.t\" tol-lo=\"\" tol-hi=\"\"", 548, "sets a 'temperature' to 'hard.t'"},
        {SILICON, "name=\"power\" q=\"rie.power\" tol-lo=\"245\" tol-hi=\"255\"", "name=\"power\" q=\"rie.p\" tol-lo=\"\" tol-hi=\"\"", 548,
         "sets a 'power' to 'rie.p', which is in mTorr"},
        {SILICON, "id=\"litho.gap\" value=\"5\" u=\"5\" unit=\"um\"", "id=\"litho.gap\" value=\"5\" u=\"5\" unit=\"kg2\"", 547, "'litho.gap' is in kg2"},
        {"silicon-on-glass", "bears=\"prober.bears\"", "bears=\"test.t\"", 547, "what a step bears is a voltage, and 'test.t' is in min"},
        {"soi-deep-rie", "value=\"500\" urel=\"0.3\" unit=\"V/um\"", "value=\"500\" urel=\"0.3\" unit=\"kg2\"", 547,
         "is a voltage per length"},
        /* no time for it */
        {SILICON, "id=\"hard.t\" value=\"5\" u=\"0.5\" unit=\"min\"", "id=\"hard.t\" value=\"5\" u=\"0.5\" unit=\"s\"", 532, "less than ten seconds"},
        /* values that no step of their kind takes, whatever their dimension allows */
        {SILICON, "id=\"hmds.t\" value=\"20\" u=\"3\" unit=\"min\"", "id=\"hmds.t\" value=\"20\" u=\"3\" unit=\"s\"", 587, "step S06 (bake) takes 20 s"},
        {SILICON, "id=\"rie.power\" value=\"250\" u=\"2\"", "id=\"rie.power\" value=\"0\" u=\"0\"", 587, "no plasma burns with less"},
        {SILICON, "id=\"resist.w0\" value=\"4000\" u=\"20\"", "id=\"resist.w0\" value=\"4\" u=\"0\"", 587, "step S07 (coat) takes 4 rpm"},
        {SILICON, "id=\"strip.t\" value=\"15\" u=\"2\" unit=\"min\"", "id=\"strip.t\" value=\"15\" u=\"2\" unit=\"ms\"", 587, "step S16 (strip)"},
        {SILICON, "id=\"pan.water\" value=\"10\" u=\"0.2\"", "id=\"pan.water\" value=\"0\" u=\"0\"", 278, "what is not in it is left out"},
        {SILICON, "id=\"read.si.d\" value=\"0.15\"", "id=\"read.si.d\" value=\"0\"", 278, "no instrument reads a length"},
        {SILICON, "id=\"paste.d\" value=\"50\" u=\"30\"", "id=\"paste.d\" value=\"5e-6\" u=\"0\"", 278, "at least an atom"},
        {SILICON, "id=\"rie.part\" value=\"30\"", "id=\"rie.part\" value=\"0\"", 278, "parts of less than a second"},
        {SILICON, "id=\"al-rinse.t\" value=\"5\" u=\"0.5\"", "id=\"al-rinse.t\" value=\"0\" u=\"0\"", 347, "in no time (al-rinse.t)"},
        /* words that say nothing, and dates that are none */
        {SILICON, "title=\"Develop, rinse, dry\"", "title=\"  \"", 171, "its title says nothing"},
        {SILICON, "<endpoint>Five sites measured.</endpoint>", "<endpoint> </endpoint>", 171, "its endpoint says nothing"},
        {SILICON, "<on-fail if=\"grass\"", "<on-fail if=\"\"", 171, "condition of an <on-fail>"},
        {SILICON, "date=\"2025-01-01\">typical", "date=\"yesterday\">typical", 171, "date=\"yesterday\" is no day"},
        /* done again from nowhere; sawn when free; vented where nothing is pumped; a band that counts twice */
        {SILICON, "then=\"rework\" goto=\"S05\"", "then=\"rework\"", 276, "not from which step"},
        {SILICON, "<step id=\"S22\" op=\"clean\"", "<step id=\"S22\" op=\"dice\"", 337, "devices are free already"},
        {SILICON, "<finish kind=\"rinse\" q=\"al-rinse.t\"/>", "<finish kind=\"vent\"/><finish kind=\"rinse\" q=\"al-rinse.t\"/>", 505,
         "vents 'al-bench'"},
        {SILICON, "<corner of=\"thickness\" name=\"thickness\" q=\"si.d\"/>",
         "<corner of=\"thickness\" name=\"thickness\" q=\"si.d\"/><corner of=\"thickness\" name=\"again\" q=\"si.d\"/>", 260, "count twice"},
        {SILICON, "class=\"profilometer, microscope, four-point probe\" capacity=\"1\"",
         "class=\"profilometer, microscope, four-point probe\" capacity=\"1\" takes=\"coper\"", 165, "no material contaminates with that"},
        /* acid with nobody beside it */
        {COPPER, "op=\"anodise\" title=\"Anodise: make the surface porous\" equipment=\"hf-bench\" "
                 "in-source=\"yes\" batch=\"1\" second-signature=\"yes\" attended=\"2\"",
         "op=\"anodise\" title=\"Anodise: make the surface porous\" equipment=\"hf-bench\" "
         "in-source=\"yes\" batch=\"1\" second-signature=\"yes\" attended=\"0\"",
         174, "nobody leaves alone"},
        /* resist that was not stripped meets the plasma */
        {SILICON, "<change kind=\"remove\" material=\"resist\"/>", "", 269, "'resist'"},
        {SILICON, "<q id=\"hard.T\" value=\"115\"", "<q id=\"hard.T\" value=\"131\"", 271,
         "step S13"},
        {COPPER, "capacity=\"1\" brings=\"h.copper-acid\" takes=\"copper\"",
         "capacity=\"1\" brings=\"h.copper-acid\" takes=\"gold coppery\"", 272, "step C21"},
        /* on the carrier it still is a wafer */
        {SILICON, "<step id=\"S19\" op=\"inspect\"",
         "<step id=\"S19\" leaves=\"dies\" op=\"inspect\"", 552,
         "step S19 leaves dies, but layers"},
        {SILICON, "<step id=\"S22\" op=\"clean\"", "<step id=\"S22\" leaves=\"dies\" op=\"clean\"",
         552, "has parted the wafer already"},
        {SILICON, "in-source=\"yes\" mask=\"M1\"", "in-source=\"yes\"", 274, "without naming"},
        {SILICON, "<change kind=\"pattern\" material=\"resist\" where=\"field\"/>", "", 274,
         "develops 'resist'"},
        {SILICON, "<change kind=\"add\" material=\"resist\" thickness=\"litho.resist\"/>", "", 172,
         "resist"},
        {COPPER,
         "<change kind=\"add\" material=\"copper-plated\" thickness=\"cu.d\" "
         "where=\"structure\"/>",
         "", 275, "lies open in the structure too"},
        {SILICON, "<change kind=\"add\" material=\"aluminium\" thickness=\"al.d\"/>",
         "<change kind=\"add\" material=\"aluminium\" thickness=\"litho.resist\"/>", 349,
         "2 um lie in the field"},
        {SILICON, "<change kind=\"add\" material=\"silicon-100\" thickness=\"si.d\"/>",
         "<change kind=\"add\" material=\"silicon-100\" thickness=\"carrier.d\"/>", 349,
         "525 um lie in the field"},
        {SILICON, "<hazard-ref ref=\"h.pan\"/><hazard-ref ref=\"h.sharp\"/>",
         "<hazard-ref ref=\"h.sharp\"/>", 374, "uses 'pan2', whose hazard 'h.pan'"},
        {SILICON, "material=\"thermal-paste\" thickness=\"paste.d\"",
         "material=\"carrier\" thickness=\"paste.d\"", 520, "puts 'carrier' where it lies"},
        {COPPER, "<step id=\"C08\"",
         "<step id=\"C07B\" op=\"displace\" title=\"x\" equipment=\"hf-bench\" "
         "in-source=\"no\" second-signature=\"yes\"><purpose>x</purpose><change kind=\"add\" "
         "material=\"copper-seed\" thickness=\"seed.d\"/><time law=\"const\" overrun=\"0\" "
         "k=\"2\"><arg name=\"time\" q=\"cell.t\"/></time><endpoint>x</endpoint><accept "
         "measure=\"x\" lo=\"\" hi=\"\" unit=\"1\" sites=\"1\" every=\"1\"/><hazard-ref "
         "ref=\"h.hf-copper\"/><on-fail if=\"x\" then=\"hold\">x</on-fail><finish "
         "kind=\"rinse\"/></step><step id=\"C08\"",
         521, "on 'copper-seed' itself"},
        {COPPER, "<q id=\"coat.d\" value=\"8\"", "<q id=\"coat.d\" value=\"6\"", 523,
         "computed for 16 um of 'resist' (mould.height), but 12 um"},
        {COPPER, "<q id=\"mould.height\" value=\"16\"", "<q id=\"mould.height\" value=\"20\"", 523,
         "computed for 20 um of 'resist' (mould.height), but 16 um"},
        {SILICON,
         "<hazard-ref ref=\"h.pan\"/>\n    <on-fail if=\"residue\" then=\"rework\" "
         "goto=\"S14\">",
         "<on-fail if=\"residue\" then=\"rework\" goto=\"S14\">", 527,
         "step S14 (wet-etch) is done in a liquid"},
        {SILICON, "<hazard-ref ref=\"h.plasma\"/>", "", 528, "which brings 'h.plasma'"},
        {COPPER, "<hazard-ref ref=\"h.hf-organic\"/>", "", 528, "names no such hazard"},
        {COPPER, "<hazard-ref ref=\"h.solvent\"/>", "", 374, "step C08 rinses in 'h.solvent'"},
        {SILICON, "<q id=\"resist.d0\" value=\"1.40\"", "<q id=\"resist.d0\" value=\"-1.40\"", 278,
         "'resist.d0' is -1.4 um"},
        {SILICON, "<q id=\"resist.a\" value=\"0.503\"", "<q id=\"resist.a\" value=\"0\"", 278,
         "'resist.a' is 0"},
        {SILICON, "then=\"rework\" goto=\"S02\">clean once",
         "then=\"rework\" goto=\"S20\">clean once", 276, "goes on with step S20"},
        {COPPER, "<q id=\"dose.h1\" value=\"10\"", "<q id=\"dose.h1\" value=\"24\"", 342,
         "points do not rise"},
        {SILICON, "brings=\"h.uv\"", "brings=\"h.uw\"", 165, "did you mean 'h.uv'"},
        {SILICON, "<corner of=\"thickness\" name=\"thickness\" q=\"si.d\"/>",
         "<corner of=\"thickness\" name=\"thickness\" q=\"si.d\" etched=\"yes\"/>", 260,
         "'thickness' is none"},
        {"silicon-on-glass", "<step id=\"G16\"",
         "<step id=\"G15B\" op=\"wet-etch\" title=\"x\" equipment=\"hf-bench\" "
         "in-source=\"no\" second-signature=\"yes\"><purpose>x</purpose><change "
         "kind=\"remove\" material=\"glass-carrier\" thickness=\"cavity.d\" where=\"cavity\" "
         "profile=\"isotropic\"/><time law=\"const\" overrun=\"0\" k=\"2\"><arg name=\"time\" "
         "q=\"inspect.t\"/></time><endpoint>x</endpoint><accept measure=\"x\" lo=\"\" hi=\"\" "
         "unit=\"1\" sites=\"1\" every=\"1\"/><hazard-ref ref=\"h.hf\"/><on-fail if=\"x\" "
         "then=\"hold\">x</on-fail><finish kind=\"rinse\"/><finish kind=\"dry\" by=\"spin\"/>"
         "</step><step id=\"G16\"",
         522, "where step G12 has etched it already"},
        {COPPER, "material=\"copper-plated\" thickness=\"cu.d\">",
         "material=\"copper-plated\" thickness=\"mould.height\">", 525,
         "the steps leave 9 um of 'copper-plated', but the device layer is 16 um thick"},
        {SILICON, "<finish kind=\"vent\"/>", "", 505, "lies under vacuum in 'sputter'"},
        {SILICON, "<finish kind=\"cool\"/>", "", 504, "hot from step S06"},
        {SILICON, "<lag from=\"S02\"", "<lag from=\"S09\"", 276, "not before it"},
        {SILICON, "<q id=\"pan.R\" least=\"1\" most=\"1000\" value=\"10\"",
         "<q id=\"pan.R\" least=\"1\" most=\"1000\" value=\"0.1\"", 278, "'pan.R' is 0.1 Ao/s"},
        {SILICON, "<q id=\"pan.R\" least=\"1\" most=\"1000\"",
         "<q id=\"pan.R\" least=\"1000\" most=\"1\"", 71, "smaller one first"},
        {SILICON, "<q id=\"pan.R\" least=\"1\" most=\"1000\"", "<q id=\"pan.R\" most=\"1000\"", 71,
         "least and most"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, bad[i].flow, bad[i].from, bad[i].to, &diags));
        expect(bad[i].number, bad[i].says);
        assert_string_equal(said_of(bad[i].number, bad[i].says)->place.file, "flow.xml");
    }
}

/* what is taken away sideways lies there, 2 um thick: half and twice as much is no other layer */
static void what_goes_sideways_is_as_thick_as_it_lies(void **state) {
    (void)state;
    static const struct {
        const char *um;
        bool right;
    } taken[] = {{"0.5", false}, {"0.98", false}, {"1.02", true}, {"2", true}, {"3.95", true}, {"4.05", false}, {"9", false}};
    size_t nb = 0, n = 0;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, SOI, &n);
    text = replaced(arena, text, "<change kind=\"remove\" material=\"buried-oxide\" thickness=\"box.d\"",
                    "<change kind=\"remove\" material=\"buried-oxide\" thickness=\"box.taken\"", &n);
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) {
        size_t m = n;
        const char *q = fw_arena_printf(
            arena, "<q id=\"box.taken\" value=\"%s\" u=\"0.1\" unit=\"um\" status=\"assumed\" src=\"guess\" range=\"film\"/><q id=\"box.d\"",
            taken[i].um);
        const char *own = replaced(arena, text, "<q id=\"box.d\"", q, &m);
        fw_process_flow *flow = NULL;
        diags = fw_diags_new(arena);
        (void)fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", own, m, &diags, &flow);
        const fw_diag *said = said_of(349, "step D12 takes");
        if (taken[i].right != !said) fail_msg("%s um: '%s'", taken[i].um, said ? said->message : "nothing of 349");
        if (said) assert_non_null(strstr(said->message, "but 2 um lie there"));
    }
}

/* ampere for angstrom is another dimension, minutes for seconds another range */
static void replaced_values_keep_their_range(void **state) {
    (void)state;
    static const char *const again[] = {
        "<q id=\"h.x\" least=\"1\" most=\"9\" value=\"3\" u=\"0\" unit=\"um/min\" "
        "status=\"assumed\" src=\"default\"/>",
        "<q id=\"h.x\" value=\"3\" u=\"0\" unit=\"%s\" status=\"assumed\" src=\"guess\"/>"};
    static const struct {
        const char *unit;
        int number; /* 0: fine */
    } with[] = {{"um/min", 0}, {"Ao/s", 278}, {"um/s", 278}, {"A/s", 169}};
    size_t nb = 0, n = 0;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, SILICON, &n);
    base =
        replaced(arena, base, "</process>", fw_arena_printf(arena, "%s</process>", again[0]), &nb);
    for (size_t i = 0; i < sizeof with / sizeof with[0]; i++) {
        fw_process_flow *flow = NULL;
        size_t m = n;
        const char *q = fw_arena_printf(
            arena,
            "<q id=\"h.x\" value=\"3\" u=\"0\" unit=\"%s\" status=\"assumed\" src=\"guess\"/>"
            "<q id=\"pan.R\"",
            with[i].unit);
        const char *own = replaced(arena, text, "<q id=\"pan.R\"", q, &m);
        diags = fw_diags_new(arena);
        fw_status status =
            fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", own, m, &diags, &flow);
        assert_int_equal(status, with[i].number ? FW_INPUT : FW_OK);
        if (with[i].number) expect(with[i].number, "h.x");
    }
}

/* a bath that nobody names is in no bill; a laboratory's resist meets the spinner as the pack's own does */
static void baths_are_named_and_spinners_turn(void **state) {
    (void)state;
    static const char *const uses[][2] = {{SILICON, "pan"}, {SILICON, "developing"}, {COPPER, "anodising"},
                                          {COPPER, "plating"}, {COPPER, "seed-etch"}};
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        diags = fw_diags_new(arena);
        const char *from = fw_arena_printf(arena, "<uses bath=\"%s\"/>", uses[i][1]);
        assert_non_null(read_pack(arena, uses[i][0], from, "", &diags));
        expect(562, "is done in a bath, and names none");
    }
    diags = fw_diags_new(arena);
    assert_non_null(read_pack(arena, SILICON, "<uses bath=\"sc1\"/>", "", &diags));
    expect(562, "step S02 (clean) is done in 'h.sc1', and uses nothing of that");
    for (int um = 1; um <= 40; um++) { /* 8000 rpm for 1 um, 100 for 9 */
        char to[64];
        snprintf(to, sizeof to, "id=\"litho.resist\" value=\"%d\"", um);
        const double rpm = 4000 * pow(1.4 / um, 1 / 0.503);
        diags = fw_diags_new(arena);
        read_pack(arena, SILICON, "id=\"litho.resist\" value=\"2\"", to, &diags);
        assert_int_equal(said_of(563, "step S07") != NULL, rpm < 100 || rpm > 12000);
    }
}

/* a laboratory's value is of the range of the quantity that it takes the place of */
static void ranges_are_those_of_what_it_is(void **state) {
    (void)state;
    static const struct {
        const char *pack, *from, *to, *says;
    } bad[] = {
        {SILICON, "id=\"litho.wavelength\" value=\"405\"", "id=\"litho.wavelength\" value=\"-405\"", "100 to 1100"},
        {SILICON, "id=\"spin.t\" value=\"60\"", "id=\"spin.t\" value=\"60000\"", "5 to 600"},
        {SILICON, "id=\"wax.d\" value=\"10\"", "id=\"wax.d\" value=\"10000\"", "a layer of a wafer"},
        {SILICON, "id=\"rie.p\" value=\"80\"", "id=\"rie.p\" value=\"8000000\"", "an atmosphere"},
        {SILICON, "id=\"clean.t\" value=\"35\"", "id=\"clean.t\" value=\"50000\"", "a month"},
        {COPPER, "id=\"cu.d\" value=\"9\"", "id=\"cu.d\" value=\"-9\"", "a layer of a wafer"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, bad[i].pack, bad[i].from, bad[i].to, &diags));
        expect(278, bad[i].says);
    }
}

static void shared_hazards(void **state) {
    (void)state;
    static const struct {
        const char *from, *to;
        int number;
        const char *says;
    } bad[] = {
        {"ghs=\"GHS02 GHS05 GHS06\" buddy=\"yes\"", "ghs=\"GHS02 GHS05 GHS06\"", 174,
         "state buddy"},
        {"calcium gluconate gel until help arrives. Eyes: rinse 15 min or longer. Inhaled",
         "cream until help arrives. Eyes: rinse 15 min or longer. Inhaled", 0, ""},
        {"<waste stream=\"solvent\">solvent can", "<waste stream=\"acid-oxidiser\">solvent can",
         175, "both go to the waste"},
        {"<attacks material=\"aluminium\"/>", "<attacks material=\"aluminum\"/>", 165,
         "did you mean 'aluminium'?"},
        {" reacts-as=\"alcohol ketone\"", "", 501, "'h.solvent' is a liquid"},
        {"reacts-as=\"alcohol ketone\"", "reacts-as=\"alcohol keton\"", 502, "reacts as 'keton'"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        size_t nb = 0, n = 0;
        fw_process_flow *flow = NULL;
        const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, SILICON, &n);
        base = replaced(arena, base, bad[i].from, bad[i].to, &nb);
        diags = fw_diags_new(arena);
        fw_status status =
            fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", text, n, &diags, &flow);
        assert_int_equal(status, bad[i].number ? FW_INPUT : FW_OK);
        if (bad[i].number) expect(bad[i].number, bad[i].says);
    }
    /* the antidote is missing everywhere: said for both acids */
    size_t nb = 0, n = 0;
    fw_process_flow *flow = NULL;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, SILICON, &n);
    while (strstr(base, "gluconate"))
        base = replaced(arena, base, "gluconate", "chloride", &nb);
    diags = fw_diags_new(arena);
    assert_int_equal(
        fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", text, n, &diags, &flow),
        FW_INPUT);
    expect(174, "'h.hf-organic' is hydrofluoric acid");
    expect(174, "'h.hf-copper' is hydrofluoric acid");
}

/* from which step on a sheet is of dies */
static void sheets_go_over_to_dies(void **state) {
    (void)state;
    static const struct {
        const char *flow, *last_of_wafers; /* NULL: all are */
    } packs[] = {
        {SILICON, "S20"}, {"silicon-on-glass", "G48"}, {COPPER, NULL}, {"soi-deep-rie", NULL}};
    for (size_t i = 0; i < sizeof packs / sizeof packs[0]; i++) {
        diags = fw_diags_new(arena);
        const fw_process_flow *f = read_pack(arena, packs[i].flow, NULL, NULL, &diags);
        assert_non_null(f);
        bool dies = false;
        for (int k = 0; k < f->nstep; k++) {
            assert_int_equal(fw_process_step_is_of_dies(f, k), dies);
            dies = dies ||
                   (packs[i].last_of_wafers && strcmp(f->step[k].id, packs[i].last_of_wafers) == 0);
        }
        assert_int_equal(dies, packs[i].last_of_wafers != NULL);
    }
    /* what comes off the carrier is dies, though the pack says nothing of it */
    diags = fw_diags_new(arena);
    assert_non_null(read_pack(arena, SILICON, " attended=\"10\" leaves=\"dies\">",
                              " attended=\"10\">", &diags));
    expect(552, "after step S20 nothing is left between the dies");
}

/* a copy of the exposure behind itself */
static void one_coat_is_exposed_once(void **state) {
    (void)state;
    size_t nb = 0, n = 0;
    fw_process_flow *flow = NULL;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, SILICON, &n);
    const char *from = strstr(text, "  <step id=\"S09\""), *to = strstr(from, "  <step id=\"S10\"");
    const char *twice = fw_arena_printf(arena, "%.*s  <step id=\"S09b\"%s", (int)(to - text), text,
                                        from + strlen("  <step id=\"S09\""));
    diags = fw_diags_new(arena);
    assert_int_equal(fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", twice,
                                          strlen(twice), &diags, &flow),
                     FW_OK);
    expect(506, "which step S09 has exposed");
}

static int reasons(const fw_process_flow *f, const char *says) {
    int n = 0;
    for (int i = 0; i < f->nreason; i++)
        n += strstr(f->reason[i], says) != NULL;
    return n;
}

/* 1 um of aluminium for 50 um of silicon and 10 % over-etch: gone below S = 55 */
/* groups alone decide, whatever a pack lists; a mixture that holds both of a pair has met already */
static void liquids_react_by_their_groups(void **state) {
    (void)state;
    static const struct {
        const char *a, *b;
        const char *says; /* NULL: nothing is known against it */
    } pairs[] = {
        {"acid", "base", "heat each other"},
        {"oxidiser ammonium", "base", "ammonia is set free"},
        {"alcohol ketone", "base ammonia oxidiser", "peroxides"},
        {"ketone", "oxidiser", "peroxides"},
        {"iodine", "base ammonia oxidiser", "nitrogen triiodide"},
        {"cyanide base", "acid", "hydrogen cyanide"},
        {"cyanide", "organic-acid", "hydrogen cyanide"},
        {"fluoride ammonium", "acid", "hydrogen fluoride"},
        {"fluoride", "organic-acid", "hydrogen fluoride"},
        {"acid fluoride", "acid", NULL},
        {"acid fluoride", "alcohol", NULL},
        {"acid fluoride alcohol organic-acid", "alcohol", NULL},
        {"acid oxidising-acid alcohol", "alcohol", NULL},
        {"base", "alcohol", NULL},
        {"none", "oxidising-acid", NULL},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        for (int turn = 0; turn < 2; turn++) {
            const char *one = turn ? pairs[i].b : pairs[i].a,
                       *other = turn ? pairs[i].a : pairs[i].b;
            const fw_process_hazard a = {.id = "a", .reacts = fw_process_reacts_as(one)},
                                    b = {.id = "b", .reacts = fw_process_reacts_as(other)};
            const char *what = fw_process_reaction(&a, &b);
            if (!pairs[i].says)
                assert_null(what);
            else if (!what || !strstr(what, pairs[i].says))
                fail_msg("%s and %s: %s", one, other, what ? what : "nothing");
        }
    assert_null(fw_process_reaction(
        NULL, &(fw_process_hazard){.id = "a", .reacts = fw_process_reacts_as("acid")}));
}

/* an uncertainty that no quantity of its kind can have; the pack as it is, and a laboratory that says so */
static void uncertainties_make_sense(void **state) {
    (void)state;
    static const struct {
        const char *id, *says; /* of a laboratory's <q> */
        int number;            /* 0: fine */
    } at[] = {{"pan.R", "value=\"10\" u=\"11\" unit=\"Ao/s\"", 530},
              {"pan.R", "value=\"10\" urel=\"1.5\" unit=\"Ao/s\"", 530},
              {"pan.R", "value=\"10\" urel=\"0.9\" unit=\"Ao/s\"", 0},
              {"pan.R", "value=\"10\" u=\"-1\" unit=\"Ao/s\"", 71},
              {"pan.R", "value=\"10\" u=\"0\" unit=\"Ao/s\"", 531},
              {"rie.A", "value=\"0.97\" lo=\"0.9\" hi=\"1.02\" unit=\"1\"", 530},
              {"rie.A", "value=\"0.97\" lo=\"0.9\" hi=\"1\" unit=\"1\"", 0},
              {"hard.T", "value=\"115\" u=\"120\" unit=\"Cel\"", 530},
              {"hard.T", "value=\"115\" u=\"4\" unit=\"Cel\"", 0},
              {"litho.edge", "value=\"0\" u=\"200\" unit=\"um\"", 530},
              {"litho.edge", "value=\"0\" u=\"0.1\" unit=\"um\"", 0},
              {"al.overetch", "value=\"0.1\" u=\"0\" unit=\"1\"", 0},
              {"pan.T", "value=\"22\" u=\"0\" unit=\"Cel\"", 531},
              {"rie.price", "value=\"60\" u=\"0\" unit=\"EUR/h\"", 0}, /* an offer is exact */
              {"pan.serves", "value=\"1\" u=\"0\" unit=\"1\"", 0}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        diags = fw_diags_new(arena);
        fw_process_flow *flow = read_pack(arena, SILICON, NULL, NULL, &diags);
        const char *lab = fw_arena_printf(
            arena,
            "<process xmlns=\"urn:flexwright:process:1\" flow=\"al-masked-rie\"><source id=\"m\" "
            "kind=\"measured\">x</source><q id=\"%s\" %s status=\"measured\" src=\"m\"/>"
            "</process>",
            at[i].id, at[i].says);
        fw_status status = fw_process_lab_apply(arena, "lab.xml", lab, strlen(lab), flow, &diags);
        bool error = at[i].number == 530 || at[i].number == 71;
        assert_int_equal(status, error ? FW_INPUT : FW_OK);
        if (at[i].number)
            expect(at[i].number, at[i].number == 71 ? "negative" : at[i].id);
        else if (said_of(530, at[i].id) || said_of(531, at[i].id))
            fail_msg("%s %s: %s", at[i].id, at[i].says, diags.item[diags.count - 1].message);
    }
}

/* a time of nothing, a bake of nothing, a unit that is none: each as a pack and its words */
static void steps_that_do_nothing(void **state) {
    (void)state;
    fw_process_flow *f =
        computed_pack(SILICON, "id=\"peb.t\" value=\"60\"", "id=\"peb.t\" value=\"0\"");
    assert_non_null(said_of(534, "step S10 takes no time"));
    assert_int_equal(f->manufacturable, 0);
    computed_pack(SILICON, "hi=\"200\" unit=\"um\"", "hi=\"200\" unit=\"umm\"");
    assert_non_null(said_of(533, "did you mean 'um'"));
    diags = fw_diags_new(arena);
    const char *cold = "<q id=\"bake.T\" value=\"20\"";
    assert_null(read_pack(arena, SILICON, "<q id=\"bake.T\" value=\"100\"", cold, &diags));
    assert_non_null(said_of(532, "step S08 bakes at 20 Cel"));
    /* six wafers into a bench of six pass, into one of four do not, whatever the lot */
    diags = fw_diags_new(arena);
    const char *bench = "id=\"clean-bench\" class=\"wet bench for SC1\" capacity=\"6\"";
    const char *smaller = "id=\"clean-bench\" class=\"wet bench for SC1\" capacity=\"4\"";
    assert_null(read_pack(arena, SILICON, bench, smaller, &diags));
    assert_non_null(said_of(558, "step S02 is for 6 wafers at once, and clean-bench takes 4"));
}

/* what a law says of the time of a step is what the bench can keep, with its pauses where it is done in parts */
static void times_of_laws_can_be_kept(void **state) {
    (void)state;
    static const struct {
        const char *id;
        double value;
        const char *says; /* NULL: nothing */
    } of[] = {{"pan.R", 1e-9, NULL},
              {"pan.R", 6e-12, NULL},
              {"pan.R", 5e-12, "step S14 (wet-etch) takes 3333 min by its law (arrhenius), but nobody stops"},
              {"pan.R", 3e-7, NULL},
              {"pan.R", 4e-7, "step S14 (wet-etch) takes 0.04167 min by its law (arrhenius), but nobody stops"},
              {"rie.break", 600, NULL},
              {"rie.break", 1e5, "step S18 (dry-etch) takes 5099 min by its law (arde) and its pauses, but a plasma burns"}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
        measured(f, of[i].id, of[i].value, 1e-3 * of[i].value);
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        const fw_diag *said = said_of(577, "by its law");
        if (of[i].says ? !said || !strstr(said->message, of[i].says) : said != NULL)
            fail_msg("%s = %g: '%s'", of[i].id, of[i].value, said ? said->message : "nothing");
        if (said) assert_true(said_of(577, "by its law")->place.line > 0);
    }
}

static const char *step_text(const char *text, const char *id, size_t *n) {
    const char *from = strstr(text, fw_arena_printf(arena, "  <step id=\"%s\"", id));
    assert_non_null(from);
    const char *to = strstr(from, "</step>\n") + strlen("</step>\n");
    *n = (size_t)(to - from);
    return fw_arena_strndup(arena, from, *n);
}

static const char *in_place(const char *text, const char *from, const char *to) {
    const char *at = strstr(text, from);
    if (!at) fail_msg("no '%s'", from);
    return fw_arena_printf(arena, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
}

/* the steps once more before another one, under ids of their own */
static const char *again_before(const char *text, const char *before, const char *const *ids) {
    const char *more = "";
    size_t n;
    for (; *ids; ids++) {
        const char *s = step_text(text, *ids, &n), *lag = strstr(s, "    <lag ");
        if (lag) s = in_place(s, fw_arena_strndup(arena, lag, (size_t)(strchr(lag, '\n') + 1 - lag)), "");
        s = in_place(s, fw_arena_printf(arena, "id=\"%s\"", *ids), fw_arena_printf(arena, "id=\"%sB\"", *ids));
        more = fw_arena_printf(arena, "%s%s", more, s);
    }
    const char *at = fw_arena_printf(arena, "  <step id=\"%s\"", before);
    return in_place(text, at, fw_arena_printf(arena, "%s%s", more, at));
}

static void judged_as(const char *name, const char *text, int number, fw_severity severity, const char *says) {
    size_t nb = 0;
    const char *base = pack_text(arena, "base", &nb);
    fw_process_flow *f = NULL;
    diags = fw_diags_new(arena);
    fw_process_flow_read(arena, "base.xml", base, nb, name, text, strlen(text), &diags, &f);
    expect(number, says);
    assert_int_equal(said_of(number, says)->severity, severity);
}

/* several changes at once: no carrier, a hard bake before lift-off, resist over a deep cut, coats of what is free, wires
   before there are chips; each passed before its rule was there */
static void flows_of_wrong_steps(void **state) {
    (void)state;
    size_t n = 0, length;
    const char *silicon = pack_text(arena, SILICON, &n), *glass = pack_text(arena, GLASS, &n),
               *soi = pack_text(arena, "soi-deep-rie", &n);
    const char *thin = in_place(silicon, step_text(silicon, "S05", &length), "");
    thin = in_place(thin, "    <requires step=\"S05\"/>\n", "");
    thin = in_place(thin, "    <exposed material=\"carrier-wax\" rate=\"rie.R-wax\"/>\n", "");
    thin = in_place(thin, "    <change kind=\"remove\" material=\"carrier-wax\"/>\n", "");
    thin = in_place(thin, "    <change kind=\"remove\" material=\"carrier\"/>\n", "");
    judged_as(SILICON, thin, 625, FW_ERROR, "step S18 etches through the wafer, and between the dies 50 um");
    judged_as(GLASS, again_before(glass, "G26", (const char *const[]){"G36", NULL}), 630, FW_WARNING,
              "step G26 puts 'lifted-metal' on 'resist'");
    judged_as("soi-deep-rie", again_before(soi, "D11", (const char *const[]){"D03", "D04", "D05", "D06", "D07", NULL}),
              588, FW_WARNING, "step D04B spins 2.5 um of 'resist' over edges of 50 um");
    judged_as("soi-deep-rie", again_before(soi, "D13", (const char *const[]){"D04", "D05", NULL}), 337, FW_ERROR,
              "step D04B spins a liquid on devices that are free");
    judged_as(GLASS, again_before(glass, "G48", (const char *const[]){"G52", NULL}), 552, FW_ERROR,
              "step G52B packages chips");
}

/* somebody is there from the first look to the stop time, and for no hours beyond a computed time */
static void who_is_there(void **state) {
    (void)state;
    static const char al[] = "equipment=\"al-bench\" in-source=\"yes\" batch=\"1\" attended=\"22\"";
    static const struct {
        const char *from, *to;
        int number;
        const char *says;
    } at[] = {
        {al, "equipment=\"al-bench\" in-source=\"yes\" batch=\"1\" attended=\"2\"", 617, "somebody is at step S14 for 2 min"},
        {"equipment=\"litho-bench\" in-source=\"yes\" batch=\"1\" attended=\"5\">",
         "equipment=\"litho-bench\" in-source=\"yes\" batch=\"1\" attended=\"0.5\">", 617, "somebody is at step S11 for 0.5 min"},
        {al, "equipment=\"al-bench\" in-source=\"yes\" batch=\"1\" attended=\"220\"", 609, "somebody stands at step S14 for 220 min"},
        {"equipment=\"rie\" in-source=\"yes\" batch=\"1\" attended=\"15\"", "equipment=\"rie\" in-source=\"yes\" batch=\"1\" attended=\"480\"",
         609, "somebody stands at step S18 for 480 min"},
    };
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        fw_process_flow *f = computed_pack(SILICON, at[i].from, at[i].to);
        expect(at[i].number, at[i].says);
        assert_true(reasons(f, at[i].says) == 1);
    }
    /* a minute of developing, a fifth of it over, and an hour beside it, all told 61.2 min */
    static const char developed[] = "title=\"Develop, rinse, dry\" equipment=\"litho-bench\" in-source=\"yes\" batch=\"1\" attended=\"5\"";
    for (int minutes = 61; minutes <= 62; minutes++) {
        char *to = fw_arena_printf(arena, "title=\"Develop, rinse, dry\" equipment=\"litho-bench\" in-source=\"yes\" batch=\"1\" attended=\"%d\"",
                                   minutes);
        diags = fw_diags_new(arena);
        read_pack(arena, SILICON, developed, to, &diags);
        assert_true(!said_of(609, "at step S11 for") == (minutes == 61));
    }
    computed_pack(SILICON, NULL, NULL);
    assert_null(said_of(617, ""));
    assert_null(said_of(609, ""));
    /* what goes on under current is switched off by somebody, and what a bath displaces goes on in it; an ash ends by itself */
    static const char plated[] = "equipment=\"plater\" in-source=\"yes\" batch=\"1\" attended=\"%d\"";
    for (int minutes = 2; minutes <= 6; minutes += 4) {
        fw_process_flow *f = computed_pack(COPPER, fw_arena_printf(arena, plated, 6), fw_arena_printf(arena, plated, minutes));
        const char *says = "somebody is at step C22 for 2 min";
        assert_true(!said_of(617, says) == (minutes == 6));
        assert_true(!said_of(617, "switches the current off") == (minutes == 6));
        assert_true(reasons(f, says) == (minutes == 2));
    }
    static const char left[] = "\"displace\" \"anodise\" \"develop\" \"plate\" \"strip\" \"clean\" \"deposit\"";
    fw_process_step s = {.law = "const"};
    const fw_process_goes_on is[] = {FW_GOES_ON_IN_BATH, FW_GOES_ON_UNDER_CURRENT, FW_GOES_ON_IN_BATH, FW_GOES_ON_UNDER_CURRENT,
                                     FW_GOES_ON_IN_BATH, FW_GOES_ON_NOT,           FW_GOES_ON_NOT};
    const char *at_kind = left;
    fw_word kind;
    for (size_t i = 0; fw_word_next(&at_kind, " \"", &kind); i++) {
        assert_non_null(s.op = fw_arena_strndup(arena, kind.at, kind.length));
        assert_int_equal(fw_process_step_goes_on(&s), is[i]);
    }
    /* runs add up where the time is that of an amount */
    const struct {
        const char *op, *law;
        bool adds;
    } run[] = {{"wet-etch", "rate", true}, {"bake", "rate", true}, {"bake", "const", false}, {"strip", "const", false}, {"strip", "arrhenius", true}, {"develop", "const", true}, {"coat", "spin", false}, {"hold", "diffusion", false}, {"of a laboratory", "rate", false}};
    for (size_t i = 0; i < sizeof run / sizeof run[0]; i++) {
        s.op = run[i].op, s.law = run[i].law;
        assert_int_equal(fw_process_step_adds_up(&s), run[i].adds);
    }
}

/* one die in the middle of the pack's own wafer, where the description lays out none; currents against the supply */
static void the_packs_own_wafer(void **state) {
    (void)state;
    static const struct {
        const char *pack;
        double side_mm;
        const char *says; /* NULL: it fits */
    } at[] = {{COPPER, 29.0, NULL},
              {COPPER, 30.0, "inside a circle of 42 mm"},
              {COPPER, 40.0, "but the wafer is 50.8 mm wide"},
              {SILICON, 70.0, NULL},
              {SILICON, 71.0, "but the wafer is 100 mm wide"}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        fw_process_mask_facts facts = plain_facts;
        facts.die_area_m2 = 1e-6 * at[i].side_mm * at[i].side_mm, facts.dies = 1;
        diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, at[i].pack, NULL, NULL, &diags);
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        assert_int_equal(reasons(f, "reaches across"),
                         at[i].says ? (strstr(at[i].says, "wafer is 50") ? 2 : 1) : 0);
        if (at[i].says) assert_true(reasons(f, at[i].says) == 1);
    }
    /* what is proposed keeps the dies inside, or says that no die fits */
    fw_process_mask_facts laid = plain_facts;
    laid.die_area_m2 = 9e-6, laid.dies = 400, laid.wafer_diameter_m = 0.1, laid.wafer_reach_m = 0.0468;
    diags = fw_diags_new(arena);
    fw_process_flow *out = read_pack(arena, COPPER, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, out, &laid, &diags), FW_OK);
    assert_int_equal(reasons(out, "a tool that wide, or edge-exclusion=\"4.4 mm\" of the <wafer>"), 1);
    laid.die_area_m2 = 4.9e-3;
    diags = fw_diags_new(arena);
    out = read_pack(arena, COPPER, NULL, NULL, &diags);
    assert_int_equal(fw_process_flow_compute(arena, out, &laid, &diags), FW_OK);
    assert_int_equal(reasons(out, "a tool that wide, or a smaller die"), 1);
    fw_process_flow *f =
        computed_pack(COPPER, "id=\"wafer.D\" value=\"50.8\"", "id=\"wafer.D\" value=\"150\"");
    assert_int_equal(reasons(f, "step C05: current, against what the galvanostat gives is 3.1"), 1);
    f = computed_pack(COPPER, "id=\"ps.J\" least=\"0.5\" most=\"500\" value=\"20\"",
                      "id=\"ps.J\" least=\"0.5\" most=\"500\" value=\"150\"");
    assert_int_equal(reasons(f, "step C05: current, against what the galvanostat gives is 2.0"), 1);
}

static void loss(void **state) {
    (void)state;
    const char *from =
        "<q id=\"rie.selectivity\" least=\"1\" most=\"100000\" value=\"100\" u=\"50\"";
    static const struct {
        double S, u;
        int gone; /* 1 no, 0 perhaps, -1 not told */
    } at[] = {{100, 50, 0}, {100, 10, -1}, {55.1, 0, -1},
              {54.9, 0, 1}, {61, 2.9, -1}, {61, 3.1, 0}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        const char *to = fw_arena_printf(
            arena, "<q id=\"rie.selectivity\" least=\"1\" most=\"100000\" value=\"%g\" u=\"%g\"",
            at[i].S, at[i].u);
        fw_process_flow *f = computed_pack(SILICON, from, to);
        assert_int_equal(reasons(f, "of the open"), at[i].gone >= 0);
        assert_int_equal(said_of(270, "S18") != NULL, at[i].gone == 1);
        assert_int_equal(f->manufacturable, at[i].gone == 1 ? 0 : -1); /* A is unknown anyway */
    }
    /* by rate: the developer takes 75 nm/min for 60 s and 20 % over: 90 nm */
    fw_process_flow *f = computed_pack(SILICON, "<q id=\"develop.al\" value=\"75\" u=\"15\"",
                                       "<q id=\"develop.al\" value=\"840\" u=\"0\"");
    assert_int_equal(reasons(f,
                             "step S11 takes 1.01 um of the open aluminium, sputtered, 1 um thick, "
                             "at a rate of 840 nm/min (u = 0): it lasts below 833.3 nm/min"),
                     1);
    assert_non_null(said_of(270, "S11"));
    f = computed_pack(SILICON, "<q id=\"develop.al\" value=\"75\" u=\"15\"",
                      "<q id=\"develop.al\" value=\"500\" u=\"0\"");
    assert_int_equal(reasons(f, "step S11"), 0);
}

/* The mask is taken for as long as the step is planned: 50 um at S = 60 and a tenth more are 0.917 um where openings are
   wide, and 1 um lasts; a slot of 10 um that lags by S = 0.5 needs 1.49 times that time, and the mask is gone. A lag that is
   only assumed is in no time. */
static void mask_lasts_as_planned(void **state) {
    (void)state;
    static const struct {
        double S;
        const char *status;
        bool gone;
    } at[] = {{0, "measured", false}, {0.05, "measured", false}, {0.5, "measured", true},
              {0.5, "assumed", false}};
    for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
        diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
        measured(f, "rie.selectivity", 60, 1);
        measured(f, "rie.S", at[i].S, 0);
        ((fw_quantity *)fw_process_flow_quantity(f, "rie.S"))->status =
            strcmp(at[i].status, "assumed") == 0 ? FW_ASSUMED : FW_MEASURED;
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        const fw_process_step *s = step_of(f, "S18");
        const double wide_s = fw_process_flow_quantity(f, "rie.t-wide")->value;
        double most, loss = fw_process_exposed_loss(s, &s->exposed[0], &most);
        assert_relative(loss, 55e-6 / 60 * s->time.nominal_s / wide_s, 1e-12);
        assert_int_equal(loss > 1e-6, at[i].gone);
        assert_int_equal(said_of(270, "S18") != NULL, at[i].gone);
        assert_int_equal(f->manufacturable, at[i].gone ? 0 : -1); /* A is unknown anyway */
        assert_relative(fw_process_flow_quantity(f, "rie.t-planned")->value,
                        1.1 * s->time.nominal_s, 1e-12);
    }
}

/* Wax lies below the silicon: 0.5 um/min would take 49.5 um of it in 99 min, and takes 4.5 um in the 9 min of the over-etch,
   of the 10 um that are there. Of resist, which lies open from the start, all of the time counts. */
static void bare_once_it_is_through(void **state) {
    (void)state;
    static const double rate_um_min[] = {0.5, 1.0, 1.2};
    for (size_t i = 0; i < 3; i++) {
        double most;
        diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
        measured(f, "rie.R-wax", rate_um_min[i] * 1e-6 / 60, 1e-12);
        measured(f, "rie.R", 50e-6 / 5400, 1e-14);
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        const fw_process_step *s = step_of(f, "S18");
        assert_false(s->exposed[0].uncovered);
        assert_true(s->exposed[1].uncovered);
        assert_relative(fw_process_exposed_loss(s, &s->exposed[1], &most), rate_um_min[i] * 9e-6,
                        1e-9);
        assert_true(most >= rate_um_min[i] * 9e-6);
        assert_int_equal(said_of(270, "S18") != NULL, i == 2);
        assert_int_equal(f->manufacturable, i == 2 ? 0 : -1); /* A is unknown anyway */
    }
    /* narrow openings are waited for while wide ones are through */
    fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
    double most;
    measured(f, "rie.R-wax", 0.5e-6 / 60, 1e-12);
    measured(f, "rie.S", 0.3, 0);
    assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
    const fw_process_step *s = step_of(f, "S18");
    assert_relative(fw_process_exposed_loss(s, &s->exposed[1], &most),
                    0.5e-6 / 60 * (1.1 * s->time.nominal_s - s->time.nominal_s / s->time.slowed), 1e-9);
    assert_non_null(said_of(270, "S18"));
}

/* a developer takes 0.72 of 1 um of the aluminium that it opens, and what takes 0.6 um after it finds 0.28 um */
static void what_was_lost_before_is_gone(void **state) {
    (void)state;
    for (int twice = 0; twice < 2; twice++) {
        diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, SILICON, NULL, NULL, &diags);
        fw_process_step *develop = step_of(f, "S11"), *bake = step_of(f, "S13");
        measured(f, "develop.al", 0.6e-6 / 60, 1e-12);
        if (twice) { /* in the open field, which the developer has opened */
            bake->exposed = develop->exposed;
            bake->nexposed = develop->nexposed;
            measured(f, "hard.t", 60, 0.1);
            bake->op = develop->op;
        }
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        assert_null(said_of(270, "S11")); /* 0.72 of 1 um */
        assert_int_equal(said_of(270, "step S13 removes 0.6 um of aluminium, sputtered, but that layer is only 0.28 "
                                      "um thick by then") != NULL,
                         twice);
    }
}

/* two coats of 8 um are the mould: 16 um */
static void mould(void **state) {
    (void)state;
    fw_process_mask_facts facts = plain_facts;
    static const double thick_um[] = {9.0, 15.99, 16.01, 30.0};
    for (size_t i = 0; i < 4; i++) {
        diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, COPPER, NULL, NULL, &diags);
        facts.device_thickness_m = thick_um[i] * 1e-6;
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        bool over = thick_um[i] > 16.0;
        assert_int_equal(reasons(f, "grows over it"), over);
        assert_int_equal(said_of(273, "C22") != NULL, over);
        if (over) assert_int_equal(f->manufacturable, 0);
    }
    fw_process_flow *f =
        computed_pack(COPPER, "thickness=\"cu.d\" where=\"structure\"/>",
                      "thickness=\"cu.d\" where=\"structure\" spread=\"mould.spins\"/>");
    assert_int_equal(reasons(f, "plates up to 18 um"), 1); /* twice the mean */
}

/* copper that was descummed half a day before, or whenever; and a porous layer out of alcohol is only told */
static void what_is_told(void **state) {
    (void)state;
    static const char flow_lag[] = "<lag from=\"C20\" max=\"15\" unit=\"min\"/>";
    static const change told[] = {
        {COPPER, flow_lag, "<lag from=\"C20\" max=\"15\" unit=\"h\"/>", 614, "step C22 (plate) may come 15 h after step C20"},
        {COPPER, flow_lag, "", 614, "step C22 (plate) may come at any time after step C20"},
        {GLASS, "<lag from=\"G18\" max=\"1\" unit=\"h\"/>", "", 614, "(bond) may come at any time after step G18"},
        {COPPER, "<finish kind=\"rinse\" q=\"seed.t-off\"/>",
         "<finish kind=\"rinse\" q=\"seed.t-off\"/><finish kind=\"rinse\" with=\"h.solvent\">alcohol</finish>"
         "<finish kind=\"dry\" by=\"nitrogen\"/><!-- -->", 613, "where it is thick or very porous"},
        {COPPER, "<arg name=\"current_density\" q=\"cu.J\"/>", "<arg name=\"current_density\" q=\"ps.J\"/>", 561,
         "with 'ps.J' as its current_density"},
        {COPPER, "<arg name=\"area\" q=\"mask.plated-area\"/></time>", "<arg name=\"area\" q=\"cell.area\"/></time>", 561,
         "step C22 takes 'cell.area' for the area that it plates"},
        {SILICON, "equipment=\"aligner\"", "equipment=\"metrology\"", 608, "step S09 (expose) is done at 'metrology'"},
        {SILICON, "<finish kind=\"rinse\" q=\"al-rinse.t\"/>\n    <finish kind=\"dry\" by=\"spin\"/>",
         "<finish kind=\"rinse\" q=\"al-rinse.t\"/>\n    <finish kind=\"dry\" by=\"air\"/>", 618,
         "step S14 lets the water of its rinse dry in air"},
        {SILICON, "    <requires material=\"aluminium\"/>\n    <requires material=\"carrier\" is=\"absent\"/>\n", "", 628,
         "step S04 (inspect) changes nothing"},
        {SILICON, "id=\"bake.T\" value=\"100\" u=\"1\" unit=\"Cel\" status=\"typical\" src=\"microchemicals\"/>",
         "id=\"bake.T\" value=\"60\" u=\"1\" unit=\"Cel\" status=\"typical\" src=\"microchemicals\"/>", 593,
         "step S08 bakes at 60 Cel (bake.T), and solvent stays in the resist"},
        {SILICON, "id=\"hmds.T\" value=\"150\"", "id=\"hmds.T\" value=\"50\"", 593, "water stays on the wafer below 95 Cel"},
        {SILICON, "    <lag from=\"S06\" max=\"4\" unit=\"h\"/>\n", "", 614, "step S07 (coat) may come at any time after step S06, which bakes dry"},
        {COPPER, "op=\"mount\" title=\"Plating jig", "op=\"hold\" title=\"Plating jig", 631, "step C22 (plate) lets a current through"},
        {GLASS, "<change kind=\"remove\" material=\"gold\" thickness=\"mask-gold.d\" where=\"cavity\"/>",
         "<change kind=\"remove\" material=\"gold\" thickness=\"mask-gold.d\" where=\"cavity\"/>\n"
         "<change kind=\"remove\" material=\"resist\" side=\"back\"/><change kind=\"remove\" material=\"back-metal\" side=\"back\"/>",
         632, "step G12 etches 'glass-carrier' on the front, and it lies open on the back"},
        {GLASS, "    <change kind=\"add\" material=\"resist\" thickness=\"litho.resist\" side=\"back\"/>\n", "", 632,
         "step G10 is done in 'h.gold', which attacks 'back-metal', and that lies open on the back"},
        {COPPER, "id=\"bath.volume\" value=\"100\" u=\"2\"", "id=\"bath.volume\" value=\"1\" u=\"0.1\"", 608,
         "step C05 uses a filling of 1 mL of bath 'anodising'"},
    };
    for (size_t i = 0; i < sizeof told / sizeof told[0]; i++) {
        diags = fw_diags_new(arena);
        read_pack(arena, told[i].flow, told[i].from, told[i].to, &diags);
        expect(told[i].number, told[i].says);
        assert_int_equal(said_of(told[i].number, told[i].says)->severity, FW_WARNING);
    }
}

/* n = rho d A/M against c V: docs/theory/process.md, knowledge of Faraday's law: 1.269 mmol for 9
   um on 10 cm2 */
static void bath(void **state) {
    (void)state;
    static const struct {
        const char *concentration;
        bool warns;
    } cases[] = {{"value=\"0.75\" u=\"0.02\"", true},
                 {"value=\"7.5\" u=\"0.02\"", false},
                 {"unknown=\"true\"", false}};
    for (int i = 0; i < 3; i++) {
        diags = fw_diags_new(arena);
        const char *to = fw_arena_printf(arena, "<q id=\"cu.bath-c\" %s", cases[i].concentration);
        fw_process_flow *f =
            read_pack(arena, COPPER, "<q id=\"cu.bath-c\" unknown=\"true\"", to, &diags);
        assert_non_null(f);
        ((fw_quantity *)fw_process_flow_quantity(f, "ring.area"))->value = 0.0;
        fw_process_mask_facts facts = plain_facts;
        facts.structure_area_m2 = 1e-3 / facts.dies; /* 10 cm2 in all */
        facts.die_area_m2 = 2e-3 / facts.dies;
        ((fw_quantity *)fw_process_flow_quantity(f, "cu.bath-V"))->value = 0.02e-3; /* 20 mL */
        assert_int_equal(fw_process_flow_compute(arena, f, &facts, &diags), FW_OK);
        const fw_quantity *taken = fw_process_flow_quantity(f, "cu.taken");
        assert_near(taken->value, 1.269e-3, 1e-6);
        const fw_diag *d = said_of(279, "C22");
        assert_int_equal(d != NULL, cases[i].warns);
        if (!d) continue;
        assert_non_null(strstr(d->message, "8.46")); /* 1.269 mmol of 15 mmol, in % */
        bool said = false;
        for (int k = 0; k < f->nreason; k++)
            said = said || strstr(f->reason[k], "share of the bath's copper");
        assert_true(said);
    }
    /* a limit of another kind */
    diags = fw_diags_new(arena);
    assert_null(read_pack(arena, COPPER, "most=\"cu.bath-fall\"", "most=\"cu.bath-V\"", &diags));
    expect(169, "cannot be the limit");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_is_told, setup, teardown),
        cmocka_unit_test_setup_teardown(bath, setup, teardown),
        cmocka_unit_test_setup_teardown(mistakes_of_a_flow, setup, teardown),
        cmocka_unit_test_setup_teardown(what_goes_sideways_is_as_thick_as_it_lies, setup, teardown),
        cmocka_unit_test_setup_teardown(replaced_values_keep_their_range, setup, teardown),
        cmocka_unit_test_setup_teardown(baths_are_named_and_spinners_turn, setup, teardown),
        cmocka_unit_test_setup_teardown(ranges_are_those_of_what_it_is, setup, teardown),
        cmocka_unit_test_setup_teardown(shared_hazards, setup, teardown),
        cmocka_unit_test(liquids_react_by_their_groups),
        cmocka_unit_test_setup_teardown(one_coat_is_exposed_once, setup, teardown),
        cmocka_unit_test_setup_teardown(uncertainties_make_sense, setup, teardown),
        cmocka_unit_test_setup_teardown(the_packs_own_wafer, setup, teardown),
        cmocka_unit_test_setup_teardown(steps_that_do_nothing, setup, teardown),
        cmocka_unit_test_setup_teardown(times_of_laws_can_be_kept, setup, teardown),
        cmocka_unit_test_setup_teardown(who_is_there, setup, teardown),
        cmocka_unit_test_setup_teardown(flows_of_wrong_steps, setup, teardown),
        cmocka_unit_test_setup_teardown(sheets_go_over_to_dies, setup, teardown),
        cmocka_unit_test_setup_teardown(loss, setup, teardown),
        cmocka_unit_test_setup_teardown(mask_lasts_as_planned, setup, teardown),
        cmocka_unit_test_setup_teardown(bare_once_it_is_through, setup, teardown),
        cmocka_unit_test_setup_teardown(what_was_lost_before_is_gone, setup, teardown),
        cmocka_unit_test_setup_teardown(mould, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
