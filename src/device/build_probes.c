/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <probe> and <require>: what the device is for. */
#include "device/device_reader.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- what carries a force ---- */

static bool tendon_in(const fw_device_scene *s, const char *id) {
    for (int i = 0; i < s->ntendon; i++)
        if (fw_text_same(s->tendon[i].id, id)) return true;
    return false;
}

static bool comb_in(const fw_device_scene *s, const char *id) {
    for (int i = 0; i < s->ncomb; i++)
        if (fw_text_same(s->comb[i].id, id)) return true;
    return false;
}

static bool contact_in(const fw_device_scene *s, const char *id) {
    for (int i = 0; i < s->ncontact; i++)
        if (fw_text_same(s->contact[i].id, id)) return true;
    return false;
}

bool fw_device_probe_in_scene(const fw_device_probe *p, const fw_device_scene *s) {
    if (!p->of) return true;
    switch (p->carrier) {
    case FW_CARRIER_TENDON:
        return tendon_in(s, p->of);
    case FW_CARRIER_COMB:
        return comb_in(s, p->of);
    case FW_CARRIER_CONTACT:
        return contact_in(s, p->of);
    case FW_CARRIER_REVOLUTE:
    case FW_CARRIER_JOINT:
    case FW_CARRIER_DRIVER:
    case FW_CARRIER_SPRING:
        break;
    }
    return true;
}

/* the first thing of that id: joints, drivers and springs of the mechanism, then what scenes have */
static bool find_carrier(const fw_device *d, fw_device_probe *p) {
    const struct {
        fw_device_carrier carrier;
        int count;
    } own[] = {{FW_CARRIER_REVOLUTE, d->nrevolute},
               {FW_CARRIER_JOINT, d->njoint},
               {FW_CARRIER_SPRING, d->nspring},
               {FW_CARRIER_DRIVER, d->ndriver}};
    const bool drives = p->row == FW_PROBE_IS_power; /* a driver may have the name of its joint */
    for (size_t k = 0; k < sizeof own / sizeof own[0]; k++)
        for (int i = 0; i < own[k].count; i++) {
            const char *id = own[k].carrier == FW_CARRIER_REVOLUTE ? d->revolute[i].id
                             : own[k].carrier == FW_CARRIER_JOINT  ? d->joint[i].id
                             : own[k].carrier == FW_CARRIER_SPRING ? d->spring[i].id
                                                                   : d->driver[i].id;
            if (!id || !fw_text_same(id, p->of)) continue;
            if (drives && own[k].carrier != FW_CARRIER_DRIVER) continue;
            p->carrier = own[k].carrier, p->index = i;
            return true;
        }
    static const fw_device_carrier of_scenes[] = {FW_CARRIER_TENDON, FW_CARRIER_COMB,
                                                  FW_CARRIER_CONTACT};
    for (size_t k = 0; k < sizeof of_scenes / sizeof of_scenes[0]; k++) {
        p->carrier = of_scenes[k];
        for (int i = 0; i < d->nscene; i++)
            if (fw_device_probe_in_scene(p, &d->scene[i])) return true;
    }
    return false;
}

/* why a thing of that kind has no such quantity, or NULL */
static const char *has_none(const fw_device *d, const fw_device_probe *p) {
    const bool driver = p->carrier == FW_CARRIER_DRIVER;
    const bool of_joint = p->carrier == FW_CARRIER_JOINT;
    switch (p->row) {
    case FW_PROBE_IS_angle:
        return p->carrier == FW_CARRIER_REVOLUTE ? NULL : "only a revolute joint has an angle";
    case FW_PROBE_IS_force:
        return driver && d->driver[p->index].revolute != FW_NONE
                   ? "a driver of a revolute has a torque; write kind=\"torque\""
                   : NULL;
    case FW_PROBE_IS_torque:
        if (p->carrier == FW_CARRIER_REVOLUTE) return NULL;
        if (of_joint && d->joint[p->index].kind != FW_JOINT_DISTANCE) return NULL;
        if (driver && d->driver[p->index].revolute != FW_NONE) return NULL;
        return "it exerts a force and no torque; write kind=\"force\"";
    case FW_PROBE_IS_power:
        return driver || p->carrier == FW_CARRIER_TENDON || p->carrier == FW_CARRIER_COMB
                   ? NULL
                   : "only drivers, tendons and comb drives feed power in";
    case FW_PROBE_IS_capacitance:
        return p->carrier == FW_CARRIER_COMB ? NULL : "only a comb drive has electrodes";
    case FW_PROBE_IS_displacement:
    case FW_PROBE_IS_velocity:
    case FW_PROBE_IS_distance:
    case FW_PROBE_IS_opening:
    case FW_PROBE_IS_gap:
    case FW_PROBE_IS_stiffness:
    case FW_PROBE_IS_compliance:
    case FW_PROBE_IS_frequency:
    case FW_PROBE_KINDS:
        break;
    }
    return NULL;
}

