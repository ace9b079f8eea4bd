/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page: its style sheet, its player, its messages and the whole of it. */
#include "report/figure.h"
#include "report/report_page.h"
#include <string.h>

/* style sheet of the page */
static const char style_sheet[] =
    ":root{color-scheme:light;--ink:#1f2328;--soft:#57606a;--line:#d8dee4;--pale:#f6f8fa}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0;background:#fff;color:var(--ink);font:15px/1.5 system-ui,-apple-system,"
    "'Segoe UI','Noto Sans','DejaVu Sans',sans-serif}\n"
    "main,header .in,nav .in,footer{max-width:1120px;margin:0 auto;padding:0 24px}\n"
    "header{color:#fff;padding:26px 0 24px}\n"
    "header h1{margin:0;font-size:15px;font-weight:500;opacity:.92}\n"
    "header .word{font-size:44px;line-height:1.15;font-weight:750;letter-spacing:.02em;margin:2px "
    "0}\n"
    "header .why{font-size:17px;max-width:62em;margin:4px 0 0}\n"
    "header dl{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:10px 22px;"
    "margin:18px 0 0}\n"
    "header dt{font-size:12px;opacity:.85}\n"
    "header dd{margin:0;font-size:16px;font-weight:600;overflow-wrap:anywhere}\n"
    "nav{position:sticky;top:0;z-index:2;background:#ffffffee;border-bottom:1px solid "
    "var(--line)}\n"
    "nav .in{display:flex;flex-wrap:wrap;gap:2px 16px;padding-top:7px;padding-bottom:7px}\n"
    "nav a{color:var(--soft);text-decoration:none;font-size:13px}\n"
    "nav a:hover,nav a:focus{color:var(--ink);text-decoration:underline}\n"
    "section{padding:26px 0 6px;scroll-margin-top:34px}\n"
    "h2{font-size:22px;line-height:1.3;margin:0 0 10px}\n"
    "summary{cursor:pointer;color:var(--soft)}\n"
    "summary h2,summary h3{display:inline;color:var(--ink)}\n"
    "details details{margin:20px 0 6px}\n"
    "details[open]>summary{margin-bottom:10px}\n"
    "nav button{font:inherit;font-size:13px;border:0;padding:0;background:none;color:var(--soft);"
    "cursor:pointer;margin-left:auto}\n"
    "nav button[hidden]{display:none}\n"
    "h3{font-size:16px;margin:20px 0 6px}\n"
    "p{margin:6px 0 10px;max-width:72em}\n"
    ".soft{color:var(--soft)}\n"
    ".small{font-size:13px}\n"
    ".two{display:grid;grid-template-columns:minmax(0,3fr) "
    "minmax(0,2fr);gap:28px;align-items:start}\n"
    ".two h3:first-child{margin-top:0}\n"
    ".advice{border-left:4px solid #0072B2;background:var(--pale);padding:10px 16px;margin:24px 0 "
    "0}\n"
    ".advice h2{font-size:16px;margin:0 0 4px}\n"
    ".advice ul,.advice ol,.plain{margin:4px 0;padding-left:20px}\n"
    ".plain li{margin:3px 0}\n"
    "table{border-collapse:collapse;width:100%;margin:6px 0 16px;font-size:13.5px;"
    "font-variant-numeric:tabular-nums}\n"
    "caption{text-align:left;color:var(--soft);padding:0 0 5px;font-size:13px}\n"
    "th,td{padding:5px 12px 5px 0;text-align:left;vertical-align:top;"
    "border-bottom:1px solid var(--line);overflow-wrap:break-word}\n"
    "thead th{border-bottom:2px solid #afb8c1;font-weight:600;font-size:12.5px;color:var(--soft);"
    "overflow-wrap:normal}\n"
    "th.n,td.n{text-align:right;white-space:nowrap}\n"
    ".tight table{font-size:12.5px}.tight th,.tight td{padding-right:9px}\n"
    "tbody th{font-weight:600}\n"
    "th.id{white-space:nowrap}\n"
    "th .soft{font-weight:400}\n"
    "td.step,th.step{min-width:15em}\n"
    "tr.bad td,tr.bad th{background:#fdf1ea}\n"
    ".wide{overflow-x:auto}\n"
    "svg{display:block;max-width:100%;height:auto}\n"
    "svg.bar{display:inline-block;vertical-align:middle;min-width:100px;max-width:110px}\n"
    ".drawing,.stage{width:100%;border:1px solid var(--line);border-radius:4px;background:#fff}\n"
    ".motion{margin:0 0 26px}\n"
    ".pairs{display:flex;flex-wrap:wrap;gap:24px;margin:8px 0 12px}\n"
    ".pair{margin:0;max-width:360px;font-size:13px;color:var(--soft)}\n"
    ".pair svg{border:1px solid var(--line);border-radius:4px;margin:0 0 6px}\n"
    ".motion .both{display:grid;grid-template-columns:minmax(0,11fr) minmax(0,13fr);gap:20px;"
    "align-items:start}\n"
    ".plots{width:100%}\n"
    ".controls{display:flex;gap:12px;align-items:center;padding:8px 0;font-size:13px}\n"
    ".controls[hidden]{display:none}\n"
    ".controls .time{flex:1;accent-color:#0072B2}\n"
    ".controls .now{min-width:5.6em;text-align:right;font-variant-numeric:tabular-nums}\n"
    ".controls button,.controls select{font:inherit;padding:2px 10px;border:1px solid #afb8c1;"
    "border-radius:4px;background:#fff;color:var(--ink)}\n"
    ".controls button{min-width:5.4em}\n"
    ".tag{display:inline-block;font-size:12px;font-weight:600;padding:0 8px;border-radius:9px;"
    "color:#fff;white-space:nowrap}\n"
    ".no{color:#B03A00;font-weight:600}\n"
    ".swatch{display:inline-block;width:12px;height:12px;border-radius:2px;margin-right:7px;"
    "vertical-align:-1px}\n"
    "code{font:12.5px/1.4 ui-monospace,'DejaVu Sans Mono',monospace;background:var(--pale);"
    "padding:1px 4px;border-radius:3px;overflow-wrap:anywhere}\n"
    "footer{padding-top:20px;padding-bottom:40px;color:var(--soft);font-size:12.5px}\n"
    "footer p{border-top:1px solid var(--line);padding-top:12px;max-width:none}\n"
    "@media screen and (max-width:800px){.two,.motion .both{grid-template-columns:minmax(0,1fr)}}\n"
    "@media print{@page{margin:14mm}body{font-size:10.5pt}nav,.controls,.cursor,.readout"
    "{display:none!important}"
    "header{color:#000!important;background:none!important;border-bottom:3px solid #000;padding:0 "
    "0 8px}"
    "main,header .in,footer{max-width:none;padding:0}"
    "section{padding:12px 0 0}h2,h3,summary,caption{break-after:avoid}"
    "tr,dl,figure,svg,.advice{break-inside:avoid}thead{display:table-header-group}"
    ".wide{overflow:visible}"
    "table,.tight table{font-size:8pt}th,td,.tight th,.tight td{padding:3px 6px 3px 0}"
    "thead th{font-size:7.5pt}"
    "th.n,td.n,th.id{white-space:normal}svg.bar{min-width:60px;max-width:80px}"
    "td.step,th.step{min-width:9em}"
    ".two{grid-template-columns:minmax(0,3fr) minmax(min-content,2fr);gap:16px}"
    "*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}\n";

