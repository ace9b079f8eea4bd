/* SPDX-License-Identifier: GPL-3.0-or-later */
/* libxml2 judges the syntax and hands out names and values; places come from the raw bytes. */
#include "xml/xml.h"
#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <errno.h>
#include <limits.h>
#include <pthread.h>
#include <stdbool.h>
#include <string.h>

typedef struct node { /* an element while it is being read */
    fw_xml_element element;
    size_t tag; /* byte offset of the '<' */
    int depth;  /* 0 for the root */
} node;

typedef struct reader {
    fw_arena *arena;
    const char *file;
    fw_xml_bytes xml;
    fw_diags *diags;
    xmlParserCtxtPtr parser;
    size_t body;                /* offset of what libxml2 sees */
    size_t tag_end;             /* search for the next start tag from here */
    size_t counted, line_start; /* lines are counted up to here; where the present one starts */
    int line;
    node *root, *current;
    fw_text text[FW_XML_DEPTH_MOST + 1]; /* character data so far of the open elements */
    const char *word[64];                /* names of elements and namespaces, one copy of each */
    int refused, no_memory;              /* own flags: wellFormed is not to be trusted */
} reader;

static void stop(reader *r) {
    r->refused = 1;
    xmlStopParser(r->parser);
}

static void out_of_memory(reader *r) {
    r->no_memory = 1;
    stop(r);
}

/* libxml2 does not say of every allocation that failed: it takes a namespace for no URI, or leaves out
   what it had no room for. The allocator says it in errno, which nobody sets back: it is 0 before the
   parser runs, everything of ours that runs in between looks here first, and leaves 0 behind: a
   large piece of memory that glibc finds at its second try, in another of its arenas, leaves ENOMEM there, too. */
static int parser_lacks_memory(reader *r) {
    if (errno == ENOMEM && !r->refused) out_of_memory(r);
    return r->refused;
}

static fw_place place_at(const reader *r, size_t offset) {
    return fw_xml_place_at(r->file, r->xml, offset);
}

/* places of start tags, attributes and texts come in file order, so every byte is counted only once
 */
static fw_place next_place(reader *r, size_t offset) {
    while (r->counted < offset) {
        const char *end = memchr(r->xml.data + r->counted, '\n', offset - r->counted);
        if (!end) {
            r->counted = offset;
            break;
        }
        r->counted = r->line_start = (size_t)(end - r->xml.data) + 1;
        r->line++;
    }
    return (fw_place){r->file, r->line, (int)(offset - r->line_start) + 1};
}

static size_t input_offset(const reader *r) {
    const xmlParserInput *in = r->parser->input;
    if (!in || in->cur < in->base) return r->xml.n;
    size_t offset = r->body + (size_t)in->consumed + (size_t)(in->cur - in->base);
    return offset < r->xml.n ? offset : r->xml.n;
}

/* same bytes, line ends and tabs being normalised to spaces? */
static int same_bytes(const char *raw, const char *value, size_t n) {
    for (size_t i = 0; i < n; i++)
        if (raw[i] != value[i] && !(value[i] == ' ' && strchr("\t\r\n", raw[i]) && raw[i]))
            return 0;
    return 1;
}

/* one copy of a name, as long as no other takes its slot; NULL: out of memory */
static const char *word(reader *r, const xmlChar *name) {
    const char *text = (const char *)name;
    unsigned slot = 0;
    for (const char *c = text; *c; c++)
        slot = 31 * slot + (unsigned char)*c;
    slot %= sizeof r->word / sizeof r->word[0];
    if (!r->word[slot] || strcmp(r->word[slot], text) != 0)
        r->word[slot] = fw_arena_strdup(r->arena, text);
    return r->word[slot];
}

/* names and values of one element in one block; the five pointers of libxml2 per attribute are
   local name, prefix, namespace, value and its end */
