/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Does a step take what is its own? The numbers of its law, its plate, its tool, its bath, its times among themselves, and
   the wafer that it wants. */
#include "base/constants.h"
#include "base/text.h"
#include "process/films.h"
#include "process/pack.h"
#include <math.h>
#include <string.h>

/* ---- numbers of its law ---- */

/* the one material that a step adds or takes away; NULL: several, none, or only what is exposed */
static const char *material_of(const fw_process_step *s) {
    const char *material = NULL;
    for (int k = 0; k < s->nchange; k++) {
        if (material && strcmp(material, s->change[k].material) != 0) return NULL;
        material = s->change[k].material;
    }
    return material;
}

/* Arguments that belong to one material or to one bath. A current density or an efficiency may by chance be that of another
   bath, and is then two numbers all the same: who changes one does not mean the other. */
static const struct {
    const char *argument;
    bool by_chance;
} own[] = {{"rate", false},           {"molar_mass", false}, {"density", false}, {"valence", true},
           {"current_density", true}, {"efficiency", true},  {"porosity", true}};

static void lint_own(fw_process_pack *pack, int at, const char *argument, bool by_chance) {
    const fw_process_step *s = &pack->flow->step[at];
    const fw_quantity *q = fw_process_step_argument(s, argument);
    const char *material = material_of(s);
    for (int i = 0; q && material && i < at; i++) {
        const fw_process_step *before = &pack->flow->step[i];
        const char *other = material_of(before);
        if (fw_process_step_argument(before, argument) != q || !other ||
            strcmp(other, material) == 0)
            continue;
        const char *why = fw_arena_printf(
            pack->arena,
            "the time of step %s is computed with '%s' as its %s, by which step %s is timed for "
            "'%s', but the step is of '%s'; name that of its own",
            s->id, q->id, argument, before->id, other, material);
        if (by_chance)
            fw_diag_warning(pack->diags, 561, s->place, "%s", why ? why : "");
        else
            fw_diag_error(pack->diags, 561, s->place, "%s", why ? why : "");
        return;
    }
}

/* what lies in a narrow opening lags behind, not what stands beside it */
static void lint_opening(fw_process_pack *pack, const fw_process_step *s) {
    static const char *const lines[] = {"mask.narrowest-line", "mask.narrowest-flexure"};
    const fw_quantity *width = fw_process_step_argument(s, "width");
    for (size_t i = 0; width && width->id && i < sizeof lines / sizeof *lines; i++)
        if (strcmp(width->id, lines[i]) == 0)
            fw_diag_error(pack->diags, 561, s->place,
                          "the time of step %s is computed for an opening as wide as '%s', which "
                          "is no opening; name the narrowest slot, or that of the masking layer",
                          s->id, width->id);
}

/* The supply gives the current of all that conducts in the bath: a plating whose area is another one has another current,
   charge and time on the sheet than in the jig. */
static void lint_area(fw_process_pack *pack, const fw_process_step *s) {
    static const char plated[] = "mask.plated-area";
    const fw_quantity *area = fw_process_step_argument(s, "area");
    if (!area || !area->id || !fw_process_step_is_op(s, "plate") || strcmp(area->id, plated) == 0 ||
        !fw_process_flow_quantity(pack->flow, plated))
        return;
    fw_diag_warning(pack->diags, 561, s->place,
                    "step %s takes '%s' for the area that it plates, and what the mask opens, with "
                    "contact ring and thief, is '%s'; the current goes with the area",
                    s->id, area->id, plated);
}

/* what is put on until it is as thick as wanted gets thicker by an overrun */
static void lint_overrun(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_law *law = fw_process_law_find(s->law);
    bool adds = false;
    for (int k = 0; k < s->nchange; k++)
        adds = adds || (strcmp(s->change[k].kind, "add") == 0 && s->change[k].thickness);
    if (!adds || !(s->overrun > 0.0) || !law || law->stated ||
        !fw_words_hold("deposit displace plate", " ", s->op))
        return;
    char share[32];
    fw_diag_error(pack->diags, 609, s->place,
                  "step %s (%s) goes on for %s %% longer than its layer takes, so that the layer "
                  "gets thicker than the flow says; write overrun=\"0\"",
                  s->id, s->op, fw_number_text(share, sizeof share, 100.0 * s->overrun, 3));
}