/* The player: body poses between frames, flexures bent as in film.c, cursors in the plots. Neither
   '<' nor '&' occurs, so that the page is well-formed XML too. */

/* its player */
static const char player_script[] =
    "(function(){'use strict';\n"
    "var RAD=Math.PI/180,CLASS=[[0.5,'#0072B2'],[0.8,'#009E73'],[1,'#E69F00'],[1/0,'#D55E00']];\n"
    "function all(root,what){return Array.prototype.slice.call(root.querySelectorAll(what));}\n"
    "function colour(u){var i=0;while(3>i){if(CLASS[i][0]>u)break;i++;}return CLASS[i][1];}\n"
    "function time(t,end){return end>=2?t.toFixed(3)+' s':end>=2e-3?(t*1e3).toFixed(3)+' ms':"
    "(t*1e6).toFixed(2)+' \u00b5s';}\n"
    "function motion(fig){\n"
    "var data=fig.querySelector('script');if(!data)return;\n"
    "var d=JSON.parse(data.textContent),n=d.t.length,end=d.t[n-1],nb=d.b.length;\n"
    "var bodies=all(fig,'.body'),flex=all(fig,'.flexure'),forces=all(fig,'.force');\n"
    "var panels=all(fig,'.panel'),range=fig.querySelector('.time'),now=fig.querySelector('.now');\n"
    "var play=fig.querySelector('.play'),speed=fig.querySelector('.speed');\n"
    "var t=d.at,running=false,last=0,q=new Array(3*nb);\n"
    "function pose(){var f=end>0?t/end*(n-1):0,i=Math.max(0,Math.min(n-2,Math.floor(f))),u=f-i;\n"
    "for(var k=0;3*nb>k;k++){var a=d.q[3*nb*i+k];q[k]=a+u*(d.q[3*nb*(i+1)+k]-a);}}\n"
    "function turn(b){return 0>b?0:q[3*b+2]-d.b[b][2];}\n"
    "function moved(b,x,y){if(0>b)return[x,y];var r=turn(b)*RAD,c=Math.cos(r),s=Math.sin(r);\n"
    "x-=d.b[b][0];y-=d.b[b][1];return[q[3*b]+c*x+s*y,q[3*b+1]-s*x+c*y];}\n"
    "function phi(b){return 0>b?0:q[3*b+2];}\n"
    "function angle(k){var p=d.p[k];return phi(p[1])-phi(p[0])-p[2];}\n"
    "function bend(f){var w=moved(f[1],f[3],f[4]),a=turn(f[1]),b=turn(f[2]),p=f[5],o='';\n"
    "for(var i=0;p.length>i;i+=3){var r=(a+p[i+2]*(b-a))*RAD,c=Math.cos(r),s=Math.sin(r);\n"
    "var x=p[i]-f[3],y=p[i+1]-f[4];\n"
    "o+=(i?'L':'M')+(w[0]+c*x+s*y).toFixed(2)+' '+(w[1]-s*x+c*y).toFixed(2);}return o+'Z';}\n"
    "function show(cursor){pose();\n"
    "bodies.forEach(function(g){var b=+g.getAttribute('data-body');\n"
    "g.setAttribute('transform','translate('+q[3*b]+' '+q[3*b+1]+') rotate('+(-turn(b))+"
    "') translate('+(-d.b[b][0])+' '+(-d.b[b][1])+')');});\n"
    "flex.forEach(function(e,i){var f=d.f[i],l=d.p[f[0]][3];e.setAttribute('d',bend(f));\n"
    "if(l>0){var c=colour(Math.abs(angle(f[0]))/l);e.setAttribute('fill',c);"
    "e.setAttribute('stroke',c);}});\n"
    "forces.forEach(function(g){var a=d.a[+g.getAttribute('data-force')],r=phi(a[0])*RAD;\n"
    "var c=Math.cos(r),s=Math.sin(r),b=a[0];g.setAttribute('transform','translate('+"
    "(q[3*b]+c*a[1]-s*a[2])+' '+(q[3*b+1]-s*a[1]-c*a[2])+')');});\n"
    "panels.forEach(function(g){var "
    "line=g.querySelector('.cursor'),text=g.querySelector('.readout');\n"
    "if(!cursor){line.setAttribute('visibility','hidden');text.textContent='';return;}\n"
    "var x=+g.getAttribute('data-x')+ +g.getAttribute('data-w')*(end>0?t/end:0);\n"
    "line.setAttribute('transform','translate('+x+' "
    "0)');line.setAttribute('visibility','visible');\n"
    "text.textContent=' '+angle(+g.getAttribute('data-pin')).toFixed(3)+'\u00b0';});\n"
    "range.value=end>0?1000*t/end:0;now.textContent=time(t,end);\n"
    "range.setAttribute('aria-valuetext',now.textContent);}\n"
    "function set(v){t=Math.max(0,Math.min(end,v));show(true);}\n"
    "function frame(stamp){if(!running)return;\n"
    "set(t+(last?(stamp-last)*1e-3:0)*end/8*+speed.value);last=stamp;\n"
    "if(t>=end)stop();else requestAnimationFrame(frame);}\n"
    "function stop(){running=false;play.textContent='Play';}\n"
    "play.addEventListener('click',function(){if(running){stop();return;}\n"
    "if(t>=end)t=0;running=true;last=0;play.textContent='Pause';requestAnimationFrame(frame);});\n"
    "range.addEventListener('input',function(){stop();set(end*range.value/1000);});\n"
    "var plots=fig.querySelector('.plots');\n"
    "function pick(e){var m=plots.getScreenCTM();if(!m)return;\n"
    "var p=new DOMPoint(e.clientX,e.clientY).matrixTransform(m.inverse());\n"
    "panels.forEach(function(g){var r=g.getBBox(),x=+g.getAttribute('data-x'),"
    "w=+g.getAttribute('data-w');\n"
    "if(p.x>=x)if(x+w>=p.x)if(p.y>=r.y)if(r.y+r.height>=p.y){stop();set(end*(p.x-x)/w);}});}\n"
    "plots.addEventListener('pointerdown',pick);\n"
    "plots.addEventListener('pointermove',function(e){if(e.buttons)pick(e);});\n"
    "addEventListener('beforeprint',function(){stop();t=d.at;show(false);});\n"
    "fig.querySelector('.controls').hidden=false;show(false);}\n"
    "all(document,'.motion').forEach(motion);\n"
    "var parts=all(document,'main details'),each=document.querySelector('.each');\n"
    "function reveal(){var e=document.getElementById(location.hash.slice(1));\n"
    "var part=e?e.querySelector('details'):null;if(part)part.open=true;}\n"
    "function shut(part){return !part.open;}\n"
    "function name(){each.textContent=parts.some(shut)?'Open all':'Close all';}\n"
    "each.addEventListener('click',function(){var open=parts.some(shut);\n"
    "parts.forEach(function(part){part.open=open;});});\n"
    "parts.forEach(function(part){part.addEventListener('toggle',name);});\n"
    "all(document,'nav a').forEach(function(a){a.addEventListener('click',"
    "function(){setTimeout(reveal,0);});});\n"
    "addEventListener('hashchange',reveal);each.hidden=false;name();reveal();\n"
    "})();\n";