static int copy_attributes(reader *r, fw_xml_element *e, int count, const xmlChar **given) {
    size_t bytes = 0;
    if (count == 0) return 1;
    for (int i = 0; i < count; i++) {
        const xmlChar *const *g = given + (ptrdiff_t)5 * i;
        bytes += strlen((const char *)g[0]) + (g[1] ? strlen((const char *)g[1]) + 1 : 0) + 1;
        bytes += (size_t)(g[4] - g[3]) + 1;
    }
    char *to = fw_arena_alloc(r->arena, bytes, 1);
    e->attribute = fw_arena_array(r->arena, fw_xml_attribute, (size_t)count);
    if (!to || !e->attribute) return 0;
    for (int i = 0; i < count; i++) {
        const xmlChar *const *g = given + (ptrdiff_t)5 * i;
        e->attribute[i].name = to;
        if (g[1]) {
            to = stpcpy(to, (const char *)g[1]);
            *to++ = ':';
        }
        to = stpcpy(to, (const char *)g[0]) + 1;
        e->attribute[i].value = to;
        memcpy(to, g[3], (size_t)(g[4] - g[3]));
        /* a value is one line, as XML makes it of those that are broken, also where a break was given by its number: it
           comes into lines of tables, order sheets and drawings */
        for (char *c = to; *c; c++)
            if (*c == '\n' || *c == '\r' || *c == '\t') *c = ' ';
        to += g[4] - g[3] + 1;
        e->attribute[i].place = e->attribute[i].name_place = e->place;
    }
    e->nattribute = count;
    return 1;
}

static int read_attributes(reader *r, node *n, int count, const xmlChar **given) {
    fw_xml_element *e = &n->element;
    if (!copy_attributes(r, e, count, given)) return 0;
    /* walk through the tag's own bytes: attributes and declarations in file order */
    fw_xml_raw_attribute raw;
    size_t at = n->tag + 1;
    while (at < r->xml.n && !strchr(" \t\r\n/>", r->xml.data[at]))
        at++;
    for (; fw_xml_next_attribute(r->xml, at, &raw); at = raw.value + raw.value_length + 1) {
        fw_place name_place = next_place(r, raw.name), value_place = next_place(r, raw.value);
        for (int i = 0; i < count; i++) {
            fw_xml_attribute *a = &e->attribute[i];
            if (strlen(a->name) != raw.name_length ||
                memcmp(a->name, r->xml.data + raw.name, raw.name_length) != 0)
                continue;
            a->name_place = name_place;
            a->place = value_place;
            a->value_offset = raw.value;
            a->raw = r->xml.data + raw.value;
            a->raw_length = raw.value_length;
            a->exact = strlen(a->value) == raw.value_length &&
                       same_bytes(a->raw, a->value, raw.value_length);
        }
    }
    r->tag_end = at;
    return 1;
}

static void begin_node(reader *r, const xmlChar *name, const xmlChar *space, int nattributes,
                       const xmlChar **attributes) {
    node *n = fw_arena_one(r->arena, node);
    if (!n) {
        out_of_memory(r);
        return;
    }
    n->tag = fw_xml_next_tag(r->xml, r->tag_end);
    n->depth = r->current ? r->current->depth + 1 : 0;
    if (n->depth > FW_XML_DEPTH_MOST) { /* the guard has refused it before */
        stop(r);
        return;
    }
    r->text[n->depth].arena = r->arena;
    r->text[n->depth].length = 0;
    fw_xml_element *e = &n->element;
    e->place = next_place(r, n->tag);
    e->offset = n->tag;
    e->text_place = e->place;
    e->text = "";
    e->name = word(r, name);
    e->space = space ? word(r, space) : "";
    if (!e->name || !e->space || !read_attributes(r, n, nattributes, attributes)) {
        out_of_memory(r);
        return;
    }
    fw_xml_element *parent = r->current ? &r->current->element : NULL;
    e->parent = parent;
    if (!parent)
        r->root = n;
    else if (parent->last_child)
        parent->last_child = parent->last_child->next = e;
    else
        parent->first_child = parent->last_child = e;
    r->current = n;
}

static void start_element(void *context, const xmlChar *name, const xmlChar *prefix,
                          const xmlChar *space, int nspaces, const xmlChar **spaces,
                          int nattributes, int ndefaulted, const xmlChar **attributes) {
    (void)prefix, (void)nspaces, (void)spaces, (void)ndefaulted;
    if (parser_lacks_memory(context)) return;
    begin_node(context, name, space, nattributes, attributes);
    errno = 0;
}

