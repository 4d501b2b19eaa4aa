// The page: inputs on the left, what follows from them on the right. Every number comes from the program, which answers
// to the scene as it would to a file of the same text.
import { draw, in_units, peak_in_words, as_file, colours } from './chart.js';
import { sketch, contact } from './sketch.js';
import { digits, factor_of, number, readable, split, typeset, with_error } from './units.js';
import { Studies } from './studies.js';

const by = (id) => document.getElementById(id);
const made = (name, attributes = {}, ...children) => {
  const one = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) one[key] = value;
  one.append(...children);
  return one;
};
const notice = (words) => { by('notice').textContent = words; };

// ---- What is asked of the program. A wish that a newer one overtakes is given up by the program and here.
const page = crypto.randomUUID();
let wishes = 0;
async function ask(what, body) {
  const reply = await fetch(what, body === undefined ? {} : { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) });
  const json = await reply.json();
  if (reply.ok && !json.error) return json;
  throw Object.assign(new Error(json.error), json);
}
const wish = (view) => ({ page, view, number: ++wishes });

// ---- The scene.
let quantities, scene, held = {} /* the first scene in SI */, answer = null, curve = null, pinned = [], svg_of = {};
const input_of = (key) => quantities.inputs.find((input) => input.key === key);
const output_of = (key) => quantities.outputs.find((output) => output.key === key);
const per_metre = () => (scene.indenter ?? 'cylinder') === 'cylinder' && scene.width === undefined;
const unit_of = (quantity) => per_metre() ? quantity.unit_2d : quantity.unit;

// A text is a number, a name or a text with a unit; of a list each of its parts.
function value_of(text, input) {
  const one = (part) => /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/.test(part) ? Number(part) : part;
  return input.list ? text.split(',').map((part) => one(part.trim())).filter((part) => part !== '') : one(text.trim());
}
const text_of = (value) => value === undefined ? '' : Array.isArray(value) ? value.join(', ') : String(value);

// A slider moves the number of a text and leaves its unit: over two decades to either side, or over the whole range; of a
// temperature with a unit by 60 degrees.
function slider_of(input, text, changed) {
  const parts = split(text);
  if (!input.real || !parts) return null;
  const [start, unit] = parts, bounded = input.lowest !== null && input.highest !== null && !unit.trim();
  const degrees = input.key.endsWith('temperature') && unit.trim() !== '', logarithmic = !bounded && !degrees && start > 0 && input.lowest !== null;
  const reach = degrees ? [start - 60, start + 60] : bounded ? [input.lowest, input.highest] : logarithmic ? [-2, 2] : [Math.min(0, 3 * start), Math.max(0, 3 * start) || 1];
  const slider = made('input', { type: 'range', min: reach[0], max: reach[1], step: (reach[1] - reach[0]) / 400, value: logarithmic ? 0 : start });
  slider.setAttribute('aria-label', input.key + ', slider');
  slider.addEventListener('input', () => {
    const at = Number(slider.value);
    let next = logarithmic ? start * 10 ** at : at;
    if (input.highest !== null && !unit.trim()) next = Math.min(next, input.highest);
    changed(digits(next, 4) + unit);
  });
  return slider;
}

function input_row(input, holder, path) {
  const row = made('div', { className: 'input' }), id = 'in-' + path, given = holder[input.key] !== undefined;
  row.dataset.key = path;
  row.classList.toggle('absent', !given);
  const label = made('label', { htmlFor: id, title: input.meaning + (input.rule ? ' (' + input.rule + ')' : '') }, input.key.replaceAll('_', ' '));
  if (input.symbol) label.append(' ' + input.symbol);
  const unit = unit_of(input);
  if (unit && unit !== '1' && !given) label.append(' [' + typeset(unit) + ']');
  const set = (text) => {
    if (text.trim() === '') delete holder[input.key];
    else holder[input.key] = value_of(text, input);
    if (text.trim() === '') return;
    const ways = quantities.inputs.filter((other) => other.held_as === (input.held_as ?? input.key)).map((other) => other.key);
    for (const other of [...(input.replaces ?? []), ...ways, input.held_as]) if (other !== input.key) delete holder[other];
  };
  let field, slider = null;
  if (input.choices) {
    field = made('select', { id });
    field.append(made('option', { value: '', textContent: input.default ? input.default + ' (default)' : '' }));
    for (const choice of input.choices) field.append(made('option', { value: choice, textContent: choice }));
    field.value = given ? holder[input.key] : '';
    field.addEventListener('change', () => { set(field.value); rebuild(); changed(); });
  } else {
    field = made('input', { id, value: text_of(holder[input.key]), autocomplete: 'off', spellcheck: false });
    if (tables.includes(input)) field.setAttribute('list', 'files');
    if (input.default !== undefined && !given) field.placeholder = String(input.default);
    field.addEventListener('change', () => { set(field.value); rebuild(path); changed(); });
    slider = slider_of(input, field.value, (text) => { field.value = text; set(text); changed(); });
  }
  row.append(label, field);
  if (slider) row.append(slider);
  return row;
}

