// SPDX-License-Identifier: GPL-3.0-or-later
// The XML text: the only state of the design. Its history is undo and redo for the form and the
// sliders too. It lives in a shadow root, where its style sheets are adopted ones, which a strict
// content security policy allows.
import { autocompletion } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, isolateHistory, redo, redoDepth, undo, undoDepth } from "@codemirror/commands";
import { xml } from "@codemirror/lang-xml";
import { bracketMatching, foldGutter, foldKeymap, HighlightStyle, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { EditorState, Transaction } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { alike } from "./alike.js";
import { completions, hover } from "./writing.js";

const colours = HighlightStyle.define([
    { tag: tags.tagName, color: "var(--code-tag)" },
    { tag: tags.attributeName, color: "var(--code-name)" },
    { tag: [tags.attributeValue, tags.string], color: "var(--code-value)" },
    { tag: [tags.comment, tags.processingInstruction, tags.documentMeta], color: "var(--code-comment)", fontStyle: "italic" },
    { tag: [tags.angleBracket, tags.definitionOperator], color: "var(--muted)" },
    { tag: tags.invalid, color: "var(--bad-text)" },
]);

// No picture by data: address (the policy of the page forbids them): markers are signs and lines.
const look = EditorView.theme({
    "&": { height: "100%", fontSize: "var(--code-size, 12.5px)", color: "var(--ink)", backgroundColor: "var(--panel)" },
    ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.55" },
    ".cm-content": { caretColor: "var(--ink)" },
    ".cm-cursor": { borderLeftColor: "var(--ink)" },
    "&.cm-focused": { outline: "none" },
    ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--muted)", borderRight: "1px solid var(--line)" },
    ".cm-activeLine": { backgroundColor: "var(--hover)" },
    ".cm-activeLineGutter": { backgroundColor: "var(--hover)", color: "var(--ink)" },
    "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--select) !important" },
    ".cm-selectionMatch": { backgroundColor: "var(--select)" },
    ".cm-lintRange": { backgroundImage: "none !important", paddingBottom: "0" },
    ".cm-lintRange-error": { textDecoration: "underline wavy var(--bad) 1.5px", textUnderlineOffset: "3px" },
    ".cm-lintRange-warning": { textDecoration: "underline wavy var(--warn) 1.5px", textUnderlineOffset: "3px" },
    ".cm-lintRange-info": { textDecoration: "underline dotted var(--muted)" },
    ".cm-lint-marker": { content: "normal !important", width: "0.9em", height: "0.9em", borderRadius: "50%", marginTop: "0.32em" },
    ".cm-lint-marker-error": { backgroundColor: "var(--bad)" },
    ".cm-lint-marker-warning": { backgroundColor: "var(--warn)", borderRadius: "2px" },
    ".cm-lint-marker-info": { backgroundColor: "var(--muted)" },
    ".cm-tooltip": { backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--line)", borderRadius: "6px", maxWidth: "34rem" },
    ".cm-help": { padding: "5px 9px", maxWidth: "30rem", font: "12.5px/1.4 var(--sans)", whiteSpace: "normal" },
    ".cm-facts": { color: "var(--muted)" },
    ".cm-tooltip.cm-tooltip-autocomplete > ul": { fontFamily: "var(--mono)", maxHeight: "16em" },
    ".cm-tooltip.cm-tooltip-autocomplete > ul > li[aria-selected]": { background: "var(--select)", color: "var(--ink)" },
    ".cm-completionDetail": { color: "var(--muted)", fontStyle: "normal" },
    ".cm-completionInfo": { padding: "0" },
    ".cm-diagnostic": { borderLeftWidth: "4px", padding: "6px 10px" },
    ".cm-diagnostic-error": { borderLeftColor: "var(--bad)" },
    ".cm-diagnostic-warning": { borderLeftColor: "var(--warn)" },
    ".cm-panels": { backgroundColor: "var(--raised)", color: "var(--ink)", borderColor: "var(--line)" },
    ".cm-panel.cm-search input, .cm-panel.cm-search button": { font: "inherit", color: "var(--ink)", background: "var(--panel)", border: "1px solid var(--line)", borderRadius: "4px" },
    ".cm-foldPlaceholder": { backgroundColor: "var(--hover)", border: "none", color: "var(--muted)" },
});

