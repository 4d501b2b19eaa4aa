// Curves as SVG: axes with numbers, bands of error, a line where the scene stands, marks that can be chosen.
// element, ticks: ticks.js.
import { readable, scaled, typeset, digits } from './units.js';

export const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b07c00', '#56a0d3', '#7a5195', '#8c564b'];

const span = (values, logarithmic) => {
  const good = values.filter((value) => Number.isFinite(value) && (!logarithmic || value > 0));
  if (good.length === 0) return [logarithmic ? 0.1 : 0, 1];
  const low = good.reduce((a, b) => Math.min(a, b)), high = good.reduce((a, b) => Math.max(a, b));
  if (low < high) return [low, high];
  return logarithmic ? [low / 2, low * 2] : [low - 0.5 * Math.abs(low || 1), low + 0.5 * Math.abs(low || 1)];
};

// chart: { x, y: { name, symbol, unit, logarithmic }, curves: [{ label, points: [[x, y, answered, low, high]] }], at: x }
// in units of the axes. chosen(curve, point) is called for a mark that is clicked.
export function draw(place, chart, { height = 300, chosen, words } = {}) {
  const width = 560, left = 66, right = 16, top = 14, bottom = 46;
  const all = chart.curves.flatMap((curve) => curve.points);
  const [x0, x1] = span(all.map((point) => point[0]), chart.x.logarithmic);
  const ends = all.flatMap((point) => [point[1], point[3], point[4]]).filter((value) => value !== null && value !== undefined);
  let [y0, y1] = span(ends, chart.y.logarithmic);
  if (!chart.y.logarithmic) {
    if (y0 > 0 && y0 < 0.6 * y1) y0 = 0;
    y1 += 0.05 * (y1 - y0);
    if (y0 !== 0) y0 -= 0.05 * (y1 - y0);
  }
  const share = (value, from, to, logarithmic) => logarithmic ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from);
  const x = (value) => left + share(value, x0, x1, chart.x.logarithmic) * (width - left - right);
  const y = (value) => height - bottom - share(value, y0, y1, chart.y.logarithmic) * (height - top - bottom);
  const svg = element('svg', { viewBox: '0 0 ' + width + ' ' + height, role: 'img', xmlns: 'http://www.w3.org/2000/svg' });
  svg.setAttribute('aria-label', words || chart.y.name + ' against ' + chart.x.name);
  for (const [value, text] of ticks(x0, x1, chart.x.logarithmic))
    svg.append(element('line', { class: 'grid', x1: x(value), x2: x(value), y1: top, y2: height - bottom }),
      element('text', { x: x(value), y: height - bottom + 17, 'text-anchor': 'middle' }, text));
  for (const [value, text] of ticks(y0, y1, chart.y.logarithmic))
    svg.append(element('line', { class: 'grid', x1: left, x2: width - right, y1: y(value), y2: y(value) }),
      element('text', { x: left - 6, y: y(value) + 4, 'text-anchor': 'end' }, text));
  svg.append(element('rect', { class: 'frame', x: left, y: top, width: width - left - right, height: height - top - bottom }));
  const named = (axis) => axis.name + (axis.unit && axis.unit !== '1' ? ' [' + typeset(axis.unit) + ']' : '');
  svg.append(element('text', { x: (left + width - right) / 2, y: height - 8, 'text-anchor': 'middle' }, named(chart.x)),
    element('text', { x: 14, y: (top + height - bottom) / 2, 'text-anchor': 'middle', transform: 'rotate(-90 14 ' + (top + height - bottom) / 2 + ')' }, named(chart.y)));
  const shows = ([a, b]) => a !== null && b !== null && (!chart.x.logarithmic || a > 0) && (!chart.y.logarithmic || b > 0);
  chart.curves.forEach((curve, number) => {
    const colour = curve.colour || colours[(curve.like ?? number) % colours.length];
    const banded = curve.points.filter((point) => shows(point) && point[3] !== null && point[3] !== undefined && (!chart.y.logarithmic || point[3] > 0));
    if (banded.length > 1) {
      const outline = [...banded.map((point) => [point[0], point[4]]), ...banded.reverse().map((point) => [point[0], point[3]])];
      svg.append(element('polygon', { class: 'band', fill: colour, points: outline.map(([a, b]) => x(a) + ',' + y(b)).join(' ') }));
    }
    let run = [];
    const finish = () => {
      if (run.length > 1 && curve.line !== false)
        svg.append(element('polyline', { class: 'curve', stroke: colour, points: run.join(' '), ...(curve.dashed ? { 'stroke-dasharray': '7 4' } : {}) }));
      run = [];
    };
    for (const point of curve.points) shows(point) && point[2] !== false ? run.push(x(point[0]).toFixed(2) + ',' + y(point[1]).toFixed(2)) : finish();
    finish();
    if (chosen || curve.line === false)
      curve.points.forEach((point, place_in_curve) => {
        if (!shows(point)) return;
        const mark = element('circle', { class: 'dot', cx: x(point[0]), cy: y(point[1]), r: 3.5, fill: point[2] === false ? 'none' : colour, stroke: colour });
        mark.append(element('title', {}, (curve.label ? curve.label + ': ' : '') + digits(point[1]) + ' at ' + digits(point[0])));
        if (chosen) mark.addEventListener('click', () => chosen(number, place_in_curve));
        svg.append(mark);
      });
  });
  if (chart.at !== undefined && chart.at >= x0 && chart.at <= x1)
    svg.append(element('line', { class: 'now', x1: x(chart.at), x2: x(chart.at), y1: top, y2: height - bottom }));
  place.replaceChildren(svg);
  const labelled = chart.curves.filter((curve) => curve.label && curve.like === undefined);
  if (labelled.length > 1 || (labelled.length === 1 && chart.curves.length > 1)) {
    const legend = document.createElement('p');
    legend.className = 'choices';
    for (const curve of labelled) {
      const entry = document.createElement('span'), line = element('svg', { width: 26, height: 10, viewBox: '0 0 26 10', 'aria-hidden': 'true' });
      line.style.width = '26px';
      line.style.display = 'inline-block';
      line.append(element('line', { x1: 0, x2: 26, y1: 5, y2: 5, stroke: curve.colour || colours[chart.curves.indexOf(curve) % colours.length], 'stroke-width': 3 }));
      entry.append(line, ' ' + (chart.family && chart.family.symbol ? chart.family.symbol + ' = ' : '') + curve.label);
      legend.append(entry);
    }
    place.append(legend);
  }
  return svg;
}