function layer_list(list) {
  const box = made('div'), layers = scene[list] ?? [];
  layers.forEach((layer, place) => {
    const one = made('fieldset', {}, made('legend', { textContent: list.replace('_layers', '') + ' [' + place + ']' }));
    const tool = (text, name, act, off) => {
      const button = made('button', { type: 'button', textContent: text, disabled: off });
      button.setAttribute('aria-label', name + ' ' + list + ' ' + place);
      button.addEventListener('click', () => { act(); if (layers.length === 0) delete scene[list]; rebuild(); changed(); });
      return button;
    };
    const swap = (other) => { [layers[place], layers[other]] = [layers[other], layers[place]]; };
    one.append(made('div', { className: 'choices' }, tool('Up', 'Move up', () => swap(place - 1), place === 0),
      tool('Down', 'Move down', () => swap(place + 1), place === layers.length - 1), tool('Remove', 'Remove', () => layers.splice(place, 1), false)));
    one.append(...rows_of([...quantities.layer, ...tables], layer, list + '[' + place + '].'));
    box.append(one);
  });
  const add = made('button', { type: 'button', textContent: 'Add to ' + list.replace('_', ' ') });
  add.addEventListener('click', () => {
    const like = layers.at(-1) ?? scene, copy = {};
    for (const { key } of quantities.layer) if (like[key] !== undefined) copy[key] = like[key];
    if (copy.layer_thickness === 'infinite' || !copy.layer_thickness) copy.layer_thickness = '5 mm';
    scene[list] = [...layers, copy];
    rebuild();
    changed();
  });
  box.append(add);
  return box;
}

let tables = [];  // inputs that name a file
function rows_of(inputs, holder, prefix) {
  const given = [], others = [];
  for (const input of inputs) {
    if (input.layers) { given.push(layer_list(input.key)); continue; }
    (holder[input.key] !== undefined ? given : others).push(input_row(input, holder, prefix + input.key));
  }
  if (others.length === 0) return given;
  const more = made('details', { open: open_groups.has(prefix + (inputs[0]?.key ?? '')) }, made('summary', { textContent: others.length + ' more' }), ...others);
  more.addEventListener('toggle', () => more.open ? open_groups.add(prefix + inputs[0].key) : open_groups.delete(prefix + inputs[0].key));
  return [...given, more];
}

const open_groups = new Set();
function rebuild(focus) {
  const form = by('inputs'), top = form.scrollTop, active = document.activeElement?.id;
  form.replaceChildren();
  for (const group of new Set(quantities.inputs.map((input) => input.group))) {
    const inputs = quantities.inputs.filter((input) => input.group === group);
    form.append(made('fieldset', {}, made('legend', { textContent: group }), ...rows_of(group === 'Material' ? [...inputs, ...tables] : inputs, scene, '')));
  }
  form.scrollTop = top;
  if (focus && active) by(active)?.focus();
}

function say_refusal(error) {
  for (const row of document.querySelectorAll('.input')) {
    row.classList.remove('refused');
    row.querySelector('.said')?.remove();
  }
  // What stands on the right belongs to the scene before.
  by('results').classList.toggle('stale', Boolean(error));
  if (!error) return notice('');
  by('headline').textContent = 'no answer';
  const key = error.key, row = key && document.querySelector('.input[data-key="' + CSS.escape(key) + '"]');
  if (!row) return notice(error.message);
  notice('');
  row.classList.add('refused');
  row.closest('details')?.setAttribute('open', '');
  row.append(made('p', { className: 'said', textContent: error.message.replace(/^scene: /, '') }));
}

