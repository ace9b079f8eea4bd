/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CalculiX input decks: um, uN, MPa. Not mm and N: there CalculiX stops with
   moments off by a percent at finite rotation, whatever residual is asked for. Private to the room.
 */
#ifndef FW_CONTINUUM_CONTINUUM_DECK_H
#define FW_CONTINUUM_CONTINUUM_DECK_H
#include "continuum/mesh.h"

/* numbers as CalculiX reads them: at most 20 characters a field */
void fw_continuum_deck_number(fw_text *deck, double value);
void fw_continuum_deck_head(fw_text *deck, const char *what);
/* nodes, numbered from `first`, placed by rotation and translation; um */
void fw_continuum_deck_nodes(fw_text *deck, const fw_continuum_mesh *mesh, fw_geometry_pose pose,
                             int first);
void fw_continuum_deck_bricks(fw_text *deck, const fw_continuum_mesh *mesh, int first_node,
                              int first_element);
/* *MATERIAL, *ELASTIC, *ORIENTATION for a crystal turned by turn_rad more, *SOLID SECTION */
void fw_continuum_deck_material(fw_text *deck, const fw_continuum_material *material,
                                const char *name, const char *elset, double turn_rad);
/* node numbers for which `take` answers yes, as data lines */
typedef bool (*fw_continuum_deck_take)(const fw_continuum_mesh *mesh, int i, int j, int k);
void fw_continuum_deck_set(fw_text *deck, const fw_continuum_mesh *mesh, int first_node,
                           fw_continuum_deck_take take);
bool fw_continuum_deck_root_first(const fw_continuum_mesh *mesh, int i, int j, int k);
bool fw_continuum_deck_root_second(const fw_continuum_mesh *mesh, int i, int j, int k);
bool fw_continuum_deck_middle(const fw_continuum_mesh *mesh, int i, int j,
                              int k); /* but no rigid face */
bool fw_continuum_deck_field(const fw_continuum_mesh *mesh, int i, int j, int k);

/* ---- one hinge ---- */
typedef enum fw_continuum_deck_steps { FW_DECK_LINEAR, FW_DECK_LARGE } fw_continuum_deck_steps;
fw_status fw_continuum_deck_hinge(const fw_continuum_shape *shape,
                                  const fw_continuum_material *material,
                                  const fw_continuum_options *options,
                                  const fw_continuum_mesh *mesh, fw_continuum_deck_steps steps,
                                  fw_text *deck);

#endif