static void end_node(reader *r) {
    node *n = r->current;
    fw_text *t = &r->text[n->depth];
    while (t->length > 0 && strchr(" \t\r\n", t->data[t->length - 1]))
        t->length--;
    if (t->length > 0) n->element.text = fw_arena_strndup(r->arena, t->data, t->length);
    if (t->failed || !n->element.text) {
        out_of_memory(r);
        return;
    }
    r->current = (node *)n->element.parent; /* element is the first member */
}

static void end_element(void *context, const xmlChar *name, const xmlChar *prefix,
                        const xmlChar *space) {
    reader *r = context;
    (void)name, (void)prefix, (void)space;
    if (parser_lacks_memory(r) || !r->current) return;
    end_node(r);
    errno = 0;
}

static void add_text(reader *r, const xmlChar *text, int length) {
    const char *s = (const char *)text;
    size_t n = (size_t)length, skip = 0;
    if (r->text[r->current->depth].length == 0) {
        while (skip < n && strchr(" \t\r\n", s[skip]) && s[skip])
            skip++;
        if (skip == n) return;
        const xmlParserInput *in = r->parser->input;
        size_t offset = input_offset(r);
        if (text >= in->base && text < in->end)
            offset = r->body + (size_t)in->consumed + (size_t)(text - in->base) + skip;
        /* texts and tags come in file order; anything else keeps the element's place */
        if (offset >= r->line_start) r->current->element.text_place = next_place(r, offset);
    }
    fw_text_bytes(&r->text[r->current->depth], s + skip, n - skip);
}

static void characters(void *context, const xmlChar *text, int length) {
    reader *r = context;
    if (parser_lacks_memory(r) || !r->current || length <= 0) return;
    add_text(r, text, length);
    errno = 0;
}

/* the guard has refused these before; should it ever miss one, this stops the reading */
static void refuse_doctype(void *context, const xmlChar *name, const xmlChar *external,
                           const xmlChar *system) {
    reader *r = context;
    (void)name, (void)external, (void)system;
    fw_diag_error(r->diags, 4, place_at(r, input_offset(r)), "DOCTYPE is refused; remove it");
    stop(r);
}

static void refuse_instruction(void *context, const xmlChar *target, const xmlChar *data) {
    reader *r = context;
    (void)target, (void)data;
    fw_diag_error(r->diags, 6, place_at(r, input_offset(r)),
                  "processing instructions are refused; remove it");
    stop(r);
}

/* an end tag that does not fit: either the innermost element was never closed, or the tag is wrong
 */
static void report_mismatch(reader *r, const char *found) {
    const fw_xml_element *open = &r->current->element, *outer = open->parent;
    /* libxml2 stands behind the name of the end tag */
    size_t end = input_offset(r);
    while (end > 0 && r->xml.data[end] != '<')
        end--;
    fw_place end_place = place_at(r, end);
    for (; outer; outer = outer->parent)
        if (strcmp(outer->name, found) == 0) break;
    if (outer) {
        fw_diag_error(r->diags, 12, open->place,
                      "<%s> is never closed: </%s> follows instead of </%s>; end it with '/>' or "
                      "</%s>",
                      open->name, found, open->name, open->name);
        fw_diag_note(r->diags, 12, end_place, "</%s> stands here", found);
        return;
    }
    const fw_xml_element *closed = NULL;
    for (const fw_xml_element *e = open->first_child; e; e = e->next)
        if (strcmp(e->name, found) == 0 && !e->first_child) closed = e;
    fw_diag_error(r->diags, 12, end_place, "</%s> closes nothing: <%s> is open; write </%s>", found,
                  open->name, open->name);
    fw_diag_note(r->diags, 12, closed ? closed->place : open->place, "<%s> was %s here",
                 closed ? found : open->name, closed ? "opened and closed" : "opened");
}

