// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the page: node build.mjs OUTPUT-DIRECTORY. The same sources give the same bytes.
import { build } from "esbuild";
import { copyFile, mkdir } from "node:fs/promises";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? "dist");
await mkdir(out, { recursive: true });
process.chdir(here); // names of modules, and with them the order, do not depend on where it is called
await build({
    entryPoints: { page: "src/main.js" },
    bundle: true,
    minify: true,
    format: "esm",
    target: ["chrome109", "firefox115", "safari16.4"],
    charset: "utf8",
    legalComments: "none", // the About dialog names every library and its licence
    outdir: out,
    logLevel: "warning",
});
await build({
    entryPoints: { page: "style/page.css" },
    bundle: true,
    minify: true,
    target: ["chrome109", "firefox115", "safari16.4"],
    charset: "utf8",
    outdir: out,
    logLevel: "warning",
});
for (const name of ["index.html", "favicon.svg"]) await copyFile(name, join(out, name));
