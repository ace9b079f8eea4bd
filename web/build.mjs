// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the page: node build.mjs OUTPUT-DIRECTORY. The same sources give the same bytes.
import { build } from "esbuild";
import { copyFile, mkdir, readdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? "dist");
process.chdir(here); // names of modules, and with them the order, do not depend on where it is called
await mkdir(out, { recursive: true });

const common = {
    bundle: true,
    minify: true,
    charset: "utf8",
    legalComments: "none", // licences.txt has them whole
    target: ["chrome111", "firefox121", "safari16.4"],
    outdir: out,
    logLevel: "warning",
    metafile: true,
};
const script = await build({ ...common, entryPoints: { page: "src/main.js" }, format: "esm" });
const style = await build({ ...common, entryPoints: { page: "style/page.css" } });
for (const name of ["index.html", "favicon.svg"]) await copyFile(name, join(out, name));

/** The licence of every library of which something is in the page. */
async function licences() {
    const inputs = [...Object.keys(script.metafile.inputs), ...Object.keys(style.metafile.inputs)];
    const names = new Set(inputs.map((p) => /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(p)?.[1]).filter(Boolean));
    const parts = [];
    for (const name of [...names].sort()) {
        const root = join("node_modules", name);
        const about = JSON.parse(await readFile(join(root, "package.json"), "utf8"));
        const file = (await readdir(root)).find((f) => /^licen[cs]e/i.test(f));
        if (!file) throw new Error(`${name} has no licence file`);
        parts.push(`${name} ${about.version} (${about.license})\n\n${(await readFile(join(root, file), "utf8")).trim()}\n`);
    }
    return `Libraries in the page of Flexwright, and their licences.\n\n${parts.join(`\n${"-".repeat(72)}\n\n`)}`;
}
await writeFile(join(out, "licences.txt"), await licences());
