/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table: <scene> with its loads. */
#include "device/table_rows.h"

static const fw_xml_attribute_row scene_rows[] = {
    {"name", ID, REQUIRED, .sentence = "Name of the scene."},
    {"duration", D_TIME, REQUIRED,
     RANGE(1e-12, 1e9,
           "nothing that this model holds for moves within 1 ps, and no motion takes longer than "
           "1e9 s, thirty years"),
     .sentence = "How long the motion is followed."},
    {"flow", REF(FW_SPACE_FLOW), .fallback = "all flows", .sentence = "Only in this flow."},
};
static const fw_xml_attribute_row force_rows[] = {
    {"on", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that it pulls."},
    {"x", PLACE, .fallback = "0 mm",
     .sentence = "Point in the body's frame, from its centre of mass."},
    {"y", PLACE, .fallback = "0 mm",
     .sentence = "Point in the body's frame, from its centre of mass."},
    {"fx", D_FORCE, .fallback = "0 uN", .sentence = "Along the world's x axis."},
    {"fy", D_FORCE, .fallback = "0 uN", .sentence = "Along the world's y axis."},
};
static const fw_xml_attribute_row torque_rows[] = {
    {"on", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that it turns."},
    {"value", D_TORQUE, REQUIRED, .sentence = "Positive counter-clockwise, from x to y."},
};
static const fw_xml_attribute_row gravity_rows[] = {
    {"gx", D_GRAVITY, .fallback = "0 m/s^2", .sentence = "Along the world's x axis."},
    {"gy", D_GRAVITY, .fallback = "0 m/s^2",
     .sentence = "Along the world's y axis; -9.81 m/s^2 where y points up."},
};
static const fw_xml_attribute_row initial_rows[] = {
    {"body", REF(FW_SPACE_BODY), REQUIRED, .sentence = "Body that moves at the start."},
    {"vx", D_SPEED, .fallback = "0 mm/s", .sentence = "Velocity of the centre of mass."},
    {"vy", D_SPEED, .fallback = "0 mm/s", .sentence = "Velocity of the centre of mass."},
    {"omega", D_SPIN, .fallback = "0 rad/s", .sentence = "Angular velocity."},
};

const fw_xml_element_row fw_device_table_scene[] = {
    {"scene", "device", "name", FW_SPACE_SCENE, .most = 200, ROWS(scene_rows),
     .sentence = "What acts on the mechanism, and for how long; the verdict holds for all scenes."},
    {"force", "scene", .timed = true, ROWS(force_rows),
     .sentence = "A force on a point of a body; the point moves with it, the direction stays."},
    {"torque", "scene", .timed = true, ROWS(torque_rows), .sentence = "A torque on a body."},
    {"gravity", "scene", .once = true, ROWS(gravity_rows), .sentence = "Weight of all bodies."},
    {"initial", "scene", ROWS(initial_rows),
     .sentence = "Velocity of a body at the start. What is not given, of this body or of others, "
                 "follows through the joints; what they do not allow is corrected, as little as "
                 "possible."},
    {0},
};
