// SPDX-License-Identifier: GPL-3.0-or-later
// The documentation as pages of the program: docs/*.md as HTML, for who has no network and no source at hand. What these pages
// use of Markdown is read here: headings, lists, tables, code, links, emphasis. Links to what is not among them are words.
import { readFileSync } from "node:fs";
import { dirname, join, normalize } from "node:path";

export const PAGES = [
    ["page.md", "The page"], ["tutorial.md", "Tutorial"], ["gallery/README.md", "Gallery"], ["mechanisms/README.md", "Mechanisms"], ["studies.md", "Studies"],
    ["silicon-on-glass.md", "Silicon on glass"], ["hinge-ladder.md", "Models of hinges"], ["limits.md", "What it does not do"], ["glossary.md", "Glossary"], ["reference/device.md", "Device description"],
    ["reference/numbers.md", "Numbers of a design"], ["reference/process.md", "Process packs"], ["reference/command-line.md", "Command line"], ["reference/diagnostics.md", "Diagnostics"],
];

const escaped = (x) => x.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
export const nameOf = (md) => `${md.replace(/\/README\.md$/, "").replace(/\.md$/, "").replaceAll("/", "-")}.html`;
const slug = (text) => text.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").trim().replace(/\s/g, "-");

/** `code`, **bold**, *italics*, [links](to#there); pictures are left out. */
function inline(text, target) {
    const codes = [];
    const kept = text.replace(/(`+)(.+?)\1/g, (_, __, code) => `\u0000${codes.push(`<code>${escaped(code.trim())}</code>`) - 1}\u0000`);
    return escaped(kept).replace(/!\[[^\]]*\]\([^)]*\)/g, "")
        .replace(/\[([^\]]*)\]\(([^)\s]*)\)/g, (_, words, to) => { const at = target(to); return at ? `<a href="${at}">${words}</a>` : words; })
        .replace(/\*\*(.+?)\*\*/g, "<strong>$1</strong>").replace(/(^|[\s(])\*([^*\s][^*]*)\*/g, "$1<em>$2</em>").replace(/\\([*_|])/g, "$1")
        .replace(/\u0000(\d+)\u0000/g, (_, i) => codes[i]);
}

const cells = (line) => line.trim().replace(/^\||\|$/g, "").split(/(?<!\\)\|(?=(?:[^`]*`[^`]*`)*[^`]*$)/).map((x) => x.trim());

/** target(to): the address of a link, or null */
export function html(markdown, target) {
    const lines = markdown.replace(/<!--[^]*?-->/g, "").split("\n");
    const out = [];
    let i = 0;
    const say = (text) => inline(text, target);
    const until = (stop) => {
        const some = [];
        while (i < lines.length && !stop(lines[i])) some.push(lines[i++]);
        return some;
    };
    const block = /^(#{1,6} |```|    |\||\s*[*-] |\s*\d+\. |\s*$)/;
    while (i < lines.length) {
        const line = lines[i];
        const head = /^(#{1,6}) (.*)$/.exec(line);
        if (!line.trim()) i++;
        else if (head) {
            const words = say(head[2]);
            out.push(`<h${head[1].length} id="${slug(head[2].replaceAll("`", ""))}">${words}</h${head[1].length}>`);
            i++;
        } else if (line.startsWith("```")) {
            i++;
            out.push(`<pre tabindex="0"><code>${escaped(until((x) => x.startsWith("```")).join("\n"))}</code></pre>`);
            i++;
        } else if (/^ {4}/.test(line)) {
            const code = until((x) => x.trim() && !/^ {4}/.test(x)).map((x) => x.slice(4)).join("\n").trimEnd();
            out.push(`<pre tabindex="0"><code>${escaped(code)}</code></pre>`);
        } else if (line.startsWith("|")) {
            const rows = until((x) => !x.startsWith("|")).map(cells);
            const [first, , ...rest] = rows;
            const heads = first.some(Boolean) ? `<thead><tr>${first.map((x) => `<th scope="col">${say(x)}</th>`).join("")}</tr></thead>` : "";
            out.push(`<div class="wide" tabindex="0"><table>${heads}<tbody>${rest.map((r) => `<tr>${r.map((x) => `<td>${say(x)}</td>`).join("")}</tr>`).join("\n")}</tbody></table></div>`);
        } else if (/^\s*([*-]|\d+\.) /.test(line)) {
            const kind = /^\s*\d/.test(line) ? "ol" : "ul";
            const items = [];
            while (i < lines.length && lines[i].trim()) {
                const item = /^\s*(?:[*-]|\d+\.) (.*)$/.exec(lines[i]);
                if (item) items.push(item[1]);
                else if (items.length && /^\s/.test(lines[i])) items.push(`${items.pop()} ${lines[i].trim()}`);
                else break;
                i++;
            }
            out.push(`<${kind}>${items.map((x) => `<li>${say(x)}</li>`).join("")}</${kind}>`);
        } else {
            const text = [lines[i++], ...until((x) => block.test(x))].join(" ");
            const words = say(text).trim();
            if (words) out.push(`<p>${words}</p>`);
        }
    }
    return out.join("\n");
}

/** [[name, text]] of all pages. */
export function helpPages(docs) {
    const there = new Map(PAGES.map(([md]) => [md, nameOf(md)]));
    const page = (title, body, own) => `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>${escaped(title)} – Flexwright</title><link rel="stylesheet" href="/help/help.css"></head>
<body><nav aria-label="Pages"><strong>Flexwright</strong><ul>${PAGES.map(([md, words]) => `<li><a href="/help/${nameOf(md)}"${md === own ? ' aria-current="page"' : ""}>${escaped(words)}</a></li>`).join("")}</ul></nav><main>
${body}
</main></body></html>
`;
    return PAGES.map(([md, words]) => {
        const target = (to) => {
            const [path, place] = to.split("#");
            if (/^[a-z]+:/.test(path)) return null; // nothing is fetched from elsewhere
            const at = path ? normalize(join(dirname(md), path)) : md;
            return there.has(at) ? `/help/${there.get(at)}${place ? `#${place}` : ""}` : null;
        };
        return [nameOf(md), page(words, html(readFileSync(join(docs, md), "utf8"), target), md)];
    });
}