/* No bath deposits all that its current could: without an efficiency the metal comes out thinner than the flow says. */
static void lint_efficiency(fw_process_pack *pack, const fw_process_step *s) {
    if (!s->law || strcmp(s->law, "faraday") != 0 || !fw_process_step_is_op(s, "plate") ||
        fw_process_step_argument(s, "efficiency"))
        return;
    fw_diag_error(pack->diags, 627, s->place,
                  "step %s plates by its charge and takes all of it for metal; add the bath's "
                  "current efficiency: <arg name=\"efficiency\" q=\"...\"/>, unknown where nobody "
                  "knows it",
                  s->id);
}

/* ---- its times among themselves ---- */

/* a step whose time somebody states is not shorter than what is done in it */
static void lint_within(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const fw_quantity *time = fw_process_step_argument(s, "time");
    const fw_quantity *longest = NULL;
    double sum = 0.0;
    for (int k = 0; k < s->nsetting; k++) {
        const fw_quantity *q = s->setting[k].q;
        if (q->unknown ||
            !fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension)FW_DIM_TIME) ||
            q == time)
            continue;
        sum += q->value;
        if (!longest || q->value > longest->value) longest = q;
    }
    if (!law || !law->stated || !time || time->unknown || !longest ||
        !(sum > time->value * (1.0 + 1e-9)))
        return;
    char is[32], parts[32];
    fw_diag_error(pack->diags, 609, longest->replaced ? longest->place : s->place,
                  "step %s takes %s min (%s), but the times that are set in it are %s min together "
                  "('%s' is the longest); correct one of them",
                  s->id, fw_number_text(is, sizeof is, time->value / 60.0, 4), time->id,
                  fw_number_text(parts, sizeof parts, sum / 60.0, 4), longest->id);
}

/* nobody stands for hours beside what is over in minutes */
static void lint_attended(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const fw_quantity *time = fw_process_step_argument(s, "time");
    if (!law || !law->stated || !time || time->unknown || s->pulse ||
        !(s->attended_s > time->value * (1.0 + s->overrun) + 3600.0))
        return;
    char is[32], t[32];
    fw_diag_error(pack->diags, 609, s->place,
                  "somebody stands at step %s for %s min (attended), which takes %s min (%s): more "
                  "than an hour longer; correct one of them",
                  s->id, fw_number_text(is, sizeof is, s->attended_s / 60.0, 4),
                  fw_number_text(t, sizeof t, time->value / 60.0, 4), time->id);
}

fw_status fw_process_lint_inputs(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        for (size_t k = 0; k < sizeof own / sizeof *own; k++)
            lint_own(pack, i, own[k].argument, own[k].by_chance);
        lint_opening(pack, s);
        lint_area(pack, s);
        lint_overrun(pack, s);
        lint_efficiency(pack, s);
        lint_within(pack, s);
        lint_attended(pack, s);
    }
    return FW_OK;
}

/* ---- its tool ---- */

static bool treats(const fw_process_step *s) {
    return fw_words_hold("anodise bake coat deposit develop displace dry-etch expose "
                         "plate strip wet-etch",
                         " ", s->op);
}

/* What wafers are looked at with is no tool that treats them: a place at which more steps look than treat. An etcher in
   whose window somebody looks at the depth is none. */