// A chart of values in SI in the units that suit their sizes.
export function in_units(chart) {
  const axis = (one, values) => {
    const sizes = values.filter((value) => Number.isFinite(value)).map(Math.abs);
    const scale = sizes.length ? scaled(sizes.reduce((a, b) => Math.max(a, b)), one.unit) : { factor: 1, unit: one.unit };
    return [{ ...one, unit: scale.unit }, (value) => value === null || value === undefined ? null : value / scale.factor];
  };
  const points = chart.curves.flatMap((curve) => curve.points);
  const [x, along] = axis(chart.x, points.map((point) => point[0])), [y, up] = axis(chart.y, points.map((point) => point[1]));
  return { ...chart, x, y, at: chart.at === undefined ? undefined : along(chart.at),
    curves: chart.curves.map((curve) => ({ ...curve, points: curve.points.map(([a, b, answered, low, high]) => [along(a), up(b), answered, up(low), up(high)]) })) };
}

// The largest value inside a curve, in words; empty where it only rises or falls.
export function peak_in_words(curve, x, y) {
  const good = curve.points.filter((point) => point[1] !== null && point[2] !== false);
  if (good.length < 3) return '';
  let best = 0;
  good.forEach((point, place) => { if (point[1] > good[best][1]) best = place; });
  if (best === 0 || best === good.length - 1) return '';
  return 'Peak of ' + good.length + ' points: ' + readable(good[best][1], y.unit, 4) + ' at ' + x.name + ' ' + readable(good[best][0], x.unit, 4) + '.';
}

// The picture as a file of its own, as it looks on the page.
export function as_file(svg) {
  const copy = svg.cloneNode(true), shown = [svg, ...svg.querySelectorAll('*')], copied = [copy, ...copy.querySelectorAll('*')];
  shown.forEach((one, place) => {
    const look = getComputedStyle(one);
    for (const property of ['fill', 'fill-opacity', 'stroke', 'stroke-width', 'stroke-dasharray', 'font-size', 'font-family'])
      if (one.localName !== 'svg' && one.localName !== 'title') copied[place].setAttribute(property, look.getPropertyValue(property));
  });
  copy.prepend(element('rect', { width: '100%', height: '100%', fill: getComputedStyle(document.body).backgroundColor }));
  return '<?xml version="1.0" encoding="UTF-8"?>\n' + new XMLSerializer().serializeToString(copy) + '\n';
}
