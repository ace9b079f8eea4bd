/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of device files. A new element or attribute is one row in table_*.c. Private to
   device/.
 */
#ifndef FW_DEVICE_DEVICE_TABLE_H
#define FW_DEVICE_DEVICE_TABLE_H
#include "xml/xml_table.h"

typedef enum fw_device_space { /* ids are unique within one of these */
                               FW_SPACE_NONE,
                               FW_SPACE_PARAMETER,
                               FW_SPACE_FLOW,
                               FW_SPACE_FLEXURE,
                               FW_SPACE_BODY,
                               FW_SPACE_JOINT,
                               FW_SPACE_SPRING,
                               FW_SPACE_DRIVER,
                               FW_SPACE_SCENE,
                               FW_SPACE_TENDON,
                               FW_SPACE_COMB,
                               FW_SPACE_CONTACT,
                               FW_SPACE_COUNT
} fw_device_space;

/* each ends with a row without a name */
extern const fw_xml_element_row fw_device_table_device[], fw_device_table_mechanism[],
    fw_device_table_scene[], fw_device_table_effects[];
extern const fw_xml_table fw_device_table;

#endif