static void lint_instrument(fw_process_pack *pack, int at) {
    const fw_process_step *s = &pack->flow->step[at], *looks = NULL;
    int looked = 0, treated = 0;
    if (!s->equipment || !treats(s)) return;
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *other = &pack->flow->step[i];
        if (other->equipment != s->equipment) continue;
        treated += treats(other);
        looked += fw_process_step_is_op(other, "inspect");
        if (!looks && fw_process_step_is_op(other, "inspect")) looks = other;
    }
    if (looked > treated)
        fw_diag_warning(pack->diags, 608, s->place,
                        "step %s (%s) is done at '%s' (%s), where steps as %s only look at wafers; "
                        "name the tool that does it",
                        s->id, s->op, s->equipment->id, s->equipment->class_, looks->id);
}

/* a pressure below half of that of a room is in a chamber that is pumped */
static void lint_pumped(fw_process_pack *pack, const fw_process_step *s) {
    const fw_quantity_dimension pressure = FW_DIM(-1, 1, -2, 0, 0, 0, 0);
    const double most_Pa = 5e4;
    for (int k = 0; k < s->nsetting && s->equipment && !s->equipment->vacuum; k++) {
        const fw_quantity *q = s->setting[k].q;
        if (q->unknown || q->value >= most_Pa ||
            !fw_quantity_dimension_equal(q->dimension, pressure))
            continue;
        fw_diag_error(pack->diags, 505, q->replaced ? q->place : s->place,
                      "step %s (%s) sets a low pressure ('%s'), but '%s' (%s) does not say "
                      "vacuum=\"yes\"; say it, or name the tool that is pumped",
                      s->id, s->op, q->id, s->equipment->id, s->equipment->class_);
    }
}

/* current comes to a wafer through a contact that somebody has put on it and looked at */
static void lint_contact(fw_process_pack *pack, int at) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[at];
    if (!fw_words_hold("anodise plate", " ", s->op)) return;
    for (int i = at - 1; i >= 0 && f->step[i].equipment == s->equipment; i--)
        if (fw_process_step_is_op(&f->step[i], "mount")) return;
    fw_diag_warning(pack->diags, 631, s->place,
                    "step %s (%s) lets a current through the wafer, and no step before it at '%s' "
                    "mounts the wafer there: its contact and the area that is open are looked at "
                    "by nobody; add a step with op=\"mount\"",
                    s->id, s->op, s->equipment ? s->equipment->id : "");
}

/* has a layer come on since a mask was exposed that spans what was etched through it, as a bonded wafer does? */
static const fw_process_change *hides(const fw_process_flow *f, int before, const char *mask) {
    bool exposed = false;
    for (int i = 0; i < before; i++) {
        exposed = exposed || strcmp(f->step[i].mask, mask) == 0;
        for (int k = 0; exposed && k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (strcmp(c->kind, "add") == 0 && c->spans && !c->back) return c;
        }
    }
    return NULL;
}

/* marks on the other face, or below a wafer that was bonded on, are seen from below or not at all */
static void lint_sees(fw_process_pack *pack, int at) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[at];
    const fw_process_change *over = s->align.to ? hides(f, at, s->align.to) : NULL;
    if (!s->align.to || !s->equipment || s->equipment->sees_back || (!s->align.back && !over))
        return;
    fw_diag_error(pack->diags, 626, s->align.place,
                  "step %s aligns to marks %s%s%s, but '%s' (%s) does not say that it sees them; "
                  "name an aligner with microscopes below the wafer or infrared light, and say "
                  "sees-back=\"yes\" of it",
                  s->id, s->align.back ? "of the other face" : "below '",
                  s->align.back ? "" : over->material, s->align.back ? "" : "'", s->equipment->id,
                  s->equipment->class_);
}

/* ---- its bath ---- */

/* m3 of one filling; NaN: not known */
static double filling_of(const fw_process_bath *b) {
    const fw_quantity *size = b->volume ? b->volume : b->one_part;
    double parts = 0.0;
    if (!size || size->unknown) return (double)NAN;
    if (b->volume) return size->value;
    for (int i = 0; i < b->npart; i++) {
        if (b->part[i].of->amount != FW_AMOUNT_L) continue;
        if (b->part[i].q->unknown) return (double)NAN;
        parts += b->part[i].q->value;
    }
    return parts * size->value;
}

