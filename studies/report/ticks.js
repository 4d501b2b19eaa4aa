// SVG's elements, and the numbers of an axis: of reports and of the page of `rollres explore`.
const element = (name, attributes, text) => {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
};
const raised = (power) => '10' + String(power).replace(/./g, (sign) => '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079'[sign] || '\u207b');
const shown = (number, step) => {
  const size = Math.abs(number);
  if (size < step * 1e-6) return '0';
  if (size < 1e-4 || size >= 1e6) return String(Number(number.toPrecision(6)));
  return number.toFixed(Math.max(0, Math.min(9, -Math.floor(Math.log10(step) + 1e-9))));
};
const ticks = (low, high, logarithmic) => {  // the numbers of an axis, each with its text
  const decades = Math.log10(high / low), found = [];
  if (logarithmic && decades > 0.7) {
    const steps = decades > 3 ? [1] : decades > 1.5 ? [1, 3] : [1, 2, 5], each = Math.ceil(decades / 6);
    for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power)
      for (const step of power % each === 0 ? steps : []) {
        const number = step * 10 ** power;
        if (number < low || number > high) continue;
        found.push([number, decades > 5 ? raised(power) : shown(number, number)]);
      }
    return found;
  }
  const rough = (high - low) / 4, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (rough >= 5 * power ? 5 : rough >= 2 * power ? 2 : 1);
  for (let count = Math.ceil(low / step - 1e-9); count * step <= high * (1 + 1e-12) + step * 1e-9; ++count)
    found.push([count * step, shown(count * step, step)]);
  return found.length > 7 ? found.filter(([number]) => Math.round(number / step) % 2 === 0) : found;
};
