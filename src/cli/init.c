/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/session.h"
#include <stdio.h>
#include <string.h>

/* a starter that every command accepts as it is; masses and stiffnesses come from the drawing */
static const char starter[] =
    "  <parameter name=\"arc\" value=\"240 deg\" min=\"140 deg\" max=\"260 deg\" doc=\"subtended "
    "angle of every hinge arc\"/>\n"
    "  <parameter name=\"t\" value=\"10 um\" min=\"6 um\" max=\"20 um\" doc=\"width of every "
    "flexure\"/>\n"
    "\n"
    "  <material ref=\"silicon-100\" thickness=\"50 um\"/>\n"
    "  <limits safety-factor=\"2\"/>\n"
    "  <flow ref=\"al-masked-rie\"/>\n"
    "\n"
    "  <!-- circular-arc flexures with conjugate surfaces; radius may be given instead of length "
    "-->\n"
    "  <flexure id=\"leg\" kind=\"csfh\" length=\"360 um\" angle=\"arc\" width=\"t\" gap=\"8 "
    "um\"/>\n"
    "\n"
    "  <!-- base FA, legs ABC and FED, platform CD -->\n"
    "  <six-bar>\n"
    "    <hinge at=\"A\" x=\"-0.7 mm\" y=\"-1.0 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"B\" x=\"-1.2 mm\" y=\"0 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"C\" x=\"-0.6 mm\" y=\"1.2 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"D\" x=\"0.6 mm\" y=\"1.2 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"E\" x=\"1.2 mm\" y=\"0 mm\" flexure=\"leg\"/>\n"
    "    <hinge at=\"F\" x=\"0.7 mm\" y=\"-1.0 mm\" flexure=\"leg\"/>\n"
    "    <link id=\"AB\" width=\"120 um\"/>\n"
    "    <link id=\"BC\" width=\"120 um\"/>\n"
    "    <platform id=\"CD\" width=\"1.2 mm\" height=\"0.4 mm\" x=\"0 mm\" y=\"1.4 mm\"/>\n"
    "    <link id=\"DE\" width=\"120 um\"/>\n"
    "    <link id=\"EF\" width=\"120 um\"/>\n"
    "  </six-bar>\n"
    "\n"
    "  <scene name=\"push\" duration=\"10 ms\">\n"
    "    <force on=\"CD\" fx=\"0.04 mN\" fy=\"0 mN\"/>\n"
    "  </scene>\n"
    "  <workspace x-min=\"-40 um\" x-max=\"40 um\" y-min=\"-20 um\" y-max=\"20 um\" phi-min=\"-0.5 "
    "deg\" phi-max=\"0.5 deg\"/>\n"
    "</device>\n";

static int name_is_plain(const char *name) {
    size_t n = strlen(name);
    if (n == 0 || n > 64 || (name[0] >= '0' && name[0] <= '9') || name[0] == '-') return 0;
    return strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == n;
}

int fw_cli_command_init(fw_cli_options *options) {
    const char *name = options->device ? options->device : "my-device";
    if (!name_is_plain(name))
        return fw_cli_usage("a device is named with letters, digits, - and _, not '%s'", name);
    printf("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<device xmlns=\"urn:flexwright:device:1\" name=\"%s\">\n%s",
           name, starter);
    return 0;
}
