/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results appear whole or not at all. Files are built in DIR.tmp-PID beside DIR, each one checked
   and synced; commit exchanges the two directories in one step and removes the old one. */
#ifndef FW_BASE_OUTPUT_H
#define FW_BASE_OUTPUT_H
#include "base/diag.h"

typedef struct fw_output fw_output;
typedef struct fw_output_file {
    const char *name;   /* relative, with '/' */
    size_t size;        /* bytes */
    const char *sha256; /* 64 hexadecimal digits */
} fw_output_file;

/* starts a set of files that will become directory `path`. A directory that exists is refused
   unless it is empty or holds exactly the files of its manifest.json, unchanged: a person's notes
   and filled-in run sheets are never deleted. */
fw_status fw_output_open(fw_arena *arena, const char *path, fw_diags *diags, fw_output **output);
/* would that be refused? Says so as it would, and touches nothing: for those who work for long before. */
fw_status fw_output_check(fw_arena *arena, const char *path, fw_diags *diags);
/* one file below the directory; makes sub-directories. Errors name the file. */
fw_status fw_output_write(fw_output *output, const char *name, const void *data, size_t n);
const fw_output_file *fw_output_files(const fw_output *output, size_t *count); /* by name */
fw_status fw_output_commit(fw_output *output);
/* removes a tree of our own making, `name` below the directory `parent`: plain files and
   directories, never through links */
void fw_output_remove_tree(int parent, const char *name);
/* what a run that was killed left: PATH.tmp-PID whose process is gone */
void fw_output_remove_leftovers(fw_arena *arena, const char *path);
void fw_output_abort(fw_output *output); /* removes what was built; NULL and twice allowed */

/* a single file, whole or not at all ("-" is standard output) */
fw_status fw_output_single(fw_arena *arena, const char *path, const void *data, size_t n,
                           fw_diags *diags);

/* makes a directory with those above it. *made: it was not there. What is wrong with it, writing into it will say */
fw_status fw_output_directory(fw_arena *arena, const char *path, bool *made);

typedef struct fw_output_member {
    const char *name; /* without '/' */
    const void *data;
    size_t n;
} fw_output_member;
/* Files of a directory that is there and may hold others: each one whole, and where one cannot be
   put in place those before it are as they were. A kill between two of them leaves some old, some
   new. Sweeps what a killed run left of these names. */
fw_status fw_output_members(fw_arena *arena, const char *directory, const fw_output_member *file,
                            size_t count, fw_diags *diags);

/* a whole file or, for "-", standard input, at most `most` bytes (FW_INPUT beyond); NUL added
   after the end. Errors name the file (FW-D220, FW-D221). Anything but a file (a pipe, a device, a
   socket, a directory) is refused at once, never waited for. */
fw_status fw_input_read(fw_arena *arena, const char *path, size_t most, fw_diags *diags,
                        char **data, size_t *n);

/* where packs and layer tables are: the caller's directory ($FLEXWRIGHT_DATA) and no other when it
   is given, else share/flexwright beside the program or library that asks, wherever its tree was moved
   to, else the installed one, else the source tree. A path of `name` that exists, or NULL.
   Test: tests/python/install.sh */
fw_status fw_data_path(fw_arena *arena, const char *override, const char *name, const char **path);
/* names of the files NAME.xml of one directory there ("processes"), sorted, without the ending; none where it
   cannot be read */
fw_status fw_data_names(fw_arena *arena, const char *override, const char *directory,
                        const char *const **name, size_t *n);

/* A text file that only grows: it is locked from reading to writing, a line is written in one piece
   and synced, and when that fails the file is as it was. */

typedef struct fw_append {
    const char *path;
    int fd;
    char *text; /* (n) what the file holds, NUL behind it */
    size_t n;
    fw_diags *diags;
} fw_append;

/* opens and locks (waits for another writer), makes the file when there is none, reads it: at most
   `most` bytes. FW-D220 to FW-D222 name the file. */
fw_status fw_append_open(fw_arena *arena, const char *path, size_t most, fw_diags *diags,
                         fw_append *file);
fw_status fw_append_text(fw_append *file, const char *text, size_t n);
/* what was added since the file had n bytes, where something that goes with it could not be written */
void fw_append_take_back(fw_append *file, size_t n);
void fw_append_close(fw_append *file); /* removes a file that it made and that is still empty */

#endif
