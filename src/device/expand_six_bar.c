/* SPDX-License-Identifier: GPL-3.0-or-later */
/* <six-bar>: bodies AB BC CD DE EF and joints A..F of the general planar mechanism. */
#include "device/device_reader.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BODIES = 5, JOINTS = 6, PLATFORM = 2 };
static const char *const body_id[BODIES] = {"AB", "BC", "CD", "DE", "EF"};
static const char *const joint_id[JOINTS] = {"A", "B", "C", "D", "E", "F"};

typedef struct parts {
    const fw_xml_record *body[BODIES], *joint[JOINTS]; /* NULL: missing */
} parts;

static int index_of(const char *id, const char *const *ids, int n) {
    for (int i = 0; id && i < n; i++)
        if (strcmp(ids[i], id) == 0) return i;
    return -1;
}

static void gather(const fw_device_reader *r, parts *p) {
    for (int i = 0; i < r->xml.nrecord; i++) {
        const fw_xml_record *record = &r->xml.record[i];
        int k;
        if (fw_xml_is(record, "hinge") &&
            (k = index_of(fw_xml_text_of(record, "at"), joint_id, JOINTS)) >= 0 && !p->joint[k])
            p->joint[k] = record;
        else if ((fw_xml_is(record, "link") || fw_xml_is(record, "platform")) &&
                 (k = index_of(fw_xml_text_of(record, "id"), body_id, BODIES)) >= 0 && !p->body[k])
            p->body[k] = record;
    }
}

static void report_missing(fw_device_reader *r, const parts *p, fw_place place) {
    char list[200] = "";
    size_t used = 0;
    for (int i = 0; i < JOINTS && !r->xml.broken[FW_SPACE_JOINT]; i++)
        if (!p->joint[i])
            used += (size_t)snprintf(list + used, sizeof list - used, " <hinge at=\"%s\">",
                                     joint_id[i]);
    for (int i = 0; i < BODIES && !r->xml.broken[FW_SPACE_BODY]; i++)
        if (!p->body[i])
            used += (size_t)snprintf(list + used, sizeof list - used, " <%s id=\"%s\">",
                                     i == PLATFORM ? "platform" : "link", body_id[i]);
    if (used > 0)
        fw_diag_error(r->diags, 52, place,
                      "<six-bar> is not complete; add%s (it has six hinges, four links and a "
                      "platform)",
                      list);
}

static fw_device_revolute joint_of(fw_device_reader *r, const parts *p, int i) {
    fw_device_revolute j = {.id = joint_id[i],
                            .body_a = i - 1, /* ground is -1 */
                            .body_b = i < BODIES ? i : FW_GROUND,
                            .ax_m = (double)NAN,
                            .ay_m = (double)NAN,
                            .bx_m = (double)NAN,
                            .by_m = (double)NAN,
                            .flexure = FW_NONE,
                            .stop_min_rad = (double)NAN,
                            .stop_max_rad = (double)NAN,
                            .stop_stiffness_Nm_per_rad = (double)NAN,
                            .stop_damping_Nms_per_rad = (double)NAN};
    const fw_xml_record *record = p->joint[i];
    if (!record) return j;
    j.x_m = fw_xml_number_of(record, "x");
    j.y_m = fw_xml_number_of(record, "y");
    j.stiffness_Nm_per_rad = fw_xml_number_of(record, "stiffness");
    j.damping_Nms_per_rad = fw_xml_number_of(record, "damping");
    j.free_angle_rad = fw_xml_number_or(record, "free-angle", 0.0);
    j.axis_rad = fw_xml_number_of(record, "axis");
    j.flexure = fw_device_reference(r, record, "flexure");
    j.place = record->element->place;
    return j;
}

static void check_hinge_points(fw_device_reader *r, const parts *p) {
    const fw_device_revolute *joint = r->device->revolute;
    for (int i = 0; i < BODIES; i++) {
        double d = hypot(joint[i + 1].x_m - joint[i].x_m, joint[i + 1].y_m - joint[i].y_m);
        if (p->joint[i] && p->joint[i + 1] && d < 1e-9)
            fw_diag_error(r->diags, 60, fw_xml_place_of(p->joint[i + 1], "x"),
                          "hinges %s and %s of %s '%s' lie on the same point; move one",
                          joint_id[i], joint_id[i + 1], i == PLATFORM ? "platform" : "link",
                          body_id[i]);
    }
}

