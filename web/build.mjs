// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the page: node build.mjs DIRECTORY. DIRECTORY/node_modules has the libraries (npm ci) and
// DIRECTORY/dist becomes the page. The same sources and libraries give the same bytes.
import { copyFile, mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { helpPages } from "./help.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const place = resolve(process.argv[2] ?? here);
const libraries = join(place, "node_modules");
const out = join(place, "dist");
const { build } = createRequire(join(place, "package.json"))("esbuild");
await rm(out, { recursive: true, force: true });
await mkdir(out, { recursive: true });

const common = {
    absWorkingDir: here, // names of modules, and with them the order, do not depend on where it is called
    nodePaths: [libraries],
    bundle: true,
    minify: true,
    charset: "utf8",
    legalComments: "none", // licences.txt has them whole
    target: ["chrome111", "firefox121", "safari16.4"],
    outdir: out,
    logLevel: "warning",
    metafile: true,
    loader: { ".xml": "text", ".svg": "text" },
};
const script = await build({ ...common, entryPoints: { page: "src/main.js" }, format: "esm" });
const style = await build({ ...common, entryPoints: { page: "style/page.css" } });
await build({ ...common, entryPoints: { help: "style/help.css" }, outdir: join(out, "help") });
for (const [name, text] of helpPages(join(here, "../docs"))) await writeFile(join(out, "help", name), text);
for (const name of ["index.html", "favicon.svg"]) await copyFile(join(here, name), join(out, name));

/** The licence of every library of which something is in the page. */
async function licences() {
    const inputs = [...Object.keys(script.metafile.inputs), ...Object.keys(style.metafile.inputs)];
    const names = new Set(inputs.map((p) => /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(p)?.[1]).filter(Boolean));
    const parts = [];
    for (const name of [...names].sort()) {
        const root = join(libraries, name);
        const about = JSON.parse(await readFile(join(root, "package.json"), "utf8"));
        const file = (await readdir(root)).find((f) => /^licen[cs]e/i.test(f));
        if (!file) throw new Error(`${name} has no licence file`);
        parts.push(`${name} ${about.version} (${about.license})\n\n${(await readFile(join(root, file), "utf8")).trim()}\n`);
    }
    return `Libraries in the page of Flexwright, and their licences.\n\n${parts.join(`\n${"-".repeat(72)}\n\n`)}`;
}
await writeFile(join(out, "licences.txt"), await licences());