/* the path of a --set is no file path; the rest as fw_place_file */
static const char *file_of(fw_place place) {
    bool option = place.file && strncmp(place.file, "--set", 5) == 0;
    return option ? place.file : fw_place_file(place);
}

static fw_status messages_section(fw_report_page *page) {
    static const char *const word[] = {"note", "warning", "error"};
    const fw_diags *diags = page->in->diags;
    fw_text *out = page->out;
    if (!diags || diags->count == 0) {
        fw_text_add(out, "<p>No warnings.</p>\n");
        return fw_text_end(out);
    }
    fw_text_add(out,
                "<div class=\"wide\"><table><thead><tr><th scope=\"col\">Kind</th><th "
                "scope=\"col\">Place</th><th scope=\"col\">Message</th><th scope=\"col\">Code</th>"
                "</tr></thead><tbody>\n");
    for (size_t i = 0; i < diags->count; i++) {
        const fw_diag *d = &diags->item[i];
        if (d->number == 230)
            continue; /* how the program was called is no property of the device */
        fw_markup(out, "<tr><td>{r}</td><td>{s}", word[d->severity], file_of(d->place));
        if (d->place.line > 0) fw_markup(out, ":{i}:{i}", d->place.line, d->place.column);
        fw_markup(out, "</td><td>{s}</td><td>", d->message);
        fw_text_printf(out, "FW-D%03d</td></tr>\n", d->number);
    }
    fw_text_add(out, "</tbody></table></div>\n");
    if (diags->dropped) fw_markup(out, "<p>{l} more are not shown.</p>\n", (long)diags->dropped);
    return fw_text_end(out);
}

