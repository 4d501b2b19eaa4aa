#include "studies/report/report_look.hpp"

namespace rollres::html {

std::string_view style() {
  return R"(
:root { color-scheme: light dark; --text: #1a1a1a; --soft: #4d4d4d; --page: #fff; --card: #f4f5f7; --rule: #cdd1d6;
  --mark: #fdecea; --accent: #005a8e; --strong: #6b7280; }
@media screen and (prefers-color-scheme: dark) { :root { --text: #e9eaec; --soft: #b6bac0; --page: #16181c;
  --card: #22262c; --rule: #3c424b; --mark: #4a2320; --accent: #7cc4f4; --strong: #8a919c; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 66rem; padding: 1rem; font: 16px/1.5 system-ui, sans-serif; color: var(--text);
  background: var(--page); overflow-wrap: anywhere; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0.5rem 0; }
h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; padding-bottom: 0.2rem; border-bottom: 2px solid var(--accent); }
p { margin: 0.5rem 0; max-width: 46rem; }
.lead { font-size: 1.08rem; }
.soft { color: var(--soft); font-size: 0.9rem; }
.table { overflow: auto; max-height: 75vh; margin: 0.7rem 0; }
table { border-collapse: collapse; font-size: 0.86rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.22rem 0.6rem; border-bottom: 1px solid var(--rule); text-align: left; vertical-align: top;
  overflow-wrap: normal; }
thead th { position: sticky; top: 0; background: var(--page); border-bottom: 2px solid var(--strong);
  vertical-align: bottom; }
th button { all: unset; cursor: pointer; }
th button:focus-visible, .families button:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
th[aria-sort=ascending] button::after { content: " \2191"; }
th[aria-sort=descending] button::after { content: " \2193"; }
.number { text-align: right; }
td.number { white-space: nowrap; }
tr.marked td { background: var(--mark); }
pre { margin: 0.7rem 0; padding: 0.7rem; background: var(--card); font-size: 0.8rem; white-space: pre-wrap;
  overflow-wrap: anywhere; }
details { margin: 0.7rem 0; }
summary { cursor: pointer; color: var(--accent); font-weight: 600; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 26rem), 1fr)); gap: 1rem; }
figure { margin: 0.5rem 0; }
.picture { position: relative; background: #fff; border-radius: 6px; overflow: hidden; }
img, .points { display: block; width: 100%; height: auto; }
.points { position: absolute; inset: 0; }
.points circle { fill: transparent; }
.points circle:hover { fill: currentColor; stroke: #fff; }
.points polyline { display: none; fill: none; stroke: currentColor; stroke-width: 3; }
.alone img { opacity: 0.25; }
.alone .points g { display: none; }
.alone .points g.chosen { display: inline; }
.alone .points g.chosen polyline { display: inline; }
.alone .points g.chosen circle { fill: currentColor; fill-opacity: 0.5; }
.families { display: none; flex-wrap: wrap; gap: 0.35rem; align-items: center; margin: 0.4rem 0; font-size: 0.85rem; }
.scripted .families { display: flex; }
.families button { font: inherit; color: var(--text); background: var(--card); border: 1px solid var(--strong);
  border-radius: 1rem; padding: 0.1rem 0.6rem; cursor: pointer; }
.families button[aria-pressed=true] { background: var(--accent); color: var(--page); }
.families i { display: inline-block; width: 0.7rem; height: 0.7rem; border-radius: 50%; margin-right: 0.35rem;
  border: 1px solid #fff; }
figcaption { font-size: 0.86rem; color: var(--soft); }
@media (max-width: 480px) { body { padding: 0.6rem; font-size: 15px; } th, td { padding: 0.2rem 0.4rem; } }
@media print {
  @page { size: A4; margin: 15mm; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  h2 { break-after: avoid; }
  .table { overflow: visible; max-height: none; }
  table { font-size: 7.5pt; width: 100%; }
  th, td { padding: 0.12rem 0.3rem; overflow-wrap: break-word; }
  thead th { position: static; }
  td.number { white-space: normal; }
  thead { display: table-header-group; }
  tr, figure { break-inside: avoid; }
  .pictures { display: block; }
  .families, .points, .scripted .families { display: none; }
  .alone img { opacity: 1; }
  figure { max-width: 150mm; }
  pre { font-size: 7.5pt; }
  tr.marked td { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)";
}

std::string_view script() {
  return R"(
document.documentElement.classList.add('scripted');
for (const figure of document.querySelectorAll('figure'))
  for (const button of figure.querySelectorAll('.families button'))
    button.addEventListener('click', () => {
      const alone = button.getAttribute('aria-pressed') !== 'true';
      figure.classList.toggle('alone', alone);
      for (const other of figure.querySelectorAll('.families button'))
        other.setAttribute('aria-pressed', String(alone && other === button));
      for (const group of figure.querySelectorAll('.points g'))
        group.classList.toggle('chosen', alone && group.dataset.curve === button.dataset.curve);
    });
const factors = { n: 1e-9, µ: 1e-6, m: 1e-3, k: 1e3, M: 1e6, G: 1e9 };
const value = (text) => {  // "20 kN/m" is more than "300 N/m"; words come after all numbers
  const parts = /^(-?[0-9.]+(?:e[-+]?[0-9]+)?)(?: ([nµmkMG])(?=[a-zA-Z]))?/.exec(text);
  return parts ? Number(parts[1]) * (parts[2] ? factors[parts[2]] : 1) : text === 'infinite' ? Infinity : NaN;
};
for (const table of document.querySelectorAll('table.sortable'))
  table.querySelectorAll('thead th').forEach((head, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.title = 'sort by this column';
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener('click', () => {
      const falling = head.getAttribute('aria-sort') === 'ascending';
      for (const other of table.querySelectorAll('th')) other.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', falling ? 'descending' : 'ascending');
      const body = table.tBodies[0], text = (row) => row.cells[column].textContent;
      const order = (a, b) => {
        const x = value(text(a)), y = value(text(b));
        if (Number.isNaN(x) || Number.isNaN(y))
          return Number.isNaN(x) && Number.isNaN(y) ? text(a).localeCompare(text(b)) : Number.isNaN(x) ? 1 : -1;
        return falling ? y - x : x - y;
      };
      body.append(...[...body.rows].sort(order));
    });
  });
)";
}

}  // namespace rollres::html
