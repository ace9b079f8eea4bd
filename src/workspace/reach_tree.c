/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/reach_tree.h"

enum { PARTS = 8, FIRST_NODES = 1024 };

fw_status fw_workspace_tree_plant(fw_workspace_tree *tree, fw_arena *arena) {
    *tree = (fw_workspace_tree){.arena = arena, .count = 1, .capacity = FIRST_NODES};
    FW_NEED(tree->node = fw_arena_array(arena, fw_workspace_node, FIRST_NODES));
    tree->node[0].kind = FW_NODE_OUTSIDE;
    return FW_OK;
}

fw_status fw_workspace_tree_halve(fw_workspace_tree *tree, unsigned node, unsigned *first) {
    if (tree->count + PARTS > tree->capacity) {
        FW_NEED(tree->node = fw_arena_grow(tree->arena, tree->node, tree->count, 2 * tree->capacity,
                                           sizeof *tree->node));
        tree->capacity *= 2;
    }
    *first = (unsigned)tree->count;
    tree->node[node] = (fw_workspace_node){.kind = FW_NODE_HALVED, .first = *first};
    for (int i = 0; i < PARTS; i++)
        tree->node[tree->count++] = (fw_workspace_node){.kind = FW_NODE_OUTSIDE};
    return FW_OK;
}

/* halved, and some part of it again */
static bool goes_on(const fw_workspace_tree *tree, unsigned node) {
    if (tree->node[node].kind != FW_NODE_HALVED) return false;
    for (unsigned i = 0; i < PARTS; i++)
        if (tree->node[tree->node[node].first + i].kind == FW_NODE_HALVED) return true;
    return false;
}

static char *write_node(const fw_workspace_tree *tree, unsigned node, char *end) {
    char kind = tree->node[node].kind;
    if (!goes_on(tree, node)) {
        *end++ = kind == FW_NODE_HALVED ? FW_NODE_CUT : kind;
        return end;
    }
    *end++ = kind;
    for (unsigned i = 0; i < PARTS; i++)
        end = write_node(tree, tree->node[node].first + i, end);
    return end;
}

fw_status fw_workspace_tree_text(const fw_workspace_tree *tree, fw_arena *arena,
                                 const char **text) {
    char *out;
    FW_NEED(out = fw_arena_array(arena, char, tree->count + 1));
    *write_node(tree, 0, out) = '\0';
    *text = out;
    return FW_OK;
}
