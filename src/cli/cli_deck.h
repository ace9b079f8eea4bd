/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Input decks of the continuum level for a person's own solver. Private to the room. */
#ifndef FW_CLI_CLI_DECK_H
#define FW_CLI_CLI_DECK_H
#include "plan/plan.h"

/* Into DIRECTORY, made when it is not there, for every flow of the plan (the plan is loaded):
   hinge-ID[-FLOW].inp       unit loads on each flexure
   hinge-ID[-FLOW]-large.inp a quarter, half, three quarters and all of its limit angle
   mechanism-SCENE[-FLOW].inp the whole mechanism under each scene's loads at its end; where it
                             cannot be written a note (FW-D213) says why
   each file whole or not at all. refinement 0: the default. *files counts them. */
fw_status fw_cli_decks(fw_plan *plan, const char *directory, double refinement, int *files);

#endif
