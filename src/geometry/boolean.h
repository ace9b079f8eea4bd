/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to geometry/: the pieces into which the outlines of two regions are cut. */
#ifndef FW_GEOMETRY_BOOLEAN_H
#define FW_GEOMETRY_BOOLEAN_H
#include "geometry/segment.h"

typedef struct fw_geometry_cut { /* segment number, where on it, which node */
    int segment, node;
    double t;
} fw_geometry_cut;

typedef struct fw_geometry_edge { /* part t0..t1 of a segment between two nodes */
    int segment, rank;            /* rank: the how-manieth part of its segment */
    int owner;                    /* 0 = p, 1 = q */
    int from, to;                 /* nodes */
    double t0, t1;
    bool reversed, keep, used;
    int twin; /* edge of the other region on the same path, or -1 */
} fw_geometry_edge;

typedef struct fw_geometry_graph {
    fw_arena *arena;
    const fw_geometry_segment **segment; /* (nsegment) of p, then of q */
    fw_geometry_vec2 *node;              /* (nnode) */
    int *same;        /* (nnode) an earlier node that it is one with, or itself */
    int *head, *next; /* (heads), (nnode) chains of nodes by the square of 1 nm they lie in; -1 */
    unsigned heads;   /* a power of two */
    fw_geometry_cut *cut;                     /* (ncut) */
    fw_geometry_edge *edge;                   /* (nedge) */
    int nsegment, nfirst, nnode, ncut, nedge; /* nfirst: segments of p */
    int node_room, cut_room;
    fw_geometry_box *own;   /* (nsegment) of each segment */
    fw_geometry_box box[2]; /* of p, of q */
    fw_geometry_vec2 asked; /* the last place that a node was asked for, */
    int answer;             /* and which it was */
} fw_geometry_graph;

/* an edge as a segment of its own, in its running direction */
fw_geometry_segment fw_geometry_edge_segment(const fw_geometry_graph *graph,
                                             const fw_geometry_edge *edge);
/* kept edges to closed outlines, each visiting a node at most once */
fw_status fw_geometry_graph_stitch(fw_geometry_graph *graph, fw_geometry_region *out);

#endif