export class Editor {
    /** onchange(text, byProgram): the text has changed, for whatever reason */
    constructor(holder, { onchange }) {
        const root = holder.attachShadow({ mode: "open" });
        this.onchange = onchange;
        this.seen = false;
        this.extensions = [
            lineNumbers(), foldGutter(), highlightActiveLineGutter(), history(), drawSelection(), indentOnInput(),
            bracketMatching(), EditorView.lineWrapping, highlightActiveLine(), highlightSelectionMatches(), search({ top: true }), lintGutter(),
            autocompletion({ override: [completions(() => this.words)], icons: false }), hover(() => this.words), xml({ autoCloseTags: true }), syntaxHighlighting(colours), look, EditorState.tabSize.of(2),
            EditorView.contentAttributes.of({ "aria-label": "XML text of the device" }),
            keymap.of([...defaultKeymap, ...historyKeymap, ...searchKeymap, ...foldKeymap]), // Tab leaves the editor, as everywhere; Ctrl ] and Ctrl [ indent
            EditorView.updateListener.of((update) => {
                if (!this.seen) return; // it reads on in a text that is not the present one any more
                this.state = update.state;
                if (update.docChanged) this.onchange(this.text);
            }),
        ];
        this.state = this.#fresh("");
        this.view = new EditorView({ state: this.state, root, parent: root });
        this.view.scrollDOM.tabIndex = 0; // it scrolls; keys must reach it
        this.view.scrollDOM.setAttribute("role", "group");
        this.view.scrollDOM.setAttribute("aria-label", "XML text, scrolled by arrow keys");
    }

    /** The table of elements and the form, for help while somebody writes. */
    help(table, form) {
        this.words = { elements: table.elements, form };
    }

    /** While nobody sees it the view does not follow: it would have the whole page laid out for every change. */
    show(yes) {
        this.seen = yes;
        if (yes && this.view.state !== this.state) this.view.setState(this.state);
    }

    #dispatch(change) {
        if (this.seen) return this.view.dispatch(change);
        const one = this.state.update(change);
        this.state = one.state;
        if (one.docChanged) this.onchange(this.text);
    }

    #fresh(doc) {
        return EditorState.create({ doc, extensions: this.extensions });
    }

    get text() {
        return this.state.doc.toString();
    }

    /** A new document without history: another file. */
    open(text) {
        this.state = this.#fresh(text);
        if (this.seen) this.view.setState(this.state);
        this.onchange(this.text);
    }

    /** The same document with other text, as one step of the history; only what differs is touched. */
    replace(text) {
        const old = this.text;
        if (old === text) return;
        let from = 0;
        while (from < old.length && from < text.length && old[from] === text[from]) from++;
        let end = 0;
        while (end < old.length - from && end < text.length - from && old.at(-1 - end) === text.at(-1 - end)) end++;
        this.#dispatch({
            changes: { from, to: old.length - end, insert: text.slice(from, text.length - end) },
            annotations: [isolateHistory.of("full"), Transaction.userEvent.of("input.form")],
        });
    }

    undo() {
        return undo({ state: this.state, dispatch: (change) => this.#dispatch(change) });
    }
    redo() {
        return redo({ state: this.state, dispatch: (change) => this.#dispatch(change) });
    }
    get depths() {
        return [undoDepth(this.state), redoDepth(this.state)];
    }

    /** list: diagnostics of the server with line and column from 1; columns count bytes of UTF-8. */
    mark(list) {
        const { doc } = this.state;
        const marks = list.filter((d) => d.line >= 1 && d.line <= doc.lines).map((d) => {
            const [from, to] = this.range(d.line, d.column);
            return { from, to, severity: d.severity === "error" ? "error" : d.severity === "warning" ? "warning" : "info", message: d.code ? `${d.message} [${d.code}]` : d.message };
        });
        marks.sort((a, b) => a.from - b.from);
        // the same ones at the same places: a view that is seen reads the selection, for which the whole page is laid out
        if (doc === this.markedIn && alike(marks, this.marks)) return;
        Object.assign(this, { marks, markedIn: doc });
        this.#dispatch(setDiagnostics(this.state, marks));
    }

    /** The word or value at a line and column, as offsets of the document. */
    range(line, column) {
        const text = this.state.doc.line(Math.min(Math.max(line, 1), this.state.doc.lines));
        let at = 0;
        for (let bytes = 1; at < text.length && bytes < (column || 1); ) {
            const code = text.text.codePointAt(at);
            bytes += code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
            at += code < 0x10000 ? 1 : 2;
        }
        const rest = text.text.slice(at);
        const word = /^(?:[\w:.-]+\s*=\s*"[^"]*"|[\w:.-]+|"[^"]*"|\S)/.exec(rest);
        const from = text.from + Math.min(at, text.length);
        return [from, Math.min(from + (word ? word[0].length : 1), text.to)];
    }

    jump(line, column) {
        const [from, to] = this.range(line, column);
        this.select(from, to);
    }

    select(from, to) {
        this.view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
        this.view.focus();
    }
}
