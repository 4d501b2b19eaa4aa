// What is wrong with a report (`report`, its text), at three widths: lines of #found, "done" at the end.
const contrast = (one, other) => {
  const light = (colour) => {
    const parts = colour.match(/[0-9.]+/g).map(Number).slice(0, 3).map((part) => part / 255)
      .map((part) => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
  };
  const [a, b] = [light(one), light(other)].sort((x, y) => y - x);
  return (a + 0.05) / (b + 0.05);
};
const faults = (view, width) => {
  const page = view.document, found = [], all = [...page.body.querySelectorAll('*')];
  const say = (text) => found.push('fault at ' + width + ' px: ' + text);
  if (page.documentElement.scrollWidth > page.documentElement.clientWidth) say('the page is wider than the screen');
  const behind = (node) => {
    for (; node; node = node.parentElement) {
      const colour = view.getComputedStyle(node).backgroundColor;
      if (!/, 0\)$/.test(colour)) return colour;
    }
    return 'rgb(255, 255, 255)';
  };
  for (const node of all) {
    const text = [...node.childNodes].some((child) => child.nodeType === 3 && child.textContent.trim());
    const box = node.getBoundingClientRect();
    if (!text || box.width === 0 || node.closest('svg')) continue;
    const ratio = contrast(view.getComputedStyle(node).color, behind(node));
    if (ratio < 4.5) say('contrast ' + ratio.toFixed(2) + ': ' + node.textContent.slice(0, 40));
    if (box.right > page.documentElement.clientWidth + 1 && !node.closest('.table')) say('cut off: ' + node.textContent.slice(0, 40));
  }
  for (const image of page.images) {
    if (!image.complete || image.naturalWidth === 0) say('a picture is not drawn: ' + image.alt);
    if (!image.alt) say('a picture without words');
  }
  let level = 0;
  for (const head of page.querySelectorAll('h1, h2, h3')) {
    if (Number(head.tagName[1]) > level + 1) say('a heading too deep: ' + head.textContent);
    level = Number(head.tagName[1]);
  }
  if (page.querySelectorAll('h1').length !== 1) say('not one h1');
  for (const button of page.querySelectorAll('button')) if (!button.textContent.trim()) say('a button without words');
  const ids = [...page.querySelectorAll('[id]')].map((node) => node.id);
  if (new Set(ids).size !== ids.length) say('one id twice');
  const zoomed = [...page.querySelectorAll('.zooms')];
  zoomed.forEach((figure, number) => {
    const layer = figure.querySelector('.points'), box = layer.getBoundingClientRect();
    const at = (type, x, y, kind) => layer.dispatchEvent(new view.PointerEvent(type, { bubbles: true, cancelable: true,
      pointerType: kind || 'mouse', button: 0, clientX: box.left + x * box.width, clientY: box.top + y * box.height }));
    const numbers = () => [...layer.querySelectorAll('.axes text')].map((text) => text.textContent);
    const marks = () => [...layer.querySelectorAll('circle')].map((mark) => mark.getAttribute('cx') + ' ' + mark.getAttribute('cy')).join();
    const before = marks();
    const drag = (from, to, kind) => { at('pointerdown', ...from, kind); at('pointermove', ...to, kind); at('pointerup', ...to, kind); };
    drag([0.4, 0.4], [0.6, 0.7], 'touch');
    if (figure.classList.contains('zoomed')) say('a finger zooms');
    drag([0.4, 0.5], [0.402, 0.5]);
    if (figure.classList.contains('zoomed')) say('a click zooms');
    drag([0.4, 0.4], [0.6, 0.7]);
    if (!figure.classList.contains('zoomed')) return say('figure ' + number + ': no zoom');
    const first = numbers();
    if (first.length < 5) say('figure ' + number + ': few numbers: ' + first);
    if (marks() === before) say('the points stay');
    drag([0.5, 0.5], [0.7, 0.5]);
    if (numbers().join() === first.join()) say('no second zoom');
    layer.dispatchEvent(new view.MouseEvent('dblclick', { bubbles: true }));
    if (figure.classList.contains('zoomed') || layer.querySelector('.axes')) say('a double click does not go back');
    const after = marks().split(/[ ,]/).map(Number), was = before.split(/[ ,]/).map(Number);
    if (after.some((value, i) => Math.abs(value - was[i]) > 1e-6)) say('the points do not come back');
  });
  found.push(width + ' px: ' + zoomed.length + ' charts zoom, ' + page.images.length + ' pictures, ' +
    (view.matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'));
  return found;
};
const widths = [400, 768, 1200];
let waiting = widths.length;
for (const width of widths) {
  const frame = document.createElement('iframe');
  frame.style = 'border: 0; height: 900px; width: ' + width + 'px';
  frame.addEventListener('load', () => setTimeout(() => {
    document.querySelector('#found').append(faults(frame.contentWindow, width).join('\n') + '\n');
    if (--waiting === 0) document.querySelector('#found').append('done\n');
  }, 200));
  frame.srcdoc = report;
  document.body.append(frame);
}
