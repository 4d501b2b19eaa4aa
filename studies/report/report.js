document.documentElement.classList.add('scripted');
for (const figure of document.querySelectorAll('figure'))
  for (const button of figure.querySelectorAll('.families button'))
    button.addEventListener('click', () => {
      const alone = button.getAttribute('aria-pressed') !== 'true';
      figure.classList.toggle('alone', alone);
      for (const other of figure.querySelectorAll('.families button'))
        other.setAttribute('aria-pressed', String(alone && other === button));
      for (const group of figure.querySelectorAll('.points g'))
        group.classList.toggle('chosen', alone && button.dataset.curve.split(' ').includes(group.dataset.curve));
    });
// Zoom: a part of a chart that is drawn out by the mouse is drawn anew, with its own numbers; a finger scrolls.
document.querySelectorAll('.points[data-frame]').forEach((layer, number) => {
  const figure = layer.closest('figure'), [left, top, right, bottom] = layer.dataset.frame.split(' ').map(Number);
  const [width, height] = [layer.viewBox.baseVal.width, layer.viewBox.baseVal.height];
  const axes = ['x', 'y'].map((letter) => {
    const [low, high, kind] = layer.dataset[letter].split(' '), along = kind ? Math.log10 : Number;
    return { low: along(Number(low)), high: along(Number(high)), logarithmic: Boolean(kind), name: layer.dataset[letter + 'Name'] };
  });
  const curves = [...layer.children], clip = 'clip-' + number;
  const shapes = [...layer.querySelectorAll('polyline, polygon')].map((shape) =>
    [shape, shape.getAttribute('points').trim().split(' ').map((pair) => pair.split(',').map(Number))]);
  const marks = [...layer.querySelectorAll('circle')].map((mark) => [mark, Number(mark.getAttribute('cx')), Number(mark.getAttribute('cy'))]);
  let part = { left, top, right, bottom }, drawn = null, start = null, chosen = null;
  const hint = document.createElement('p'), words = document.createElement('span'), reset = document.createElement('button');
  words.textContent = 'Drag over a part to enlarge it, double click to see all again.';
  reset.type = 'button';
  reset.textContent = 'Show the whole chart';
  hint.className = 'zoom-hint';
  hint.append(words, reset);
  layer.parentElement.after(hint);
  figure.classList.add('zooms');

  const draw = () => {
    const x = (at) => left + (at - part.left) / (part.right - part.left) * (right - left);
    const y = (at) => top + (at - part.top) / (part.bottom - part.top) * (bottom - top);
    for (const [shape, pairs] of shapes) shape.setAttribute('points', pairs.map(([a, b]) => x(a) + ',' + y(b)).join(' '));
    for (const [mark, a, b] of marks) {
      mark.setAttribute('cx', x(a));
      mark.setAttribute('cy', y(b));
    }
    const whole = part.left === left && part.right === right && part.top === top && part.bottom === bottom;
    figure.classList.toggle('zoomed', !whole);
    for (const curve of curves) whole ? curve.removeAttribute('clip-path') : curve.setAttribute('clip-path', 'url(#' + clip + ')');
    if (drawn) drawn.remove();
    drawn = null;
    if (whole) return;
    drawn = element('g', { class: 'axes' });
    const box = { x: left, y: top, width: right - left, height: bottom - top };
    const around = element('clipPath', { id: clip });
    around.append(element('rect', box));
    drawn.append(around);
    const ends = ([axis, from, to, first, last]) => {
      const value = (share) => {
        const at = axis.low + share * (axis.high - axis.low);
        return axis.logarithmic ? 10 ** at : at;
      };
      return [value((from - first) / (last - first)), value((to - first) / (last - first))];
    };
    const share = (axis, number) => ((axis.logarithmic ? Math.log10(number) : number) - axis.low) / (axis.high - axis.low);
    for (const [number, text] of ticks(...ends([axes[0], part.left, part.right, left, right]), axes[0].logarithmic)) {
      const at = x(left + share(axes[0], number) * (right - left));
      drawn.append(element('line', { class: 'grid', x1: at, x2: at, y1: top, y2: bottom }),
        element('text', { x: at, y: bottom + 20, 'text-anchor': 'middle' }, text));
    }
    for (const [number, text] of ticks(...ends([axes[1], part.bottom, part.top, bottom, top]), axes[1].logarithmic)) {
      const at = y(bottom - share(axes[1], number) * (bottom - top));
      drawn.append(element('line', { class: 'grid', x1: left, x2: right, y1: at, y2: at }),
        element('text', { x: left - 6, y: at + 5, 'text-anchor': 'end' }, text));
    }
    drawn.append(element('rect', { class: 'frame', ...box }),
      element('text', { x: (left + right) / 2, y: Math.min(bottom + 42, height - 6), 'text-anchor': 'middle' }, axes[0].name),
      element('text', { x: left, y: top - 10 }, axes[1].name));
    layer.prepend(drawn);
  };
  const place = (event) => {
    const seen = layer.getBoundingClientRect();
    return [Math.min(right, Math.max(left, (event.clientX - seen.left) / seen.width * width)),
      Math.min(bottom, Math.max(top, (event.clientY - seen.top) / seen.height * height))];
  };
  const from_to = (event) => {  // a flat stroke is a part of x alone, a steep one of y
    const [x, y] = place(event), least = 10;
    const flat = Math.abs(y - start[1]) < 2 * least, steep = Math.abs(x - start[0]) < 2 * least;
    if (Math.hypot(x - start[0], y - start[1]) < least || (flat && steep)) return null;
    return { left: steep ? left : Math.min(x, start[0]), right: steep ? right : Math.max(x, start[0]),
      top: flat ? top : Math.min(y, start[1]), bottom: flat ? bottom : Math.max(y, start[1]) };
  };
  const give_up = () => {
    if (chosen) chosen.remove();
    start = chosen = null;
  };
  const whole = () => {
    give_up();
    part = { left, top, right, bottom };
    draw();
  };
  layer.addEventListener('pointerdown', (event) => {
    if (event.pointerType === 'touch' || event.button !== 0) return;
    start = place(event);
    chosen = element('rect', { class: 'chosen-part' });
    layer.append(chosen);
    event.preventDefault();
  });
  addEventListener('pointermove', (event) => {
    if (!start) return;
    const now = from_to(event) || { left: 0, right: 0, top: 0, bottom: 0 };
    for (const [key, value] of Object.entries({ x: now.left, y: now.top, width: now.right - now.left, height: now.bottom - now.top }))
      chosen.setAttribute(key, value);
  });
  addEventListener('pointerup', (event) => {
    if (!start) return;
    const now = from_to(event);
    give_up();
    if (!now) return;
    const back_x = (at) => part.left + (at - left) / (right - left) * (part.right - part.left);
    const back_y = (at) => part.top + (at - top) / (bottom - top) * (part.bottom - part.top);
    const next = { left: back_x(now.left), right: back_x(now.right), top: back_y(now.top), bottom: back_y(now.bottom) };
    const finest = 1e-4;
    if (next.right - next.left < finest * (right - left) || next.bottom - next.top < finest * (bottom - top)) return;
    part = next;
    draw();
  });
  addEventListener('pointercancel', give_up);
  addEventListener('keydown', (event) => event.key === 'Escape' && give_up());
  layer.addEventListener('dblclick', whole);
  reset.addEventListener('click', whole);
});
const factors = { n: 1e-9, µ: 1e-6, m: 1e-3, k: 1e3, M: 1e6, G: 1e9 };
const value = (text) => {  // "20 kN/m" is more than "300 N/m"; words come after all numbers
  const parts = /^(-?[0-9.]+(?:e[-+]?[0-9]+)?)(?: ([nµmkMG])(?=[a-zA-Z]))?/.exec(text);
  return parts ? Number(parts[1]) * (parts[2] ? factors[parts[2]] : 1) : text === 'infinite' ? Infinity : NaN;
};
// On a narrow page each row stands as lines, a cell beside the head of its column.
for (const table of document.querySelectorAll('table')) {
  const heads = [...table.querySelectorAll('th')].map((head) => head.textContent);
  for (const row of table.tBodies[0].rows) [...row.cells].forEach((cell, i) => { cell.dataset.head = heads[i]; });
}
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
