"""Style of the pages that Python commands write: light or dark as the reader's system, and suitable for print."""

STYLE = """:root{color-scheme:light dark;--ink:#1a2530;--paper:#fff;--line:#d5dbe2;--code:#f0f3f6;--link:#0b5cad}
@media (prefers-color-scheme:dark){:root{--ink:#e3e8ee;--paper:#161b21;--line:#3a4450;--code:#232a32;--link:#7db8f5}}
body{font:15px/1.45 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:var(--ink);
background:var(--paper)}a{color:var(--link)}figure{margin:1.5rem 0}
img{max-width:100%;background:#fff;border-radius:4px}
table{border-collapse:collapse;font-size:13px}td,th{padding:.15rem .6rem;border-bottom:1px solid var(--line);
text-align:right;white-space:nowrap}td:last-child{white-space:normal;min-width:9rem;max-width:26rem}
th{white-space:normal;position:sticky;top:0;background:var(--paper);vertical-align:bottom}
td:first-child,th:first-child{text-align:left}s{opacity:.6}
.wide{overflow-x:auto;max-height:32rem}code{background:var(--code)}
@media print{body{max-width:none;margin:0;color:#000;background:#fff}.wide{overflow:visible;max-height:none}
th{position:static}figure,tr{break-inside:avoid}}"""