/* A filling that serves fewer wafers than are in it at once, and one that does not cover a wafer: a millimetre of liquid is
   held by its own surface tension, less runs to one side. */
static void lint_filling(fw_process_pack *pack, const fw_process_step *s, const fw_process_use *u) {
    const double least_m = 1e-3;
    const fw_quantity *serves = u->bath->serves,
                      *wafer = fw_process_flow_quantity(pack->flow, "wafer.D"),
                      *size = u->bath->volume ? u->bath->volume : u->bath->one_part;
    const double V = filling_of(u->bath);
    char is[32], needs[32];
    if (serves && !serves->unknown && serves->value < (double)s->batch)
        fw_diag_error(pack->diags, 608, serves->replaced ? serves->place : s->place,
                      "step %s takes %d wafers at once into bath '%s', a filling of which serves "
                      "%s (%s); take fewer, or a larger filling",
                      s->id, s->batch, u->bath->id, fw_number_text(is, sizeof is, serves->value, 4),
                      serves->id);
    if (!wafer || wafer->unknown || !fw_process_step_in_liquid(s)) return;
    const double covers = least_m * 0.25 * FW_PI * wafer->value * wafer->value;
    if (V < covers)
        fw_diag_warning(pack->diags, 608, size->replaced ? size->place : s->place,
                        "step %s uses a filling of %s mL of bath '%s', which does not cover a "
                        "wafer of wafer.D: a millimetre over it are %s mL; correct the volume or "
                        "its unit",
                        s->id, fw_number_text(is, sizeof is, V * 1e6, 3), u->bath->id,
                        fw_number_text(needs, sizeof needs, covers * 1e6, 3));
}

fw_status fw_process_lint_places(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        lint_instrument(pack, i);
        lint_pumped(pack, s);
        lint_contact(pack, i);
        lint_sees(pack, i);
        for (int k = 0; k < s->nuse; k++)
            if (s->use[k].bath) lint_filling(pack, s, &s->use[k]);
    }
    return FW_OK;
}

/* ---- its plate ---- */

/* does another step print a part of the device's plate (0) or of another one through this mask? */
static bool prints(const fw_process_flow *f, const char *mask, int plate) {
    for (int i = 0; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            fw_process_side side;
            if (strcmp(c->kind, "pattern") == 0 && strcmp(f->step[i].mask, mask) == 0 &&
                fw_process_where_side(f, c->where, &side) && side.plate == plate)
                return true;
        }
    return false;
}

/* A plate prints the parts that it is there for, and the device's plate structure and field. A mask that is no plate of the
   pack at all is told where the plates of the table are (FW-D412, FW-D421). */
static void lint_printed(fw_process_pack *pack, const fw_process_step *s) {
    const fw_process_flow *f = pack->flow;
    for (int k = 0; k < s->nchange && s->mask[0]; k++) {
        const fw_process_change *c = &s->change[k];
        fw_process_side side;
        int named = -1;
        if (strcmp(c->kind, "pattern") != 0 || !fw_process_where_side(f, c->where, &side)) continue;
        for (int p = 0; p < f->nplate; p++)
            if (strcmp(f->plate[p].id, s->mask) == 0) named = p + 1;
        if (named < 0 && side.plate > 0 && prints(f, s->mask, 0)) named = 0;
        if (named < 0 || named == side.plate) continue;
        fw_diag_error(pack->diags, 559, c->place,
                      "step %s exposes the part '%s', which %s%s%s draws, through mask %s; name "
                      "the mask that draws it",
                      s->id, c->where, side.plate > 0 ? "plate '" : "the device's plate",
                      side.plate > 0 ? f->plate[side.plate - 1].id : "", side.plate > 0 ? "'" : "",
                      s->mask);
    }
}

