/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The defences of the server by name. All are on. A test builds the program once for each with
   FW_SERVE_WITHOUT=FW_DEFENCE_..., and must then see a hostile request get through
   (tests/serve/mutants.py). Checks that the table of routes
   repeats (methods, paths) are not here: without one of them the other still refuses. Private to
   the room. */
#ifndef FW_SERVE_DEFENCE_H
#define FW_SERVE_DEFENCE_H

enum fw_serve_defence {
    FW_DEFENCE_NONE,
    FW_DEFENCE_HOST,
    FW_DEFENCE_ORIGIN,
    FW_DEFENCE_FETCH_SITE,
    FW_DEFENCE_ONE_TIME,
    FW_DEFENCE_COOKIE,
    FW_DEFENCE_HEADER_TOKEN,
    FW_DEFENCE_CONTENT_TYPE,
    FW_DEFENCE_BODY,
    FW_DEFENCE_HEAD,
    FW_DEFENCE_REAPER
};
#ifndef FW_SERVE_WITHOUT
#define FW_SERVE_WITHOUT FW_DEFENCE_NONE
#endif
#define FW_DEFENDED(what) (FW_SERVE_WITHOUT != FW_DEFENCE_##what)

#endif
