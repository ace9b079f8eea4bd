/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tree of halvings of a search for the reachable volume, kept so that another program can go
   over the same boxes. Private to the room and its tests. */
#ifndef FW_WORKSPACE_REACH_TREE_H
#define FW_WORKSPACE_REACH_TREE_H
#include "workspace/reach.h"

/* what a node is, as its character in the text */
enum {
    FW_NODE_INSIDE = 'i',
    FW_NODE_OUTSIDE = 'o',
    FW_NODE_CUT = 'c', /* a leaf that is neither, or of which neither is proved */
    FW_NODE_HALVED = 'h'
};

typedef struct fw_workspace_node {
    char kind;
    unsigned first; /* of eight nodes, where it is halved */
} fw_workspace_node;

typedef struct fw_workspace_tree {
    fw_arena *arena;
    fw_workspace_node *node; /* (count) the first is the whole box */
    size_t count, capacity;
} fw_workspace_tree;

/* the whole box, outside until something else is said of it */
fw_status fw_workspace_tree_plant(fw_workspace_tree *tree, fw_arena *arena);
/* halves a node along all three coordinates; *first: the first of its eight parts, all outside;
   part n is the upper half along coordinate i where bit i of n is set */
fw_status fw_workspace_tree_halve(fw_workspace_tree *tree, unsigned node, unsigned *first);
/* One character a node: each before its eight parts, which follow in their order. A box that was
   halved into leaves is a cut leaf itself, which makes the text a third as long: the remainders of
   tests/accept/check_volume.py are so much smaller than ours that it does without the last halving. */
fw_status fw_workspace_tree_text(const fw_workspace_tree *tree, fw_arena *arena, const char **text);

#endif