static void check_link(fw_device_reader *r, const fw_xml_record *record) {
    static const char *const centre[] = {"x", "y"};
    fw_device_mass_check(r, record, fw_xml_given(record, "width"), "width");
    for (int k = 0; k < 2; k++)
        if (fw_xml_given(record, centre[k]) && !fw_xml_given(record, "mass")) {
            char label[FW_LABEL];
            fw_diag_error(r->diags, 64, fw_xml_place_of(record, centre[k]),
                          "%s: %s places the centre of a mass that is not given; add mass and "
                          "inertia, or remove it",
                          fw_xml_label(record, label), centre[k]);
        }
}

static fw_device_body body_of(fw_device_reader *r, const parts *p, int i) {
    double none = (double)NAN;
    fw_device_body b = {.id = body_id[i],
                        .mass_kg = none,
                        .inertia_kg_m2 = none,
                        .x_m = none,
                        .y_m = none,
                        .width_m = none,
                        .plate_width_m = none,
                        .plate_height_m = none,
                        .plate_x_m = none,
                        .plate_y_m = none,
                        .platform = i == PLATFORM};
    const fw_xml_record *record = p->body[i];
    if (!record) return b;
    const fw_device_revolute *first = &r->device->revolute[i], *second = first + 1;
    bool heavy = fw_xml_given(record, "mass");
    b.mass_kg = fw_xml_number_of(record, "mass");
    b.inertia_kg_m2 = fw_xml_number_of(record, "inertia");
    b.place = record->element->place;
    if (i != PLATFORM) {
        b.width_m = fw_xml_number_of(record, "width");
        b.width_place = fw_xml_place_of(record, "width");
        b.x_m = fw_xml_number_or(record, "x", heavy ? (first->x_m + second->x_m) / 2 : none);
        b.y_m = fw_xml_number_or(record, "y", heavy ? (first->y_m + second->y_m) / 2 : none);
        check_link(r, record);
        return b;
    }
    b.plate_width_m = fw_xml_number_of(record, "width");
    b.plate_height_m = fw_xml_number_of(record, "height");
    b.plate_x_m = fw_xml_number_of(record, "x");
    b.plate_y_m = fw_xml_number_of(record, "y");
    b.plate_angle_rad = fw_xml_number_or(record, "angle", 0.0);
    b.x_m = heavy ? b.plate_x_m : none;
    b.y_m = heavy ? b.plate_y_m : none;
    fw_device_mass_check(r, record, fw_xml_given(record, "width") && fw_xml_given(record, "height"),
                         "width and height");
    return b;
}

fw_status fw_device_expand_six_bar(fw_device_reader *r) {
    fw_device *d = r->device;
    const fw_xml_record *six_bar = NULL;
    for (int i = 0; i < r->xml.nrecord && !six_bar; i++)
        if (fw_xml_is(&r->xml.record[i], "six-bar")) six_bar = &r->xml.record[i];
    size_t bodies = (size_t)fw_xml_count(&r->xml, "body") + BODIES,
           joints = (size_t)fw_xml_count(&r->xml, "revolute");
    FW_NEED(d->body = fw_arena_array(r->arena, fw_device_body, bodies));
    FW_NEED(d->revolute = fw_arena_array(r->arena, fw_device_revolute, joints + JOINTS));
    if (!six_bar) return FW_OK;
    parts p = {0};
    gather(r, &p);
    report_missing(r, &p, six_bar->element->place);
    d->six_bar = true;
    for (int i = 0; i < JOINTS; i++)
        d->revolute[d->nrevolute++] = joint_of(r, &p, i);
    check_hinge_points(r, &p);
    for (int i = 0; i < BODIES; i++)
        d->body[d->nbody++] = body_of(r, &p, i);
    return r->diags->failed ? FW_NOMEM : FW_OK;
}