/* "driver 'D'", each id once; those without an id cannot be named */
static void add_actuator(fw_text *out, const char *kind, const char *id) {
    char one[96];
    if (!id) return;
    snprintf(one, sizeof one, "%s '%.64s'", kind, id);
    if (out->data && strstr(out->data, one)) return;
    fw_text_printf(out, "%s%s", out->length ? ", " : "", one);
}

/* what feeds power in */
static void add_actuators(const fw_device *d, fw_text *out) {
    for (int i = 0; i < d->ndriver; i++)
        add_actuator(out, "driver", d->driver[i].id);
    for (int k = 0; k < d->nscene; k++) {
        const fw_device_scene *s = &d->scene[k];
        for (int i = 0; i < s->ntendon; i++)
            add_actuator(out, "tendon", s->tendon[i].id);
        for (int i = 0; i < s->ncomb; i++)
            add_actuator(out, "comb drive", s->comb[i].id);
    }
}

static void refuse_power(fw_device_reader *r, const fw_xml_record *record, const char *of) {
    char label[FW_LABEL];
    fw_text names = fw_text_new(r->diags->arena);
    add_actuators(r->device, &names);
    const bool any = names.length > 0;
    if (fw_text_end(&names) != FW_OK) {
        r->diags->failed = true;
        return;
    }
    fw_diag_error(
        r->diags, 321, fw_xml_place_of(record, "of"),
        "%s: power is what a driver, tendon or comb drive feeds in, and '%.64s' is none; %s%s",
        fw_xml_label(record, label), of,
        any ? "name one of those there are: " : "none here has an id", any ? names.data : "");
}

static void read_carrier(fw_device_reader *r, const fw_xml_record *record, fw_device_probe *p) {
    char label[FW_LABEL];
    if (!p->of) return;
    if (!find_carrier(r->device, p)) {
        if (r->xml.broken[FW_SPACE_JOINT] || r->xml.unknown_element) return;
        if (p->row == FW_PROBE_IS_power)
            refuse_power(r, record, p->of);
        else
            fw_diag_error(r->diags, 321, fw_xml_place_of(record, "of"),
                          "%s: nothing with the id '%.64s' carries a force; name a joint, driver, "
                          "spring, tendon, comb drive or contact that has an id",
                          fw_xml_label(record, label), p->of);
        return;
    }
    const char *why = has_none(r->device, p);
    if (why && p->row == FW_PROBE_IS_power)
        refuse_power(r, record, p->of);
    else if (why)
        fw_diag_error(r->diags, 321, fw_xml_place_of(record, "of"), "%s: '%.64s' has no %s: %s",
                      fw_xml_label(record, label), p->of, fw_device_probe_kinds[p->row].name, why);
}

/* ---- attributes by kind ---- */

static const char *const of_point[] = {"on", "x", "y"};
static const char *const of_pair[] = {"a", "a-x", "a-y", "b", "b-x", "b-y"};
static const char *const of_points[] = {"a-x", "a-y", "b-x", "b-y"};
static const char *const of_carrier[] = {"of"};
static const char *const of_mode[] = {"mode", "plane"};
static const char *const of_direction[] = {"direction"};

static void refuse(fw_device_reader *r, const fw_xml_record *record, const char *const *names,
                   int n, const fw_device_probe_kind *kind) {
    char why[160];
    snprintf(why, sizeof why, "has no meaning for kind=\"%s\"; remove it", kind->name);
    fw_device_refused(r, record, 320, names, n, why);
}