static const char *advice(int code) {
    switch (code) {
    case XML_ERR_ATTRIBUTE_NOT_STARTED:
        return "a value must stand in quotes: name=\"value\"";
    case XML_ERR_ATTRIBUTE_NOT_FINISHED:
        return "the closing quote of this value is missing";
    case XML_ERR_ATTRIBUTE_WITHOUT_VALUE:
        return "an attribute needs a value: name=\"value\"";
    case XML_ERR_LT_IN_ATTRIBUTE:
        return "'<' inside a value; close the quote or write &lt;";
    case XML_ERR_SPACE_REQUIRED:
        return "a space is missing between attributes, or a quote is missing before or behind here";
    case XML_ERR_GT_REQUIRED:
        return "the tag is not complete; '>' is missing, or a quote before it";
    case XML_ERR_LTSLASH_REQUIRED:
        return "an end tag </...> is missing here";
    case XML_ERR_NAME_REQUIRED:
        return "a name must follow '<'; write &lt; for the character";
    case XML_ERR_DOCUMENT_END:
        return "nothing may follow the end of the first element; a file has one <device>";
    case XML_ERR_INVALID_CHARREF:
    case XML_ERR_INVALID_HEX_CHARREF:
    case XML_ERR_INVALID_DEC_CHARREF:
    case XML_ERR_INVALID_CHAR:
        return "this character or character reference is not allowed in XML";
    case XML_ERR_MISPLACED_CDATA_END:
        return "']]>' may not stand in text; write ]]&gt;";
    case XML_ERR_COMMENT_NOT_FINISHED:
        return "a comment is never closed; end it with '-->'";
    case XML_ERR_CDATA_NOT_FINISHED:
        return "a CDATA section is never closed; end it with ']]>'";
    default:
        return NULL;
    }
}

static void report_unclosed(reader *r) {
    const fw_xml_element *open = &r->current->element;
    fw_diag_error(r->diags, 12, open->place, "<%s> is never closed: the file ends first; add </%s>",
                  open->name, open->name);
}

static void structured_error(void *context, xmlErrorPtr error) {
    reader *r = context;
    if (parser_lacks_memory(r) || error->level < XML_ERR_ERROR) return;
    if (error->code == XML_ERR_NO_MEMORY) {
        out_of_memory(r);
        return;
    }
    size_t offset = input_offset(r);
    fw_place place = place_at(r, offset);
    const char *help = advice(error->code);
    if (error->code == XML_ERR_TAG_NAME_MISMATCH && r->current && error->str2)
        report_mismatch(r, error->str2);
    else if (r->current && (error->code == XML_ERR_TAG_NOT_FINISHED ||
                            (error->code == XML_ERR_LTSLASH_REQUIRED && offset == r->xml.n)))
        report_unclosed(r);
    else if (error->code == XML_ERR_DOCUMENT_EMPTY)
        fw_diag_error(r->diags, 14, place,
                      "no element found; a description begins with <device "
                      "xmlns=\"urn:flexwright:device:1\" name=\"...\">");
    else if (help)
        fw_diag_error(r->diags, 11, place, "%s", help);
    else {
        const char *own = error->message ? error->message : "not XML";
        int length = (int)strcspn(own, "\n");
        fw_diag_error(r->diags, 11, place, "not well-formed XML: %.*s", length < 200 ? length : 200,
                      own);
    }
    stop(r);
}

/* libxml2 would print it */
static void say_nothing(void *context, xmlErrorPtr error) {
    (void)context, (void)error;
}

/* once for the process: designs are read in parallel */
static void begin_library(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, xmlInitParser);
}