// ---- The answer.
const times = [];
const measured = { events: times };  // from a change to what is on the screen [ms]

function show_answer(reply) {
  answer = reply;
  const found = reply.answer, unit = (key) => unit_of(output_of(key));
  const headline = by('headline');
  headline.classList.toggle('stale', reply.coarse);
  if (found.status === 'converged') {
    const error = found.rolling_resistance_error;
    headline.textContent = 'R_r = ' + (error === null ? readable(found.rolling_resistance, unit('rolling_resistance'))
      : with_error(found.rolling_resistance, error, unit('rolling_resistance'))) + (reply.coarse ? ', a first look' : '');
  } else headline.textContent = found.status.replace('_', ' ') + ': ' + found.reason;
  const model = found.model_error !== null ? '; what the model assumes may change it by ' + digits(100 * found.model_error, 2) + ' %' : '';
  by('effort').textContent = 'Solved in ' + readable(found.seconds, 's', 3) + ' by ' + found.method + (found.error_estimate !== null ? ', numbers to ' + digits(100 * found.error_estimate, 2) + ' %' : '') + model + '.';
  by('warnings').replaceChildren(...found.warnings.map((words) => made('li', { textContent: words })));
  by('numbers').tBodies[0].replaceChildren(...quantities.outputs.filter(({ key }) => found[key] !== null && found[key] !== undefined).map((output) => {
    const value = made('td', { className: 'number', textContent: readable(found[output.key], unit_of(output), 6) });
    value.dataset.value = JSON.stringify(found[output.key]);
    return made('tr', { title: output.meaning }, made('td', { textContent: output.key }), made('td', { textContent: output.symbol }), value);
  }));
  by('decisions').textContent = reply.decisions;
  svg_of.sketch = sketch(by('sketch'), reply);
  contact(by('contact'), reply);
  if (curve) show_curve();
}

const current = () => JSON.parse(JSON.stringify(scene));
const three = () => (scene.indenter ?? 'cylinder') !== 'cylinder';
// Points of a curve while a hand moves, and once it rests: fewer of scenes that take long.
const seconds = () => (three() ? 0.05 : 0) + (answer?.answer.seconds ?? 0);
const points_in_motion = () => seconds() < 0.008 ? 61 : seconds() < 0.05 ? 13 : 0;
const points_at_rest = () => three() || seconds() > 0.3 ? 13 : 61;
const dear = () => points_in_motion() < 61;

let busy = null, waiting = false;
async function follow() {
  const began = performance.now(), asked = current();
  by('explanation').hidden = true;
  let latest = true;
  try {
    if (three()) {
      const first = await ask('answer', { scene: asked, coarse: true, wish: wish('answer') });
      show_answer(first);
      measured.first = performance.now() - began;
      if (first.coarse && !waiting) show_answer(await ask('answer', { scene: asked, wish: wish('answer') }));
    } else {
      const number_first = ask('answer', { scene: asked, wish: wish('answer') }).then(show_answer);
      if (!answer) await number_first;  // which tells how long a point of the curve takes
      await Promise.all([number_first, ask_curve(asked, points_in_motion())]);
    }
    say_refusal(null);
  } catch (error) {
    latest = !error.superseded;
    if (latest) say_refusal(error);
  }
  if (latest) times.push(performance.now() - began);
  show_taken();
}

// At most one question is under way and one waits: the newest.
let pause = null;
function changed() {
  by('headline').classList.add('stale');
  if (dear()) for (const view of busy ? ['answer', 'curve'] : ['curve']) ask('newer', { wish: wish(view) });  // gives up what is solved
  if (busy) { waiting = true; return busy; }
  busy = (async () => {
    do {
      waiting = false;
      await follow();
      await new Promise((next) => requestAnimationFrame(next));
    } while (waiting);
    busy = null;
  })();
  clearTimeout(pause);
  pause = setTimeout(rest, 300);
  return busy;
}