static void check_attributes(fw_device_reader *r, const fw_xml_record *record,
                             const fw_device_probe *p) {
    static const char *const ends[] = {"a", "b"};
    const fw_device_probe_kind *kind = &fw_device_probe_kinds[p->row];
    const fw_device_probe_takes takes = kind->takes;
    const bool point = takes == FW_PROBE_POINT || takes == FW_PROBE_TANGENT;
    const bool body = takes == FW_PROBE_BODY, carrier = takes == FW_PROBE_CARRIER;
    if (point) fw_device_needed(r, record, 320, of_point, 1, "the body that carries the point");
    if (!point && !body) refuse(r, record, of_point, 3, kind);
    if (body) refuse(r, record, of_point + 1, 2, kind);
    const bool outlines = takes == FW_PROBE_OUTLINES, pair = takes == FW_PROBE_PAIR || outlines;
    for (int i = 0; i < 2 && pair; i++)
        fw_device_needed(r, record, 320, ends + i, 1, "a body, or ground");
    if (!pair) refuse(r, record, of_pair, 6, kind);
    if (outlines) refuse(r, record, of_points, 4, kind);
    if (carrier) fw_device_needed(r, record, 320, of_carrier, 1, "the id of what carries it");
    if (!carrier && !body) refuse(r, record, of_carrier, 1, kind);
    if (takes != FW_PROBE_MODE) refuse(r, record, of_mode, 2, kind);
    if (takes == FW_PROBE_TANGENT)
        fw_device_needed(r, record, 320, of_direction, 1, "along which the point is pushed");
    bool directed = point || p->row == FW_PROBE_IS_opening || p->row == FW_PROBE_IS_force;
    if (!directed) refuse(r, record, of_direction, 1, kind);
    if (body && fw_xml_given(record, "on") == fw_xml_given(record, "of")) {
        char label[FW_LABEL];
        fw_diag_error(r->diags, 320, record->element->place,
                      "%s needs exactly one of on=\"BODY\" and of=\"JOINT\"",
                      fw_xml_label(record, label));
    }
}

/* an opening without a direction goes along the line between its points as drawn */
static void check_opening(fw_device_reader *r, const fw_xml_record *record, fw_device_probe *p) {
    const fw_device *d = r->device;
    double at[2][2] = {{p->x_m, p->y_m}, {p->bx_m, p->by_m}}, turn = 0;
    const int body[2] = {p->body, p->body_b};
    if (p->row != FW_PROBE_IS_opening || !isnan(p->direction_rad)) return;
    if (body[0] == FW_NOWHERE || body[1] == FW_NOWHERE) return;
    for (int i = 0; i < 2; i++) {
        if (body[i] < 0) continue;
        const fw_device_body *b = &d->body[body[i]];
        double c = cos(b->phi_rad), s = sin(b->phi_rad), x = at[i][0], y = at[i][1];
        at[i][0] = b->x_m + c * x - s * y;
        at[i][1] = b->y_m + s * x + c * y;
        if (i == 0) turn = b->phi_rad;
    }
    double dx = at[1][0] - at[0][0], dy = at[1][1] - at[0][1];
    if (hypot(dx, dy) > 0) {
        p->direction_rad = atan2(dy, dx) - turn;
        return;
    }
    char label[FW_LABEL];
    fw_diag_error(
        r->diags, 320, record->element->place,
        "%s: its two points coincide as drawn, or the pose of a body comes from its shape, "
        "so that it has no direction of its own; give direction=\"...\"",
        fw_xml_label(record, label));
}

static fw_device_probe_row row_of(const char *kind) {
    for (int i = 0; i < FW_PROBE_KINDS; i++)
        if (fw_text_same(kind, fw_device_probe_kinds[i].name)) return (fw_device_probe_row)i;
    return FW_PROBE_KINDS;
}

/* two points or two outlines */
static void read_pair(fw_device_reader *r, const fw_xml_record *record, fw_device_probe *p) {
    const bool outlines = fw_device_probe_kinds[p->row].takes == FW_PROBE_OUTLINES;
    p->body = fw_device_reference(r, record, "a");
    p->body_b = fw_device_reference(r, record, "b");
    p->x_m = fw_xml_number_or(record, "a-x", 0.0), p->y_m = fw_xml_number_or(record, "a-y", 0.0);
    p->bx_m = fw_xml_number_or(record, "b-x", 0.0);
    p->by_m = fw_xml_number_or(record, "b-y", 0.0);
    if (p->body == p->body_b && p->body != FW_NOWHERE && fw_xml_given(record, "b"))
        fw_diag_error(r->diags, 320, fw_xml_place_of(record, "b"),
                      "probe '%s': both %s the same body, and never move against each other; name "
                      "another body, or ground",
                      p->id ? p->id : "", outlines ? "outlines are of" : "points are on");
}