static fw_status parse(reader *r) {
    const char *start = r->xml.data + r->body;
    size_t n = r->xml.n - r->body;
    if (n > INT_MAX) return FW_LIMIT;
    begin_library();
    errno = 0;
    r->parser = xmlCreateMemoryParserCtxt(start, (int)n);
    FW_NEED(r->parser);
    xmlSAXHandler sax = {.initialized = XML_SAX2_MAGIC,
                         .startElementNs = start_element,
                         .endElementNs = end_element,
                         .characters = characters,
                         .ignorableWhitespace = characters,
                         .cdataBlock = characters,
                         .internalSubset = refuse_doctype,
                         .processingInstruction = refuse_instruction,
                         .serror = structured_error};
    *r->parser->sax = sax;
    r->parser->userData = r;
    /* NOENT: values have '&' where the file has &amp;, not libxml2's own "&#38;"; there are no other
       entities, the guard and refuse_doctype see to that */
    xmlCtxtUseOptions(r->parser, XML_PARSE_NONET | XML_PARSE_BIG_LINES | XML_PARSE_NOENT);
    xmlStructuredErrorFunc before = xmlStructuredError;
    void *of_before = xmlStructuredErrorContext;
    xmlSetStructuredErrorFunc(NULL, say_nothing); /* of this thread: what has no parser at hand */
    xmlParseDocument(r->parser);
    parser_lacks_memory(r);
    xmlSetStructuredErrorFunc(of_before, before);
    if (r->parser->myDoc) xmlFreeDoc(r->parser->myDoc);
    r->parser->myDoc = NULL;
    int sound = r->parser->wellFormed;
    xmlFreeParserCtxt(r->parser);
    r->parser = NULL;
    if (r->no_memory) return FW_NOMEM;
    if (r->refused) return r->diags->failed ? FW_NOMEM : FW_INPUT;
    if (!sound || !r->root || r->current)
        return fw_diag_error(r->diags, 11, (fw_place){r->file, 1, 1},
                             "the file is not well-formed XML; check it with 'xmllint'");
    return FW_OK;
}

fw_status fw_xml_read(fw_arena *arena, const char *file, const char *xml, size_t n, fw_diags *diags,
                      fw_xml_element **root) {
    *root = NULL;
    reader r = {.arena = arena, .file = file, .xml = {xml, n}, .diags = diags, .line = 1};
    FW_TRY(fw_xml_guard(file, r.xml, diags, &r.body));
    FW_NEED(r.xml.data = fw_arena_strndup(arena, xml, n));
    r.tag_end = r.body;
    FW_TRY(parse(&r));
    *root = &r.root->element;
    return FW_OK;
}

const fw_xml_attribute *fw_xml_attribute_of(const fw_xml_element *element, const char *name) {
    for (int i = 0; i < element->nattribute; i++)
        if (strcmp(element->attribute[i].name, name) == 0) return &element->attribute[i];
    return NULL;
}

fw_place fw_xml_inside(const fw_xml_attribute *attribute, size_t offset) {
    fw_place place = attribute->place;
    if (!attribute->exact) return place;
    if (offset > attribute->raw_length) offset = attribute->raw_length;
    for (size_t i = 0; i < offset; i++) {
        place.column++;
        if (attribute->raw[i] == '\n') {
            place.line++;
            place.column = 1;
        }
    }
    return place;
}

/* ---- any document as a tree ---- */

typedef struct grower {
    fw_arena *arena;
    xmlParserCtxtPtr parser;
    fw_xml_node *root, *current;
    fw_text text; /* of the text that is being read */
    int line;     /* of the first refusal; 0: none */
    bool no_memory;
} grower;

static void refuse(grower *g) {
    if (g->line == 0) g->line = g->parser->input ? g->parser->input->line : 1;
    xmlStopParser(g->parser);
}

/* as parser_lacks_memory */
static bool goes_on(grower *g) {
    if (errno == ENOMEM) g->no_memory = true;
    errno = 0;
    if (g->no_memory) xmlStopParser(g->parser);
    return !g->no_memory && g->line == 0;
}

static fw_xml_node *grown(grower *g) {
    fw_xml_node *n = fw_arena_one(g->arena, fw_xml_node);
    if (!n) {
        g->no_memory = true;
        return NULL;
    }
    n->parent = g->current;
    if (!g->current)
        g->root = n;
    else if (g->current->last)
        g->current->last = g->current->last->next = n;
    else
        g->current->first = g->current->last = n;
    return n;
}

static void end_text(grower *g) {
    if (g->text.failed) g->no_memory = true;
    if (g->text.length == 0 || g->no_memory || !g->current) return;
    fw_xml_node *n = grown(g);
    if (n) n->text = fw_arena_strndup(g->arena, g->text.data, g->text.length);
    if (!n || !n->text) g->no_memory = true;
    g->text.length = 0;
}

