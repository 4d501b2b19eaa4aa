// Numbers with units as people write and read them. Values that are sent keep the text that was written: the program
// reads the units.
const prefixes = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n']];

export const digits = (value, count = 5) => {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) return String(Number(value.toPrecision(count)));
  return value.toExponential(count - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
};

// 0.05 and "m/s" become { number: 50, unit: "mm/s" }.
export const scaled = (value, unit) => {
  if (!/^(m|s|N|Pa|W|Hz|J)(?![0-9])/.test(unit) || value === 0 || !Number.isFinite(value)) return { factor: 1, unit: unit === '1' ? '' : unit };
  const size = Math.abs(value), [factor, letter] = prefixes.find(([step]) => size >= step * 0.99999) || prefixes[prefixes.length - 1];
  return { factor, unit: letter + unit };
};

// 1000 of "kHz".
export const factor_of = (scaled_unit, unit) => (prefixes.find(([, letter]) => letter + unit === scaled_unit) ?? [1])[0];

export const typeset = (unit) => unit.replace(/\./g, '·').replace(/([a-zA-Z])(-?)([0-9])/g, (_, letter, minus, power) =>
  letter + (minus ? '⁻' : '') + '⁰¹²³⁴⁵⁶⁷⁸⁹'[power]);

export const readable = (value, unit, count = 5) => {
  if (value === null || value === undefined) return '–';
  if (typeof value === 'string') return value;
  const scale = scaled(value, unit);
  return digits(value / scale.factor, count) + (scale.unit ? ' ' + typeset(scale.unit) : '');
};

// "357.51 ± 0.55 N/m".
export const with_error = (value, error, unit) => {
  const scale = scaled(value, unit);
  return digits(value / scale.factor) + ' ± ' + digits(error / scale.factor, 2) + ' ' + typeset(scale.unit);
};

// "50 mm/s" becomes [50, " mm/s"]; null where no number begins the text.
export const split = (text) => {
  const found = /^\s*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)(.*)$/.exec(String(text));
  return found ? [Number(found[1]), found[2]] : null;
};

// Of an answer's scene, whose numbers are in SI; NaN for what is absent.
export const number = (value) => {
  if (typeof value === 'number') return value;
  if (value === 'infinite') return Infinity;
  const parts = value === undefined || value === null ? null : split(value);
  return parts ? parts[0] : NaN;
};