const char *fw_device_plane_text(fw_device_plane plane) {
    static const char *const text[] = {"either", "in", "across"};
    return text[plane];
}

static fw_device_plane plane_of(const char *word) {
    for (int k = FW_PLANE_EITHER; word && k <= FW_PLANE_ACROSS; k++)
        if (strcmp(word, fw_device_plane_text((fw_device_plane)k)) == 0) return (fw_device_plane)k;
    return FW_PLANE_EITHER;
}

static void build_probe(fw_device_reader *r, const fw_xml_record *record) {
    const fw_device_probe_row row = row_of(fw_xml_text_of(record, "kind"));
    fw_device *d = r->device;
    fw_device_probe p = {.id = fw_xml_text_of(record, "id"),
                         .row = row,
                         .direction_rad = fw_xml_number_of(record, "direction"),
                         .of = fw_xml_text_of(record, "of"),
                         .mode = 1,
                         .place = record->element->place};
    if (row == FW_PROBE_KINDS) return; /* reported */
    check_attributes(r, record, &p);
    const fw_device_probe_takes takes = fw_device_probe_kinds[row].takes;
    if (takes == FW_PROBE_PAIR || takes == FW_PROBE_OUTLINES) {
        read_pair(r, record, &p);
    } else {
        p.body = fw_device_reference(r, record, "on");
        p.x_m = fw_xml_number_or(record, "x", 0.0), p.y_m = fw_xml_number_or(record, "y", 0.0);
        p.body_b = FW_GROUND;
    }
    p.plane = plane_of(fw_xml_text_of(record, "plane"));
    p.mode = fw_xml_whole_or(record, "mode", p.mode);
    read_carrier(r, record, &p);
    check_opening(r, record, &p);
    d->probe[d->nprobe++] = p;
}

/* ---- requirements ---- */

/* a bound, in the dimension of what is judged */
static fw_status read_bound(fw_device_reader *r, const fw_xml_record *record, const char *name,
                            const fw_quantity_dimension *wanted, double *value) {
    const fw_xml_cell *cell = fw_xml_cell_of(record, name);
    fw_quantity_dimension found;
    bool ok = false;
    *value = (double)NAN;
    if (!cell->given) return FW_OK;
    FW_TRY(fw_xml_attribute_evaluate(&r->xml, cell->given, name, wanted, &found, value, &ok));
    if (!ok) *value = (double)NAN;
    return FW_OK;
}

/* which probe: of the file, or one made for the frequency of a mode */
static int judged(fw_device_reader *r, const fw_xml_record *record, int *mode) {
    char label[FW_LABEL];
    bool probe = fw_xml_given(record, "probe"), frequency = fw_xml_given(record, "frequency");
    *mode = 0;
    if (probe == frequency) {
        fw_diag_error(r->diags, 322, record->element->place,
                      "%s needs %s probe=\"ID\", and frequency=\"MODE\": what is judged",
                      fw_xml_label(record, label), probe ? "only one of" : "one of");
        return FW_NOWHERE;
    }
    if (probe) return fw_device_reference(r, record, "probe");
    double n = fw_xml_number_of(record, "frequency");
    if (!isfinite(n)) return FW_NOWHERE;
    *mode = (int)n;
    return FW_NONE;
}

static fw_device_measure measure_of(const char *word) {
    for (int k = FW_MEASURE_PEAK; word && k <= FW_MEASURE_PARASITIC; k++)
        if (strcmp(word, fw_device_measure_text((fw_device_measure)k)) == 0)
            return (fw_device_measure)k;
    return FW_MEASURE_PEAK;
}

static void check_measure(fw_device_reader *r, const fw_xml_record *record,
                          const fw_device_probe *p, fw_device_measure measure) {
    static const char *const word[] = {"measure"}, *const band[] = {"band"};
    const fw_device_probe_kind *kind = &fw_device_probe_kinds[p->row];
    char label[FW_LABEL];
    fw_xml_label(record, label);
    if (!fw_device_probe_moves(kind))
        fw_device_refused(r, record, 322, word, 1,
                          "is of a course in time, and stiffness, compliance and frequency have "
                          "none; remove it");
    if (measure == FW_MEASURE_SETTLING)
        fw_device_needed(r, record, 322, band, 1,
                         "how far from where it comes to rest the probe still counts as settled");
    else
        fw_device_refused(r, record, 322, band, 1,
                          "belongs to measure=\"settling-time\"; remove it");
    if (measure == FW_MEASURE_PARASITIC &&
        (p->row != FW_PROBE_IS_displacement || isnan(p->direction_rad)))
        fw_diag_error(
            r->diags, 322, fw_xml_place_of(record, "measure"),
            "%s: parasitic motion is what a displacement does across its direction; name a "
            "probe of kind=\"displacement\" that has a direction",
            label);
}