static void grow_element(void *context, const xmlChar *name, const xmlChar *prefix,
                         const xmlChar *space, int nspaces, const xmlChar **spaces, int count,
                         int ndefaulted, const xmlChar **given) {
    grower *g = context;
    (void)prefix, (void)space, (void)nspaces, (void)spaces, (void)ndefaulted;
    if (!goes_on(g)) return;
    end_text(g);
    fw_xml_node *n = grown(g);
    const char **a = fw_arena_array(g->arena, const char *, 2 * (size_t)count + 1);
    if (n) n->name = fw_arena_strdup(g->arena, (const char *)name);
    bool room = n && n->name && a;
    for (int i = 0; room && i < count; i++) {
        const xmlChar *const *own = given + (ptrdiff_t)5 * i;
        a[2 * i] = fw_arena_strdup(g->arena, (const char *)own[0]);
        a[2 * i + 1] = fw_arena_strndup(g->arena, (const char *)own[3], (size_t)(own[4] - own[3]));
        room = a[2 * i] && a[2 * i + 1];
    }
    g->no_memory |= !room;
    if (room) n->attribute = a, g->current = n;
    errno = 0;
}

static void end_grown(void *context, const xmlChar *name, const xmlChar *prefix,
                      const xmlChar *space) {
    grower *g = context;
    (void)name, (void)prefix, (void)space;
    if (!goes_on(g) || !g->current) return;
    end_text(g);
    g->current = g->current->parent;
    errno = 0;
}

static void grow_text(void *context, const xmlChar *text, int length) {
    grower *g = context;
    if (!goes_on(g) || length <= 0) return;
    fw_text_bytes(&g->text, text, (size_t)length);
    errno = 0;
}

static void refuse_subset(void *context, const xmlChar *name, const xmlChar *external,
                          const xmlChar *system) {
    (void)name, (void)external, (void)system;
    refuse(context);
}

static void refuse_error(void *context, xmlErrorPtr error) {
    grower *g = context;
    if (error->code == XML_ERR_NO_MEMORY) g->no_memory = true;
    if (error->level >= XML_ERR_ERROR && goes_on(g)) refuse(g);
}

fw_status fw_xml_tree(fw_arena *arena, const char *xml, size_t n, fw_xml_node **root, int *line) {
    grower g = {.arena = arena, .text = fw_text_new(arena)};
    *root = NULL;
    *line = 1;
    if (n == 0) return FW_INPUT; /* the parser takes it for a lack of memory */
    if (n > INT_MAX) return FW_LIMIT;
    begin_library();
    errno = 0;
    FW_NEED(g.parser = xmlCreateMemoryParserCtxt(xml, (int)n));
    xmlSAXHandler sax = {.initialized = XML_SAX2_MAGIC,
                         .startElementNs = grow_element,
                         .endElementNs = end_grown,
                         .characters = grow_text,
                         .ignorableWhitespace = grow_text,
                         .cdataBlock = grow_text,
                         .internalSubset = refuse_subset,
                         .serror = refuse_error};
    *g.parser->sax = sax;
    g.parser->userData = &g;
    /* NOENT: as above. HUGE: paths and files are longer than what libxml2 takes otherwise */
    xmlCtxtUseOptions(g.parser, XML_PARSE_NONET | XML_PARSE_NOENT | XML_PARSE_HUGE);
    xmlStructuredErrorFunc before = xmlStructuredError;
    void *of_before = xmlStructuredErrorContext;
    xmlSetStructuredErrorFunc(NULL, say_nothing);
    xmlParseDocument(g.parser);
    goes_on(&g);
    xmlSetStructuredErrorFunc(of_before, before);
    if (!g.parser->wellFormed && g.line == 0) refuse(&g);
    if (g.parser->myDoc) xmlFreeDoc(g.parser->myDoc);
    g.parser->myDoc = NULL;
    xmlFreeParserCtxt(g.parser);
    if (g.no_memory) return FW_NOMEM;
    *line = g.line;
    *root = g.root;
    return g.line != 0 || !g.root ? FW_INPUT : FW_OK;
}

const char *fw_xml_node_value(const fw_xml_node *of, const char *name) {
    for (const char **a = of->attribute; a && *a; a += 2)
        if (strcmp(a[0], name) == 0) return a[1];
    return NULL;
}
