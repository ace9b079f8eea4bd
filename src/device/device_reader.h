/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the records of a device file (xml/xml_reader.h) to its description. Private to device/. */
#ifndef FW_DEVICE_DEVICE_READER_H
#define FW_DEVICE_DEVICE_READER_H
#include "device/device.h"
#include "device/device_table.h"
#include "xml/xml_reader.h"

typedef struct
    fw_device_override { /* --set of a parameter: its declared value still gives the dimension
                              */
    const fw_xml_element *element;
    const fw_xml_attribute *attribute;
} fw_device_override;

typedef struct fw_device_id_index { /* ids of one space by hash; grows with the description */
    int *slot;                      /* (1 << bits) 1 + index, 0: free */
    int bits, entered;
} fw_device_id_index;

typedef struct fw_device_reader {
    fw_xml_reader xml; /* the file's records */
    fw_arena *arena;   /* the same as of xml, as diags is */
    fw_diags *diags;
    fw_device_override *override_; /* (noverride) */
    int noverride;
    fw_quantity_name_value *name; /* parameters with a value, those of xml.names */
    fw_device_id_index index[FW_SPACE_COUNT];
    fw_device *device;
    const fw_device_files *files; /* NULL: none are opened */
} fw_device_reader;

/* parameter.c: steps between those of xml/xml_reader.h */
fw_status fw_device_sets_apply(fw_device_reader *r, const fw_device_set *set, int nset);
fw_status fw_device_parameters_read(fw_device_reader *r);

/* one step per part of the description */
fw_status fw_device_build_parts(fw_device_reader *r);
fw_status fw_device_build_wafer(fw_device_reader *r); /* <wafer> with its sweeps */
fw_status fw_device_build_cells(fw_device_reader *r); /* drawings on the die and the wafer */
fw_status fw_device_build_flexures(fw_device_reader *r);
fw_status fw_device_expand_six_bar(fw_device_reader *r); /* bodies 0..4 and joints 0..5 */
fw_status fw_device_build_mechanism(fw_device_reader *r);
fw_status fw_device_build_scenes(fw_device_reader *r);
fw_status fw_device_build_probes(fw_device_reader *r); /* when all that they name is there */
fw_status fw_device_build_studies(fw_device_reader *r);
/* poses.c: poses whose joints are open by what rounded numbers leave (FW-D132) */
fw_status fw_device_close_rounded(fw_device_reader *r);

/* build_shapes.c: the drawing that `file` of an element names; FW_INPUT, FW_IO, FW_LIMIT: reported. What
   one unit of it is by its symbol, NaN without one */
fw_status fw_device_drawing_open(fw_device_reader *r, const fw_xml_record *record,
                                 const char **data, size_t *n);
double fw_device_drawing_unit_m(const char *unit);

/* time_law.c: the law of a load, NULL for one that is constant from the start or was reported */
fw_status fw_device_time_law(fw_device_reader *r, const fw_xml_record *record,
                             const fw_quantity_law **law);
/* an attribute as an expression in time; *program NULL when it is absent or was reported */
fw_status fw_device_time_program(fw_device_reader *r, const fw_xml_record *record, const char *name,
                                 fw_quantity_dimension wanted, const fw_quantity_program **program);
/* error where the law is not finite at one of some instants of [0, duration_s] */
void fw_device_finite_check(fw_device_reader *r, const fw_xml_record *record, const char *name,
                            const fw_quantity_law *law, double duration_s);

/* ---- reference.c ---- */

enum { FW_NOWHERE = -2 };
/* index of what the attribute refers to (joints first, then joints njoint + i), FW_GROUND (==
   FW_NONE) for "ground" or when it is absent, FW_NOWHERE when there is none: that has been reported
 */
int fw_device_reference(fw_device_reader *r, const fw_xml_record *record, const char *name);
/* the first of `names` (n) that is given is one too many: error `number`, "LABEL: NAME WHY" */
bool fw_device_refused(fw_device_reader *r, const fw_xml_record *record, int number,
                       const char *const *names, int n, const char *why);
/* the first of `names` (n) that is absent is one too few: error `number` at the element */
bool fw_device_needed(fw_device_reader *r, const fw_xml_record *record, int number,
                      const char *const *names, int n, const char *why);

/* it has a width, a plate or shapes: device.c */
bool fw_device_body_drawn(const fw_device_body *body);
/* build_shapes.c: how many elements in the record of a <body> are drawn; then what they are */
int fw_device_shapes_given(const fw_xml_record *record);
fw_status fw_device_build_shapes(fw_device_reader *r, const fw_xml_record *record,
                                 fw_device_body *body);

/* One function per element of <scene>: build_scenes.c, build_surroundings.c. Private to device/. */

typedef struct fw_device_scene_reader {
    fw_device_reader *r;
    fw_device_scene *scene; /* its arrays have room for all of its elements */
    double duration_s;
    int *moved; /* (nbody) 1 + index of its <initial> in this scene, 0: none yet */
} fw_device_scene_reader;

/* `at`: index of the element's record */
fw_status fw_device_build_friction(fw_device_scene_reader *s, int at);
fw_status fw_device_build_contact(fw_device_scene_reader *s, int at);
fw_status fw_device_build_material_damping(fw_device_scene_reader *s, int at);
fw_status fw_device_build_temperature(fw_device_scene_reader *s, int at);
fw_status fw_device_build_residual_stress(fw_device_scene_reader *s, int at);
fw_status fw_device_build_air(fw_device_scene_reader *s, int at);

/* Kinds of <flexure>: a row, in flexure_kind.c or in a file of its own, and a line in flexures.def each.
   What is made of lines and arcs needs no more: as a path (fw_device_flexure_lay) it has its mechanics,
   its outline and its solid. */

typedef struct fw_device_flexure_row {
    const char *name;
    /* NULL-terminated: those of length, radius, angle and width-middle that it goes by. Any other
       is refused: "<before>NAME<after>", or with number 0 in general words */
    const char *const *takes;
    struct {
        int number; /* of the diagnostic */
        const char *before, *after;
    } refused;
    bool pieces; /* it has <line> and <arc> inside; else they are refused */
    /* from the record `at`; *flexure has what the attributes say. What is wrong is a diagnostic */
    fw_status (*build)(fw_device_reader *r, int at, fw_device_flexure *flexure);
} fw_device_flexure_row;

/* edges of a piece: each must lie on its side of the centre line all along */
bool fw_device_flexure_edges(fw_device_reader *r, const fw_xml_record *record,
                             const fw_geometry_strip_piece *piece);
/* makes the flexure a path of these pieces (n >= 1, kept), whose edges are right: its length, turn
   and least width. One that meets itself is reported */
void fw_device_flexure_lay(fw_device_reader *r, const fw_xml_record *record,
                           const fw_geometry_strip_piece *piece, int n, fw_device_flexure *f);

#endif