// ---- The curve.
function curve_wish() {
  return { x: by('curve-x').value, y: by('curve-y').value, from: number(by('curve-from').value), to: number(by('curve-to').value), logarithmic: by('curve-log').checked };
}

// What a curve belongs to: all of the scene but its x.
const scene_but = (x, one) => JSON.stringify(Object.entries(one).filter(([key]) => key !== x));

async function ask_curve(asked, points) {
  const wanted = { ...curve_wish(), points };
  if (!(wanted.to > wanted.from) || !points) return;
  const found = await ask('curve', { scene: asked, curve: wanted, wish: wish('curve') });
  curve = { ...wanted, points: found.x.map((x, n) => {
    const y = found.y[n], error = found.y_error[n];
    return [x, y, y !== null, y !== null && error !== null ? y - error : null, y !== null && error !== null ? y + error : null];
  }), of: scene_but(wanted.x, asked) };
  show_curve();
}

function show_curve() {
  if (!curve) return;
  const x = input_of(curve.x), y = output_of(curve.y);
  const axes = { x: { name: x.key.replaceAll('_', ' '), unit: unit_of(x), logarithmic: curve.logarithmic }, y: { name: y.key.replaceAll('_', ' '), unit: unit_of(y) } };
  const at = answer ? number(answer.answer.scene[curve.x]) : undefined;
  const kept = pinned.filter((one) => one.x === curve.x && one.y === curve.y);
  const labels = told_apart([answer?.answer.scene ?? {}, ...kept.map((one) => one.scene)], curve.x);
  const curves = [{ label: kept.length ? labels[0] + ' (now)' : '', points: curve.points, colour: colours[0] },
    ...kept.map((one, n) => ({ points: one.points, label: labels[n + 1], colour: colours[(n + 1) % colours.length], dashed: true }))];
  svg_of.curve = draw(by('curve'), in_units({ ...axes, curves, ...(Number.isFinite(at) ? { at } : {}) }));
  const before = curve.of !== scene_but(curve.x, scene);
  by('curve').classList.toggle('stale', before);
  const missing = curve.points.filter((point) => point[1] === null).length;
  by('peak').textContent = (before ? 'Of the scene before; it is drawn anew when the hand rests. ' : '') + peak_in_words(curve, axes.x, axes.y) + (missing ? ' ' + missing + ' of ' + curve.points.length + ' points have no answer.' : '');
}

// Each scene by the inputs in which they differ.
function told_apart(scenes, x) {
  const text = (one, key) => JSON.stringify(one[key]);
  const keys = [...new Set(scenes.flatMap((one) => Object.keys(one)))].filter((key) => key !== x && input_of(key) && scenes.some((one) => text(one, key) !== text(scenes[0], key)));
  return scenes.map((one, n) => keys.slice(0, 3).map((key) => {
    const value = one[key], input = input_of(key);
    return (input.symbol || key) + ' = ' + (typeof value === 'object' ? 'other' : value === undefined ? 'none' : readable(value, unit_of(input), 4));
  }).join(', ') || 'curve ' + (n + 1));
}

function centre_curve() {
  const x = by('curve-x').value, at = number((answer ? answer.answer.scene : held)[x]), input = input_of(x);
  const logarithmic = at > 0 && Number.isFinite(at) && input.highest === null;
  by('curve-log').checked = logarithmic;
  const highest = input.highest ?? (at > 0 ? 3 * at : 1), lowest = input.lowest ?? Math.min(0, 3 * at || 0);
  by('curve-from').value = digits(logarithmic ? at / 30 : lowest, 4);
  by('curve-to').value = digits(logarithmic ? at * 30 : highest, 4);
  by('curve-unit').textContent = typeset(unit_of(input) === '1' ? '' : unit_of(input));
}