/* The page is HTML and well-formed XML at once, needs no network (its content policy forbids it)
   and reads without script. */

/* what answers on the first page: the others are opened by who wants to know more, and printed when they are open */
enum { OPEN_SECTIONS = 2 };
static const struct {
    const char *id, *title;
    fw_status (*write)(fw_report_page *page);
    bool (*there)(const fw_report_page *page); /* NULL: always */
} sections[] = {
    {"device", "Device", fw_report_section_device, NULL},
    {"hinges", "Hinges", fw_report_section_hinges, NULL},
    {"clearance", "Clearance", fw_report_section_clearance, NULL},
    {"across", "Out of the plane", fw_report_section_out_of_plane, fw_report_has_out_of_plane},
    {"drying", "Drying", fw_report_section_stiction, fw_report_has_stiction},
    {"made", "As fabricated", fw_report_section_fabricated, NULL},
    {"measurements", "Measurements", fw_report_section_measurements, fw_report_has_measurements},
    {"requirements", "Requirements", fw_report_section_requirements, fw_report_has_requirements},
    {"motion", "Motion", fw_report_section_motion, NULL},
    {"workspace", "Workspace", fw_report_section_workspace, NULL},
    {"flows", "Flows", fw_report_section_flows, NULL},
    {"masks", "Masks", fw_report_section_masks, NULL},
    {"recipes", "Recipes", fw_report_section_recipes, NULL},
    {"effects", "Effects", fw_report_section_effects, NULL},
    {"accuracy", "Accuracy", fw_report_section_accuracy, NULL},
    {"assumptions", "Assumptions", fw_report_section_assumptions, NULL},
    {"messages", "Messages", messages_section, NULL},
};

