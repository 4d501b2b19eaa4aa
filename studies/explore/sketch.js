// The scene to scale, with the deformed surface, the pressure and the shear on it, stick and slip; and the contact
// alone, enlarged. element: ticks.js.
import { draw, in_units, colours } from './chart.js';
import { number, readable } from './units.js';

const layers_of = (scene) => [scene, ...(scene.lower_layers || [])];

// How much of the scene is seen: all of the body, or of one on thin layers its lower part.
function view_of(scene, answer) {
  const radius = number(scene.radius), coatings = scene.coating_layers || [];
  const thickness = layers_of(scene).map((layer) => number(layer.layer_thickness));
  const pressed = scene.indenter === 'pressure', finite = thickness.filter(Number.isFinite).reduce((a, b) => a + b, 0);
  const coating = coatings.map((layer) => number(layer.layer_thickness)).reduce((a, b) => a + b, 0);
  const thinnest = Math.min(finite > 0 ? finite : Infinity, coating > 0 ? coating : Infinity), widest = 1.62;
  const contact = answer.leading_edge === null ? 0 : answer.leading_edge - answer.trailing_edge;
  const half = pressed ? 2.5 * radius : thinnest < radius / 12 ? Math.min(Math.max(12 * widest * thinnest, 4 * contact, 0.02 * radius), widest * radius) : widest * radius;
  return { radius, half, contact, thickness, pressed, top: half > 1.1 * radius && !pressed ? 2.75 * radius : 1.15 * half };
}

