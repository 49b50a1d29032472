"""Style sheets of pages of reports, besides the one that all pages share."""

from __future__ import annotations

THEORIES = """
.theories { display: grid; gap: 1.2rem 1.4rem; align-items: start; margin: .8rem 0;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 17rem), 1fr)); }
.theories > div { min-width: 0; overflow-x: auto; border-top: 3px solid var(--hue);
  padding-top: .4rem; font-size: .75rem; }
.scroll, .theories > div, .ttr { position: relative; }
.theories h4 { margin: 0 0 .3rem; font-size: .95rem; }
.of { display: block; } .of::before { content: ""; display: inline-block;
  width: .65em; height: .65em; margin-right: .4em; background: var(--hue); }
details { margin: .4rem 0; } details details { margin-left: 1.1rem; }
summary { cursor: pointer; color: var(--quiet); }
.apart { background: rgba(229, 160, 13, .2); }
td.type { font-size: .75rem; }
pre { font: .85em/1.45 ui-monospace, "DejaVu Sans Mono", monospace; overflow-x: auto;
  background: var(--soft); padding: .6rem .8rem; border-radius: .3rem; margin: .4rem 0;
  white-space: pre-wrap; overflow-wrap: anywhere; }
@media print { .theories, .theories ~ *, td { print-color-adjust: exact;
  -webkit-print-color-adjust: exact; } .theories > div { break-inside: avoid; } }
"""
"""Theories side by side. Brackets and marks are backgrounds, and are printed all the
same; the unseen notation beside them is scrolled with them, and makes no page wider."""

PAGE = """
nav ul { list-style: none; padding: 0; display: flex; flex-wrap: wrap;
  gap: .2rem 1.3rem; margin: .8rem 0 0; }
section > p { white-space: pre-line; }
section:first-of-type h2 { margin-top: 1.2rem; }
@media screen and (max-width: 40rem) { .band { display: block; margin: 0; }
  .scroll > table > tbody > tr > td:not(.number, .short) { min-width: 7.5rem; } }
table:has(th.number:nth-child(4)):has(th.number:nth-child(5)):has(
  th.number:nth-child(6)):has(th.number:nth-child(7)) .band
  { display: block; margin: 0; }
@media print {
  nav { display: none; } table { font-size: .85em; }
  h2, h3, figcaption { break-after: avoid; } tr { break-inside: avoid; }
  table:has(th.number:nth-child(5)) .band { display: block; margin: 0; }
}
"""
"""A report: its contents in a line; intervals below their numbers, where there is no
room beside them."""

DIALOGUES = """
.turn { display: grid; grid-template-columns: 2.2rem 1fr; gap: 0 .4rem;
  padding: .25rem 0; border-bottom: 1px solid var(--line); }
.turn:target, tr:target, h3:target { background: rgba(229, 160, 13, .2); }
.turn > :first-child { color: var(--quiet); font-size: .82em; text-align: right;
  font-variant-numeric: tabular-nums; }
.turn p { margin: 0; grid-column: 2; } .robot { font-weight: 600; }
.happens { color: var(--quiet); font-size: .85em; overflow-wrap: anywhere; }
.who, .called { color: var(--quiet); } .called { margin: 0 0 .3rem; }
.yes { color: var(--accent); } .no { color: var(--wrong); }
h3 { scroll-margin-top: 1rem; }
.links a { display: inline-block; margin-right: .5em;
  font-variant-numeric: tabular-nums; }
"""
"""Pages of dialogues."""
