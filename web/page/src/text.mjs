// Numbers and names as text.

/** A name with its middle left out where it is longer; without signs that would break lines or turn their direction. */
export function shorten(name, most = 100) {
  const text = name.length > 4 * most ? `${name.slice(0, 2 * most)}${name.slice(-2 * most)}` : name, all = Array.from(text.replace(/[\p{Cc}\u2028-\u202e\u2066-\u2069]/gu, ' ')), end = Math.floor(most / 3);
  return all.length <= most && text === name ? all.join('') : `${all.slice(0, most - end - 1).join('')}…${all.slice(-end).join('')}`;
}

/** A length with the digits that are known, and its unit. */
export function formatLength(x, unit, digits = 6) {
  if (!Number.isFinite(x)) return x > 0 ? '∞' : '-∞';
  if (x === 0) x = 0; // one sign of zero
  const text = x === 0 || (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e6) ? String(Number(x.toPrecision(digits))) : Number(x.toPrecision(digits)).toExponential();
  return unit ? `${text} ${unit}` : text;
}

// The next number of so many digits that is not less than x (way 1), or not greater (way -1).
function roundOut(x, digits, way) {
  const rounded = Number(x.toPrecision(digits));
  return !Number.isFinite(x) || way * (rounded - x) >= 0 ? rounded : Number((x + way * 10 ** (Math.floor(Math.log10(Math.abs(x))) - digits + 1)).toPrecision(digits));
}

// Both ends of a bracket, rounded away from one another.
const formatEnds = (low, high, unit, digits) => `${formatLength(roundOut(low, digits, -1), '', digits)} to ${formatLength(roundOut(high, digits, 1), unit, digits)}`;

/** A bracket with its equal digits written once: the middle and half the width, rounded so that both ends are within. */
export function formatMiddle(lower, upper, unit) {
  if (!Number.isFinite(lower) || !Number.isFinite(upper)) return `${formatLength(lower, '')} to ${formatLength(upper, unit)}`;
  const half = (upper - lower) / 2, most = Math.max(Math.abs(lower), Math.abs(upper));
  if (half === 0) return formatLength(lower, unit, 15);
  // Data that were altered may have their ends turned round.
  if (half < 0) return `${formatLength(lower, '')} to ${formatLength(upper, unit)}`;
  const digits = Math.min(15, Math.max(2, Math.ceil(Math.log10(most / half)) + 1)), middle = Number(((lower + upper) / 2).toPrecision(digits));
  // What the rounding of the differences may add.
  const off = Math.max(upper - middle, middle - lower) + most * 2 ** -52;
  return `${middle} ± ${roundOut(off, 2, 1)}${unit ? ` ${unit}` : ''}`;
}

/** A bracket of a distance in words: one number where it is narrow, 0 where bodies touch. */
export function formatBracket({ status, lower, upper }, unit) {
  if (status === 'touching') return formatLength(0, unit);
  const most = Math.max(Math.abs(lower), Math.abs(upper)), width = upper - lower;
  if (width <= 1e-5 * most) return formatLength(lower, unit);
  return width <= 0.05 * most ? formatMiddle(lower, upper, unit) : formatEnds(lower, upper, unit, 3);
}

// Three digits say all of a bracket that a glance needs.
const isNarrow = (low, high) => low.toPrecision(3) === high.toPrecision(3) || high - low <= 1e-4 * high;

/** A number > 0 in a bracket, to be read at a glance: three digits where both ends round to them. */
export const formatGlance = (low, high, unit) => (isNarrow(low, high) ? formatLength((low + high) / 2, unit, 3) : formatEnds(low, high, unit, 3));

// Three digits that are not more than the proven lower end; of a bracket as narrow as rounding makes it, the round number within.
function roundProven(low, high) {
  const near = Number(((low + high) / 2).toPrecision(3));
  return near <= low || (near <= high && high - low <= 1e-6 * high) ? near : roundOut(low, 3, -1);
}

/** A length > 0 of which the lower end is what is proven, to be read at a glance: it is not rounded up. */
export function formatProven(low, high, unit) {
  if (high === Infinity) return `at least ${formatLength(roundOut(low, 3, -1), unit, 3)}`;
  return isNarrow(low, high) ? formatLength(roundProven(low, high), unit, 3) : formatEnds(low, high, unit, 3);
}

/** How two bodies are, in words that follow their names. */
export function describeAnswer({ status, lower, upper }, unit) {
  switch (status) {
    case 'separated': return `are ${formatProven(lower, upper, unit)} apart, proven`;
    case 'touching': return 'touch, proven';
    case 'overlapping': return upper < 0 ? `overlap by ${formatProven(-upper, -lower, unit)}, proven` : 'overlap, proven';
    default: return Number.isFinite(lower) || Number.isFinite(upper) ? `are not proven apart or touching: the distance is from ${formatEnds(lower, upper, unit, 3)}` : 'are not compared';
  }
}

/** The same on a label. */
export function labelAnswer({ status, lower, upper }, unit) {
  if (status === 'separated') return formatProven(lower, upper, unit);
  if (status === 'touching') return 'touching';
  if (status === 'overlapping') return upper < 0 ? `overlap ${formatProven(-upper, -lower, unit)}` : 'overlap';
  return '?';
}

/** What a bracket alone says of two bodies, in words that follow their names. */
export function describeBracket({ lower, upper }, unit) {
  return describeAnswer({ status: upper < 0 ? 'overlapping' : lower > 0 ? 'separated' : 'undecided', lower, upper }, unit);
}

/** What meets in a contact, by how much, and over which area. */
export function describeContact({ axis, lower, upper, status, inner, outer, corners, points, part_a, part_b }, unit) {
  const distance = formatBracket({ lower, upper, status }, unit), parts = part_a || part_b ? `, parts ${part_a} and ${part_b}` : '';
  const area = corners > 2 ? `, area ${outer - inner <= 1e-6 * outer ? formatLength(inner, '') : `${formatLength(inner, '')} to ${formatLength(outer, '')}`}${unit ? ` ${unit}²` : ''}` : '';
  const count = points.length === corners ? `${corners} point${corners === 1 ? '' : 's'}` : `${points.length} of ${corners} points`;
  return `by ${axis}, ${count}: ${distance}${area}${parts}`;
}

const VERTEX_B = 0x40000000, CROSSING = 0x80000000, NEAREST = 0xc0000000;

/** What stays the same while a point of contact does. */
export function describeId(id) {
  if (id >= NEAREST) return 'nearest';
  if (id >= CROSSING) return `edges ${Math.floor((id - CROSSING) / 32768)}, ${(id - CROSSING) % 32768}`;
  return id >= VERTEX_B ? `vertex ${id - VERTEX_B} of b` : `vertex ${id} of a`;
}
