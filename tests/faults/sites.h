/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a program allocates from arenas: the number of the first allocation of every place. The functions
   of base/arena.h are wrapped by the linker (scripts.cmake), so the program is as it is. */
#ifndef FW_TESTS_FAULTS_SITES_H
#define FW_TESTS_FAULTS_SITES_H

enum { SITES_MOST = 65536, SITES_DEEP = 5 };

typedef struct sites {
    long count, first[SITES_MOST];
    unsigned long seen[2 * SITES_MOST]; /* by hash; 0: free */
} sites;

sites *sites_new(void); /* shared with processes that are forked later; NULL: none */
void sites_free(sites *s);
void sites_note(sites *s); /* from now on; NULL: no longer */

#endif