enum { SECTIONS = sizeof sections / sizeof sections[0], DRAWING_WIDTH = 640 };

static bool is_there(const fw_report_page *page, int i) {
    return !sections[i].there || sections[i].there(page);
}

/* its title says what the terminal says first */
static fw_status head(fw_report_page *page) {
    fw_report_summary top;
    FW_TRY(fw_report_summarise(page->out->arena, page->in, &top));
    fw_markup(page->out,
              "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n"
              "<head>\n<meta charset=\"utf-8\"/>\n"
              "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
              "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
              "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\"/>\n"
              "<meta name=\"generator\" content=\"Flexwright {s}\"/>\n"
              "<title>{s}: {r}{r}{s}</title>\n<style>\n{r}</style>\n</head>\n<body>\n",
              page->in->version, page->in->device->name,
              fw_report_decision_word(page->in->verdict->decision),
              top.unmade ? ", but cannot be made in " : "", top.unmade ? top.unmade : "",
              style_sheet);
    return FW_OK;
}

static void navigation(fw_report_page *page) {
    fw_text_add(page->out, "<nav aria-label=\"Sections\"><div class=\"in\">");
    for (int i = 0; i < SECTIONS; i++)
        if (is_there(page, i))
            fw_markup(page->out, "<a href=\"#{r}\">{r}</a>\n", sections[i].id, sections[i].title);
    fw_text_add(page->out, "<button type=\"button\" class=\"each\" hidden=\"hidden\">Open all"
                           "</button></div></nav>\n");
}

/* one view for the drawing and all scenes, so that their shapes are shared */
static fw_status survey(fw_report_page *page) {
    const fw_report_input *in = page->in;
    bool drawn = fw_report_drawn(in->layout);
    fw_geometry_box reach = fw_report_box_empty();
    for (int i = 0; i < in->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &in->verdict->variant[i];
        for (int k = 0; v->motion && k < in->device->nscene; k++)
            if (v->motion[k]) {
                page->nmotion++;
                if (drawn)
                    fw_report_reach_add(&reach, in->device, in->layout, v->mechanism, v->motion[k]);
                else
                    FW_TRY(fw_report_poses_reach(page->arena, &reach, NULL, v->mechanism,
                                                 v->motion[k]));
            }
    }
    if (!drawn) FW_TRY(fw_report_figure_rest_reach(page->arena, in->verdict, &reach));
    page->view = !drawn && reach.x1 >= reach.x0
                     ? fw_report_figure_view(&reach, DRAWING_WIDTH)
                     : fw_report_device_view(in->device, in->layout, &reach, DRAWING_WIDTH);
    return FW_OK;
}

fw_status fw_report_write_html(fw_arena *arena, const fw_report_input *input, fw_text *out) {
    fw_report_page page = {.arena = arena, .out = out, .in = input};
    FW_TRY(survey(&page));
    FW_TRY(head(&page));
    FW_TRY(fw_report_banner(&page));
    navigation(&page);
    fw_text_add(out, "<main>\n");
    fw_report_advice(&page);
    for (int i = 0; i < SECTIONS; i++) {
        if (!is_there(&page, i)) continue;
        fw_markup(out,
                  "<section id=\"{r}\" aria-labelledby=\"h-{r}\"><details{r}><summary>"
                  "<h2 id=\"h-{r}\">{r}</h2></summary>\n",
                  sections[i].id, sections[i].id, i < OPEN_SECTIONS ? " open=\"open\"" : "",
                  sections[i].id, sections[i].title);
        FW_TRY(sections[i].write(&page));
        fw_text_add(out, "</details></section>\n");
    }
    fw_markup(out,
              "</main>\n<footer><p>Flexwright {s}. The same input gives the same bytes: this "
              "page holds no date and no run time.</p></footer>\n"
              "<script>//<![CDATA[\n{r}//]]></script>\n</body>\n</html>\n",
              input->version, player_script);
    return fw_text_end(out);
}