static void check_bounds(fw_device_reader *r, const fw_xml_record *record,
                         const fw_device_requirement *q) {
    char label[FW_LABEL];
    fw_xml_label(record, label);
    if (!fw_xml_given(record, "min") && !fw_xml_given(record, "max"))
        fw_diag_error(r->diags, 322, record->element->place,
                      "%s asks for nothing; give min=\"...\", max=\"...\" or both", label);
    else if (q->min > q->max)
        fw_diag_error(r->diags, 322, fw_xml_place_of(record, "min"),
                      "%s: min is above max; exchange them", label);
    if (q->band <= 0)
        fw_diag_error(r->diags, 322, fw_xml_place_of(record, "band"),
                      "%s: a band must be above 0: nothing comes to rest exactly", label);
}

static void check_scene(fw_device_reader *r, const fw_xml_record *record, const fw_device_probe *p,
                        int scene) {
    char label[FW_LABEL];
    if (scene < 0 || !p->of || fw_device_probe_in_scene(p, &r->device->scene[scene])) return;
    fw_diag_error(r->diags, 321, fw_xml_place_of(record, "scene"),
                  "%s: probe '%s' is of '%.64s', and scene '%s' has none of that id; name a scene "
                  "that has it, or leave scene out",
                  fw_xml_label(record, label), p->id, p->of, r->device->scene[scene].name);
}

static fw_status build_requirement(fw_device_reader *r, const fw_xml_record *record) {
    static const fw_quantity_dimension time = {.s = 1};
    fw_device *d = r->device;
    int mode, probe = judged(r, record, &mode), scene = fw_device_reference(r, record, "scene");
    if (probe == FW_NOWHERE) return FW_OK;
    static const char *const plane[] = {"plane"};
    if (probe != FW_NONE)
        fw_device_refused(r, record, 322, plane, 1,
                          "goes with frequency=\"MODE\"; of a probe it is said there; remove it");
    if (probe == FW_NONE) {
        probe = d->nprobe++;
        d->probe[probe] = (fw_device_probe){.row = FW_PROBE_IS_frequency,
                                            .body = FW_GROUND,
                                            .body_b = FW_GROUND,
                                            .direction_rad = (double)NAN,
                                            .mode = mode,
                                            .plane = plane_of(fw_xml_text_of(record, "plane")),
                                            .implied = true,
                                            .place = record->element->place};
        FW_NEED(d->probe[probe].id = fw_arena_printf(r->arena, "frequency-%d", mode));
    }
    const fw_device_probe *p = &d->probe[probe];
    const fw_quantity_dimension *own = &fw_device_probe_kinds[p->row].dimension;
    fw_device_requirement q = {.probe = probe,
                               .scene = scene,
                               .measure = measure_of(fw_xml_text_of(record, "measure")),
                               .place = record->element->place};
    const fw_quantity_dimension *of = q.measure == FW_MEASURE_SETTLING ? &time : own;
    FW_TRY(read_bound(r, record, "min", of, &q.min));
    FW_TRY(read_bound(r, record, "max", of, &q.max));
    FW_TRY(read_bound(r, record, "band", own, &q.band));
    check_measure(r, record, p, q.measure);
    check_bounds(r, record, &q);
    check_scene(r, record, p, scene);
    d->requirement[d->nrequirement++] = q;
    return FW_OK;
}

fw_status fw_device_build_probes(fw_device_reader *r) {
    fw_device *d = r->device;
    size_t probes = (size_t)fw_xml_count(&r->xml, "probe"),
           requirements = (size_t)fw_xml_count(&r->xml, "require");
    if (probes + requirements == 0) return FW_OK;
    FW_NEED(d->probe = fw_arena_array(r->arena, fw_device_probe, probes + requirements));
    FW_NEED(d->requirement = fw_arena_array(r->arena, fw_device_requirement, requirements));
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "probe")) build_probe(r, &r->xml.record[i]);
    for (int i = 0; i < r->xml.nrecord; i++)
        if (fw_xml_is(&r->xml.record[i], "require"))
            FW_TRY(build_requirement(r, &r->xml.record[i]));
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