export function sketch(place, reply) {
  const scene = reply.answer.scene, answer = reply.answer, view = view_of(scene, answer), surface = reply.surface;
  const { radius, half } = view, width = 560, scale = width / (2 * half);
  const depths = [0];
  for (const thickness of view.thickness) depths.push(Math.min(depths[depths.length - 1] + (Number.isFinite(thickness) ? thickness : 0.45 * half), 1.05 * half));
  const deepest = depths[depths.length - 1], cut = !Number.isFinite(view.thickness.at(-1)) || deepest === 1.05 * half, bottom = deepest + (cut ? 0 : 0.1 * half);
  const height = (view.top + bottom) * scale, x = (at) => (at + half) * scale, z = (at) => (view.top - at) * scale;
  const answered = answer.status === 'converged' && answer.leading_edge !== null;
  const approach = answered && !view.pressed ? (answer.approach ?? view.contact ** 2 / (8 * radius)) : 0, centre = radius - approach;
  const svg = element('svg', { viewBox: '0 0 ' + width + ' ' + height.toFixed(1), role: 'img', xmlns: 'http://www.w3.org/2000/svg' });
  const path = (points) => points.map(([a, b], n) => (n ? 'L' : 'M') + x(a).toFixed(2) + ' ' + z(b).toFixed(2)).join('') + 'Z';
  // The layers' surface where it is computed; from there it falls to zero.
  const dent = (at) => {
    if (!surface || reply.coating_yields) return 0;
    const places = surface.x, last = places.length - 1, step = (places[last] - places[0]) / last;
    if (at < places[0]) return (surface.w[0] || 0) * Math.exp((at - places[0]) / Math.max(view.contact, step));
    if (at > places[last]) return (surface.w[last] || 0) * Math.exp((places[last] - at) / Math.max(view.contact, step));
    const cell = Math.min(Math.floor((at - places[0]) / step), last - 1), share = (at - places[cell]) / step;
    return (1 - share) * surface.w[cell] + share * surface.w[cell + 1];
  };
  const across = Array.from({ length: 401 }, (_, n) => half * (n / 200 - 1));
  const face = (depth) => across.map((at) => [at, -depth + (1 - depth / deepest) * dent(at)]);
  const shapes = [];
  if (!cut) shapes.push(element('rect', { class: 'base', x: 0, y: z(-deepest), width, height: height - z(-deepest) }));
  for (let n = 0; n + 1 < depths.length; ++n)
    shapes.push(element('path', { class: 'layer-' + n % 3, d: path([...face(depths[n]), ...face(depths[n + 1]).reverse()]) }));
  const circle = (r) => Array.from({ length: 361 }, (_, n) => [r * Math.sin(n * Math.PI / 180),
    Math.max(centre + r * Math.cos(n * Math.PI / 180), reply.coating_yields ? 0 : -Infinity)]);
  const body = [];
  let r = radius;
  (scene.coating_layers || []).forEach((layer, n) => {
    body.push(element('path', { class: 'coating-' + n % 3, d: path(circle(r)) }));
    r -= number(layer.layer_thickness);
  });
  if (r > 0 && !view.pressed) body.push(element('path', { class: 'body', d: path(circle(r)) }));
  svg.append(...(reply.coating_yields ? [...body, ...shapes] : [...shapes, ...body]));
  if (surface) {
    const inside = surface.x.map((at, n) => n).filter((n) => surface.zone[n] !== 'free');
    const peak = Math.max(...surface.pressure, 1e-300), tall = 0.32 * half / peak;
    const points = inside.map((n) => [surface.x[n], dent(surface.x[n])]);
    if (inside.length > 1) {
      svg.append(element('path', { class: 'pressure', d: path([...inside.map((n) => [surface.x[n], dent(surface.x[n]) + tall * surface.pressure[n]]), ...points.reverse()]) }));
      if (surface.shear.some((value) => value))
        svg.append(element('path', { class: 'shear', d: path(inside.map((n) => [surface.x[n], dent(surface.x[n]) + tall * surface.shear[n]])).slice(0, -1) }));
      const zones = { stick: [], slip: [] };
      for (const n of inside) zones[surface.zone[n]].push(n);
      for (const [zone, nodes] of Object.entries(zones)) {
        let d = '';
        nodes.forEach((n, i) => { d += (i && nodes[i - 1] === n - 1 ? 'L' : 'M') + x(surface.x[n]).toFixed(2) + ' ' + z(dent(surface.x[n])).toFixed(2); });
        if (d) svg.append(element('path', { class: 'zone ' + (number(scene.friction_coefficient) > 0 ? zone : 'contact'), d }));
      }
    }
  }
  const arrow = (x0, z0, x1, z1, text, side) => {
    const angle = Math.atan2(z1 - z0, x1 - x0), head = [[x1, z1], [x1 - 9 * Math.cos(angle - 0.4), z1 - 9 * Math.sin(angle - 0.4)], [x1 - 9 * Math.cos(angle + 0.4), z1 - 9 * Math.sin(angle + 0.4)]];
    svg.append(element('line', { class: 'arrow', x1: x0, y1: z0, x2: x1, y2: z1 }), element('polygon', { class: 'head', points: head.map((pair) => pair.join(',')).join(' ') }),
      element('text', { x: side === 'end' ? x0 - 8 : x0, y: z0 + (side === 'end' ? 12 : -8), 'text-anchor': side }, text));
  };
  const per_metre = scene.indenter === 'cylinder' && scene.width === undefined, middle = width / 2;
  const load = answer.load ?? number(scene.load);
  if (Number.isFinite(load)) arrow(middle, 6, middle, 44, 'P = ' + readable(load, per_metre ? 'N/m' : 'N', 4), 'end');
  arrow(0.8 * width, 30, 0.93 * width, 30, 'V = ' + readable(number(scene.speed), 'm/s', 4), 'start');
  svg.append(element('text', { x: 8, y: 18 }, view.pressed ? readable(2 * radius, 'm', 4) + ' long' : 'R = ' + readable(radius, 'm', 4)), element('text', { x: 8, y: z(-0.5 * depths[1]) + 5 },
    'H = ' + (Number.isFinite(view.thickness[0]) ? readable(view.thickness[0], 'm', 4) : 'infinite')));
  svg.setAttribute('aria-label', 'The scene to scale: a ' + (view.pressed ? 'given pressure' : scene.indenter) + ' of ' + readable(radius, 'm', 4) + ' radius on ' + view.thickness.length +
    (view.thickness.length === 1 ? ' layer' : ' layers') + (answered ? ', in contact over ' + readable(view.contact, 'm', 4) : ''));
  place.replaceChildren(svg);
  return svg;
}

export function contact(place, reply) {
  const surface = reply.surface;
  if (!surface) return place.replaceChildren();
  const line = (label, values, colour) => ({ label, colour, points: surface.x.map((at, n) => [at, values[n], true]) });
  const curves = [line('pressure', surface.pressure, colours[0])];
  if (surface.shear.some((value) => value)) curves.push(line('shear, slipping where it is drawn in marks', surface.shear, colours[1]));
  const slipping = surface.x.map((at, n) => n).filter((n) => surface.zone[n] === 'slip');
  if (curves.length > 1 && slipping.length && slipping.length < 400)
    curves.push({ label: '', like: 1, colour: colours[1], line: false, points: slipping.map((n) => [surface.x[n], surface.shear[n], true]) });
  draw(place, in_units({ x: { name: 'place along the motion', unit: 'm' }, y: { name: 'traction', unit: 'Pa' }, curves }), { height: 230, words: 'Pressure and shear along the contact' });
}