static const fw_process_step *exposed_before(const fw_process_flow *f, int before,
                                             const char *mask) {
    for (int i = 0; i < before; i++)
        if (f->step[i].mask[0] && (!mask || strcmp(f->step[i].mask, mask) == 0)) return &f->step[i];
    return NULL;
}

static void aligned(fw_process_pack *pack, const fw_process_flow *f, int at) {
    const fw_process_step *s = &f->step[at], *first = exposed_before(f, at, NULL);
    if (!s->align.to) {
        if (s->mask[0] && first && strcmp(first->mask, s->mask) != 0)
            fw_diag_error(
                pack->diags, 373, s->place,
                "step %s exposes mask %s after %s did mask %s, and does not say how it is "
                "aligned; add <align to=\"%s\" overlay=\"...\"/>",
                s->id, s->mask, first->id, first->mask, first->mask);
        return;
    }
    if (!s->mask[0])
        fw_diag_error(pack->diags, 373, s->align.place,
                      "step %s exposes no mask, so that there is nothing to align", s->id);
    else if (!exposed_before(f, at, s->align.to))
        fw_diag_error(pack->diags, 373, s->align.place,
                      "step %s aligns mask %s to '%s', which no earlier step has exposed; name a "
                      "mask that is on the wafer by then",
                      s->id, s->mask, s->align.to);
    for (int k = 0; k < s->nchange; k++)
        if (strcmp(s->change[k].kind, "pattern") == 0 && s->change[k].back != s->align.back)
            fw_diag_error(pack->diags, 373, s->align.place,
                          "step %s exposes the %s (its <change>), and aligns a plate of the %s; "
                          "write the same side in both",
                          s->id, s->change[k].back ? "back" : "front",
                          s->align.back ? "back" : "front");
}

fw_status fw_process_lint_plates(fw_process_pack *pack) {
    for (int i = 0; i < pack->flow->nstep; i++)
        aligned(pack, pack->flow, i), lint_printed(pack, &pack->flow->step[i]);
    return FW_OK;
}

/* ---- how well masks lie on each other ---- */

fw_status fw_process_lint_overlay(fw_process_pack *pack) {
    const double best_m = 1e-8, worst_m = 2e-4; /* a stepper's; a mask laid on by eye */
    for (int i = 0; i < pack->flow->nstep; i++) {
        const fw_process_step *s = &pack->flow->step[i];
        const fw_quantity *q = s->align.to ? s->align.overlay : NULL;
        if (!q || q->unknown || (q->value >= best_m && q->value <= worst_m)) continue;
        fw_diag_error(pack->diags, 278, q->replaced ? q->place : s->align.place,
                      "step %s aligns its mask to %s um (%s), outside 0.01 to 200 um: no aligner "
                      "is exact, and what is laid on by eye lies within tenths of a millimetre",
                      s->id, fw_number_text((char[32]){0}, 32, 1e6 * q->value, 4), q->id);
    }
    return FW_OK;
}

/* ---- what it carries to another bench ---- */

/* What etches goes on etching on its way, and drips: it is rinsed off where it stands. Water and solvents may be carried,
   as they are to a dryer. A tool that takes nothing wet says so itself (FW-D335). */
fw_status fw_process_lint_carried(fw_process_pack *pack) {
    const fw_process_flow *f = pack->flow;
    fw_process_wafer *after;
    FW_TRY(fw_process_flow_wafers(pack->arena, f, &after));
    for (int i = 1; i < f->nstep; i++) {
        const fw_process_step *s = &f->step[i];
        const fw_process_wafer *before = &after[i - 1];
        if (!before->is[FW_STATE_WET] || !before->liquid || !fw_process_step_takes_wet(s)) continue;
        const fw_process_step *from = &f->step[before->since[FW_STATE_WET]];
        if (from->equipment == s->equipment || fw_process_only_dries(before->liquid)) continue;
        fw_diag_error(pack->diags, 606, s->place,
                      "step %s is at '%s', and the wafer comes there wet with '%s' from '%s' (step "
                      "%s): it goes on etching on the way, and drips; rinse it where it was: "
                      "<finish kind=\"rinse\"/> in step %s",
                      s->id, s->equipment ? s->equipment->id : "", before->liquid->id,
                      from->equipment ? from->equipment->id : "", from->id, from->id);
    }
    return FW_OK;
}