// ---- Materials, insides, models, curves of spheres: asked when the hand rests, or on request.
async function rest() {
  await busy;
  if (dear()) by('peak').textContent = 'The curve is being solved.';
  if (dear()) ask_curve(current(), points_at_rest()).catch((error) => error.superseded || notice(error.message));
  return show_materials();
}
async function show_materials() {
  try {
    const found = await ask('materials', { scene: current() });
    by('materials').replaceChildren(...found.charts.map((chart) => {
      const place = made('div', { className: 'picture' });
      const at = found.frequency === null ? undefined : found.frequency / factor_of(chart.x.unit, 'Hz');
      draw(place, { ...chart, ...(at ? { at } : {}) }, { height: 240, words: 'Storage and loss modulus of ' + chart.title });
      return made('div', {}, made('h3', { textContent: chart.title }), place);
    }), made('p', { textContent: found.frequency === null ? '' : 'The contact asks at about ' + readable(found.frequency, 'Hz', 3) + ' (dashed line).' }));
  } catch (error) {
    if (!error.superseded) by('materials').replaceChildren(made('p', { textContent: error.message }));
  }
}

async function explain() {
  try {
    by('explanation').textContent = (await ask('answer', { scene: current(), explain: true, wish: wish('explain') })).explanation;
    by('explanation').hidden = false;
  } catch (error) { say_refusal(error); }
}

async function draw_inside() {
  const figure = by('figure').value, asked = current();
  if (['shear_strain', 'loss_density'].includes(figure)) asked.interior = 'on';
  by('inside').textContent = 'It is being solved and drawn.';
  try {
    const { figure: text } = await ask('answer', { scene: asked, figure, wish: wish('figure') });
    by('inside').replaceChildren(made('img', { alt: figure.replaceAll('_', ' '), src: 'data:image/svg+xml;charset=utf-8,' + encodeURIComponent(text) }));
  } catch (error) { by('inside').textContent = error.message; }
}

// ---- What is taken along.
const study_text = () => {
  const wanted = curve_wish(), axes = { [wanted.x]: { from: wanted.from, to: wanted.to, points: Number(by('study-points').value), ...(wanted.logarithmic ? { spacing: 'logarithmic' } : {}) } };
  const unit = unit_of(input_of(wanted.x));
  if (unit && unit !== '1') for (const end of ['from', 'to']) axes[wanted.x][end] = axes[wanted.x][end] + ' ' + unit;
  const second = by('study-second').value, values = by('study-values').value;
  if (second && values.trim()) axes[second] = values.split(',').map((value) => value.trim()).map((value) => split(value) && split(value)[1].trim() === '' ? Number(value) : value);
  return { study: by('study-name').value.trim(), scene: current(), axes };
};
const takes = {
  scene: () => ['scene.json', JSON.stringify(scene, null, 2) + '\n'],
  command: () => ['command.sh', "cat >scene.json <<'END'\n" + JSON.stringify(scene, null, 2) + '\nEND\nrollres solve scene.json\n'],
  python: () => ['scene.py', 'import rollres\n\nscene = rollres.Scene(' + python(scene) + ')\nanswer = rollres.solve(scene)\nprint(answer.rolling_resistance, answer.rolling_resistance_error)\n'],
  study: () => ['study.json', JSON.stringify(study_text(), null, 2) + '\n'],
  csv: () => ['curve.csv', curve ? curve.x + ',' + curve.y + '\n' + curve.points.map(([x, y]) => x + ',' + (y ?? '')).join('\n') + '\n' : ''],
  svg: () => ['curve.svg', svg_of.curve ? as_file(svg_of.curve) : ''],
  sketch: () => ['sketch.svg', svg_of.sketch ? as_file(svg_of.sketch) : ''],
  json: () => ['answer.json', answer ? JSON.stringify(answer.answer, null, 2) + '\n' : ''],
};
const python = (value) => JSON.stringify(value, null, 4).replace(/\btrue\b/g, 'True').replace(/\bfalse\b/g, 'False').replace(/\bnull\b/g, 'None');
function show_taken() {
  const [name, text] = takes[by('take-as').value]();
  by('taken').textContent = text.length > 20000 ? text.slice(0, 20000) + '…' : text;
  URL.revokeObjectURL(by('save').href);
  by('save').download = name;
  by('save').href = URL.createObjectURL(new Blob([text], { type: 'text/plain' }));
}

