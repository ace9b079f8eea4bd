/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading a pack; private to process/. */
#ifndef FW_PROCESS_PACK_H
#define FW_PROCESS_PACK_H
#include "device/quantity_xml.h"
#include "process/law.h"

typedef enum fw_id_kind {
    FW_ID_SOURCE,
    FW_ID_MATERIAL,
    FW_ID_EQUIPMENT,
    FW_ID_HAZARD,
    FW_ID_QUANTITY,
    FW_ID_STEP
} fw_id_kind;

typedef struct fw_id {
    const char *id;
    fw_id_kind kind;
    bool base; /* from base.xml */
    int order;
    void *item; /* the thing itself */
    fw_place place;
} fw_id;

typedef struct fw_pack {
    fw_arena *arena;
    fw_diags *diags;
    fw_flow *flow;
    const fw_element *base, *root;
    fw_source_text *source; /* (nsource) flow's first, then base's */
    int nsource;
    fw_id *id; /* (nid) sorted once everything is collected */
    int nid;
} fw_pack;

/* unknown elements and attributes, missing attributes and children, values outside a list */
fw_status fw_pack_check(fw_pack *pack, const fw_element *root, bool is_base);

/* the thing with this id and kind; NULL and a diagnostic at the attribute when there is none */
void *fw_pack_find(fw_pack *pack, const fw_attribute *attribute, fw_id_kind kind);
const fw_attribute *fw_pack_get(const fw_element *e, const char *name);
const char *fw_pack_text(const fw_element *e, const char *name); /* "" when absent */
int fw_pack_count(const fw_element *e, const char *child);
double fw_pack_number(fw_pack *pack, const fw_element *e, const char *name, double absent);

fw_status fw_pack_steps(fw_pack *pack);
/* <corner>s of the flow; mistakes are FW-D260 */
void fw_pack_corners(fw_pack *pack);

#endif