/* ---- the wafer that it wants ---- */

/* What changes nothing says what must be there for it, or nobody knows when it comes too early or too late. */
static void lint_looks(fw_process_pack *pack, const fw_process_step *s) {
    if (s->nchange > 0 || s->nrequired > 0 || !fw_words_hold("inspect dice package", " ", s->op))
        return;
    fw_diag_warning(pack->diags, 628, s->place,
                    "step %s (%s) changes nothing, and says nothing of the wafer that it wants: it "
                    "could be done before there is anything to see, or after; add <requires "
                    "material=\"...\"/> or <requires step=\"...\"/>",
                    s->id, s->op);
}

/* a chip is packaged when it is one */
static void lint_packaged(fw_process_pack *pack, int at) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *later = NULL;
    if (!fw_process_step_is_op(&f->step[at], "package") || fw_process_step_is_of_dies(f, at))
        return;
    for (int i = at + 1; i < f->nstep && !later; i++)
        if (f->step[i].parts) later = &f->step[i];
    if (later)
        fw_diag_error(pack->diags, 552, f->step[at].place,
                      "step %s packages chips, and the wafer is parted by step %s later; do it "
                      "after that",
                      f->step[at].id, later->id);
    else
        fw_diag_error(pack->diags, 633, f->step[at].place,
                      "step %s packages chips, and no step parts the wafer; saw or break it "
                      "before, in a step that says leaves=\"dies\"",
                      f->step[at].id);
}

/* a wafer is sawn while it is one, and what is sawn comes apart */
static void lint_sawn(fw_process_pack *pack, int at) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[at];
    if (!fw_process_step_is_op(s, "dice") || s->parts) return;
    if (fw_process_step_is_of_dies(f, at))
        fw_diag_error(pack->diags, 633, s->place,
                      "step %s saws a wafer that a step before it has parted into dies; do it "
                      "before that, or leave it out",
                      s->id);
    else if (!fw_process_step_is_of_dies(f, f->nstep))
        fw_diag_warning(pack->diags, 633, s->place,
                        "step %s saws the wafer, and no step leaves dies: say leaves=\"dies\" "
                        "where it goes all the way through, or break it in a step behind it",
                        s->id);
    for (int i = at + 1; i < f->nstep; i++)
        if (fw_process_step_is_op(&f->step[i], "coat")) {
            fw_diag_warning(
                pack->diags, 633, s->place,
                "step %s saws the wafer, and step %s spins over the cuts later: nothing "
                "covers them; saw behind the last coat",
                s->id, f->step[i].id);
            return;
        }
}

/* cooler than this a bake does not what it is for */
static void lint_cool(fw_process_pack *pack, int at, const fw_process_wafer *before) {
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[at];
    const bool soft = before->is[FW_STATE_UNBAKED],
               dries = !soft && at + 1 < f->nstep && fw_process_step_is_op(s + 1, "coat");
    const double least_K = FW_ICE_POINT_K + (soft ? 75.0 : 95.0);
    if (!fw_process_step_is_op(s, "bake") || (!soft && !dries)) return;
    for (int k = 0; k < s->nsetting; k++) {
        const fw_quantity *q = s->setting[k].q;
        char is[32], least[32];
        if (q->unknown || q->value >= least_K ||
            !fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension){.K = 1}))
            continue;
        fw_diag_warning(pack->diags, 593, q->replaced ? q->place : s->place,
                        "step %s bakes at %s Cel (%s), and %s below %s Cel; bake hotter", s->id,
                        fw_number_text(is, sizeof is, q->value - FW_ICE_POINT_K, 4), q->id,
                        soft ? "solvent stays in the resist" : "water stays on the wafer",
                        fw_number_text(least, sizeof least, least_K - FW_ICE_POINT_K, 4));
    }
}