// ---- Studies that run.
let watching = null;
async function show_runs() {
  const runs = await ask('runs');
  by('runs').replaceChildren(...runs.map((run) => {
    const far = run.points ? run.answered + ' of ' + run.points + ' points' : 'begins';
    const item = made('li', { textContent: run.study + ': ' + (run.running ? far : run.words.trim()) + ' ' });
    const button = made('button', { type: 'button', textContent: run.running ? 'Stop' : 'Show' });
    button.addEventListener('click', () => run.running ? ask('stop', { study: run.study }).then(show_runs) : show_tab('studies', run.study));
    item.append(button);
    return item;
  }));
  clearTimeout(watching);
  if (runs.some((run) => run.running)) watching = setTimeout(show_runs, 400);
}
async function run_study() {
  try {
    await ask('run', { study: study_text() });
    notice('');
  } catch (error) { notice(error.message); }
  show_runs();
}

// ---- The frame.
function show_tab(name, study) {
  for (const tab of ['scene', 'studies']) {
    by('tab-' + tab).setAttribute('aria-selected', String(tab === name));
    by('tab-' + tab).tabIndex = tab === name ? 0 : -1;
    by('view-' + tab).hidden = tab !== name;
  }
  if (name === 'studies') studies.show(study);
}
function begin_with(other) {
  scene = Object.fromEntries(Object.entries(other).filter(([key, value]) => input_of(key)?.default !== value));
  rebuild();
  show_tab('scene');
  return changed();
}
const studies = new Studies(by, made, ask, begin_with, notice);

async function begin() {
  const start = await ask('start');
  quantities = start.quantities;
  scene = start.scene;
  delete scene.comment;
  tables = quantities.tables.map((key) => ({ key, symbol: '', unit: '', unit_2d: '', meaning: 'a CSV file below the folder of the program', rule: '' }));
  ask('files').then(({ files }) => by('files').append(...files.map((file) => made('option', { value: file }))));
  rebuild();
  for (const input of quantities.inputs) {
    if (input.real) by('curve-x').append(made('option', { value: input.key, textContent: input.key.replaceAll('_', ' ') }));
    if (input.real || input.choices) by('study-second').append(made('option', { value: input.key, textContent: input.key.replaceAll('_', ' ') }));
  }
  by('study-second').prepend(made('option', { value: '', textContent: 'nothing else', selected: true }));
  for (const output of quantities.outputs) by('curve-y').append(made('option', { value: output.key, textContent: output.key.replaceAll('_', ' ') }));
  for (const figure of quantities.figures) by('figure').append(made('option', { value: figure, textContent: figure.replaceAll('_', ' ') }));
  by('curve-x').value = 'speed';
  by('curve-y').value = 'rolling_resistance';
  held = start.held;
  centre_curve();
  by('curve-x').addEventListener('change', () => { centre_curve(); changed(); });
  for (const id of ['curve-y', 'curve-from', 'curve-to', 'curve-log']) by(id).addEventListener('change', () => changed());
  by('pin').addEventListener('click', () => {
    if (!curve) return;
    pinned.push({ ...curve, scene: answer?.answer.scene ?? {} });
    by('unpin').hidden = false;
    show_curve();
  });
  by('unpin').addEventListener('click', () => { pinned = []; by('unpin').hidden = true; show_curve(); });
  by('explain').addEventListener('click', explain);
  by('draw').addEventListener('click', draw_inside);
  by('run').addEventListener('click', run_study);
  by('take-as').addEventListener('change', show_taken);
  for (const id of ['study-name', 'study-points', 'study-second', 'study-values']) by(id).addEventListener('change', show_taken);
  by('copy').addEventListener('click', () => navigator.clipboard.writeText(takes[by('take-as').value]()[1]));
  by('welcome-close').addEventListener('click', () => by('welcome').remove());
  by('inputs').addEventListener('submit', (event) => event.preventDefault());
  for (const [one, other] of [['scene', 'studies'], ['studies', 'scene']]) {
    by('tab-' + one).addEventListener('click', () => show_tab(one));
    by('tab-' + one).addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowRight' && event.key !== 'ArrowLeft') return;
      show_tab(other);
      by('tab-' + other).focus();
    });
  }
  await changed();
  document.documentElement.dataset.ready = 'yes';
}
window.rollres = { measured, idle: () => busy === null && document.documentElement.dataset.ready === 'yes' };
begin().catch((error) => notice(error.message));
