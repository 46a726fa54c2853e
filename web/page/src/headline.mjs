// What the page shows in one sentence: the nearest pair by name, what became of a motion.
import { describeAnswer, formatGlance, formatLength, formatMiddle } from './text.mjs';

const nameBoth = ({ a, b }) => `${a.name} and ${b.name}`;

// The pair of the least distance; of a motion in the frame where that is.
export function findNearest(pairs, answerOf) {
  return pairs.reduce((best, pair) => {
    const answer = answerOf(pair);
    return answer && (!best || answer.lower < answerOf(best).lower) ? pair : best;
  }, null);
}

// How many pairs are proven to touch, or to be within the margin, at the beginning; '' for none, or where it is not asked about.
function describeBegin(pairs, margin, unit) {
  const isNear = ({ status, upper }) => (margin > 0 ? upper <= margin : status === 'overlapping' || status === 'touching'), count = pairs.filter(({ begin }) => begin && isNear(begin)).length;
  return count ? `${count === 1 ? '1 pair is' : `${count} pairs are`} ${margin > 0 ? `within ${formatLength(margin, unit, 3)}` : 'touching'} from the beginning` : '';
}

// The first time that bodies touch, or come within the margin, of a motion.
function describeFirst({ data: { motion }, pairs, bodies, unit }) {
  const begun = describeBegin(pairs, motion.margin, unit), first = (motion.events ?? []).filter(({ kind }) => kind === 'impact' || kind === 'contact').reduce((best, e) => (best && best.time <= e.time ? best : e), null);
  if (!first) return begun && `${begun}. `;
  const what = first.kind === 'impact' && motion.margin > 0 ? `come within ${formatLength(motion.margin, unit, 3)}` : 'touch', names = nameBoth({ a: bodies[first.a], b: bodies[first.b] });
  const at = first.kind === 'impact' ? `at t = ${first.from > 0 ? formatGlance(first.from, first.time, '') : formatMiddle(first.from, first.time, '')}` : `at t = ${formatLength(first.time, '', 4)}, the first of the frames`;
  return `${begun}${begun ? '; then ' : ''}${names} ${begun ? '' : 'first '}${what} ${at}${first.kind === 'impact' ? ', proven' : ''}. `;
}

/** The headline; null of a robot, whose verdict has its own. */
export function describeScene(model) {
  const { data, pairs, bodies, unit } = model, { motion } = data;
  if (data.robot) return null;
  const nearest = findNearest(pairs, (pair) => pair.given);
  if (!nearest) {
    const isAll = typeof data.margin === 'number' && bodies.length > 1 && !data.left_out?.pairs;
    if (bodies.length === 1) return `One body${bodies[0].parts.length > 1 ? ` of ${bodies[0].parts.length} convex parts` : bodies[0].isSolid ? ', a solid' : ''}; there is no pair.`;
    return isAll ? `No pair is within ${formatLength(data.margin, unit, 4)}${motion ? ' at any frame' : ''}: each is proven farther apart.` : '';
  }
  const said = describeAnswer(nearest.given, unit);
  if (motion) return `${describeFirst(model)}${pairs.length > 1 ? (nearest.given.status === 'overlapping' ? 'Deepest: ' : 'Nearest: ') : ''}${nameBoth(nearest)} ${said}, at t = ${formatLength(motion.times[nearest.frame], '', 4)}.`;
  const others = pairs.length > 1 ? (nearest.given.status === 'overlapping' ? ', the deepest of all pairs' : ', the nearest of all pairs') : '';
  return `${nameBoth(nearest)} ${said}${others}.`;
}

/** How many pairs are what. */
export function countPairs(pairs) {
  const count = (status) => pairs.filter(({ given, answer }) => (given ?? answer).status === status).length;
  const words = [['overlapping', 'overlap'], ['touching', 'touch'], ['undecided', 'not proven'], ['separated', 'apart']];
  return words.map(([status, word]) => [count(status), word]).filter(([n]) => n).map(([n, word]) => `${n} ${word}`).join(', ');
}