static bool spanned_by(const fw_process_flow *f, int before, const char *material) {
    for (int i = 0; i < before; i++)
        for (int k = 0; k < f->step[i].nchange; k++)
            if (strcmp(f->step[i].change[k].material, material) == 0 && f->step[i].change[k].spans)
                return true;
    return false;
}

/* How deep the front goes below its highest place, m, above the last layer that spans what is below it; NaN: not known */
static fw_status relief(fw_process_pack *pack, int at, double *depth_m) {
    const fw_process_flow *f = pack->flow;
    fw_process_stack stack;
    double least = (double)INFINITY, most = 0.0;
    FW_TRY(fw_process_flow_stack(pack->arena, f, at - 1, &stack, NULL));
    for (int column = 0; column < stack.columns; column++) {
        double sum = 0.0;
        for (int i = stack.n[column] - 1; i >= 0; i--) {
            const fw_process_cell *c = &stack.cell[column][i];
            if (c->back) continue;
            sum += c->thickness_m;
            if (spanned_by(f, at, c->material)) break;
        }
        least = isnan(sum) ? sum : fmin(least, sum);
        most = isnan(sum) ? sum : fmax(most, sum);
        if (isnan(sum)) break;
    }
    *depth_m = most - least;
    return FW_OK;
}

/* is the coat exposed before it is taken off as a whole? */
static bool printed(const fw_process_flow *f, int from, const fw_process_change *coat) {
    for (int i = from; i < f->nstep; i++)
        for (int k = 0; k < f->step[i].nchange; k++) {
            const fw_process_change *c = &f->step[i].change[k];
            if (strcmp(c->material, coat->material) != 0 || c->back != coat->back) continue;
            if (strcmp(c->kind, "pattern") == 0) return true;
            if (strcmp(c->kind, "remove") == 0) return false;
        }
    return false;
}

/* Resist runs off edges that are higher than twice its own thickness: streaks behind them, none upon them, and the dose is
   none for what stands in the hollows. Test: test_lint.c, flows_of_wrong_steps. */
static fw_status lint_covers(fw_process_pack *pack, int at) {
    const double most = 2.0;
    const fw_process_flow *f = pack->flow;
    const fw_process_step *s = &f->step[at];
    for (int k = 0; k < s->nchange && fw_process_step_is_op(s, "coat"); k++) {
        const fw_process_change *c = &s->change[k];
        double deep_m;
        char is[32], deep[32];
        if (strcmp(c->kind, "add") != 0 || c->back || !c->thickness || c->thickness->unknown ||
            !printed(f, at + 1, c))
            continue;
        FW_TRY(relief(pack, at, &deep_m));
        if (!(deep_m > most * c->thickness->value)) continue;
        fw_diag_warning(
            pack->diags, 588, c->place,
            "step %s spins %s um of '%s' over edges of %s um and prints it: it runs off "
            "them, and streaks behind; print before they are etched, spray, or take "
            "half as much at least",
            s->id, fw_number_text(is, sizeof is, 1e6 * c->thickness->value, 4), c->material,
            fw_number_text(deep, sizeof deep, 1e6 * deep_m, 4));
    }
    return FW_OK;
}

fw_status fw_process_lint_wanted(fw_process_pack *pack) {
    fw_process_wafer now = {0};
    for (int i = 0; i < pack->flow->nstep; i++) {
        lint_looks(pack, &pack->flow->step[i]);
        lint_packaged(pack, i);
        lint_sawn(pack, i);
        lint_cool(pack, i, &now);
        FW_TRY(lint_covers(pack, i));
        fw_process_wafer_pass(pack->flow, i, &now);
    }
    return FW_OK;
}
