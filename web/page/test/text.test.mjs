// What the page says in numbers, without a browser: what is called proven is not more than is proven.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { describeAnswer, formatGlance, labelAnswer } from '../src/text.mjs';

const apart = (lower, upper) => describeAnswer({ status: 'separated', lower, upper }, 'mm');
const deep = (lower, upper) => describeAnswer({ status: 'overlapping', lower, upper }, 'mm');

test('a proven figure is not rounded up', () => {
  assert.equal(apart(1.69857, 1.69857), 'are 1.69 mm apart, proven');
  assert.equal(apart(1.69857, 1.698571), 'are 1.69 mm apart, proven');
  assert.equal(apart(1.996, 2.004), 'are 1.99 mm apart, proven'); // both ends round to 2
  assert.equal(apart(9.996, 9.996), 'are 9.99 mm apart, proven');
  assert.equal(deep(-1.69857, -1.69857), 'overlap by 1.69 mm, proven');
  assert.equal(labelAnswer({ status: 'separated', lower: 1.69857, upper: 1.69857 }, 'mm'), '1.69 mm');
  assert.equal(apart(1.69857, Infinity), 'are at least 1.69 mm apart, proven');
  assert.equal(apart(1.69857, 1.8), 'are 1.69 to 1.8 mm apart, proven');
});

test('round numbers stay round where the bracket is as narrow as rounding makes it', () => {
  assert.equal(apart(0.5, 0.5), 'are 0.5 mm apart, proven');
  assert.equal(apart(0.5 - 1e-12, 0.5 + 1e-12), 'are 0.5 mm apart, proven');
  assert.equal(apart(1.702, 1.703), 'are 1.7 mm apart, proven');
});

test('of a time both ends are proven, and the nearest number stands', () => {
  assert.equal(formatGlance(0.33389, 0.3339, ''), '0.334');
  assert.equal(formatGlance(0.3, 0.4, ''), '0.3 to 0.4');
});

test('many brackets: the figure is at most the lower end, within rounding', () => {
  for (let i = 1; i < 2000; i++) {
    const lower = (i * 0.61803398875) % 10 + 1e-3, upper = lower * (1 + 10 ** -(1 + (i % 12))), [figure] = apart(lower, upper).match(/\d[\d.e-]*/);
    assert.ok(Number(figure) <= lower + 1e-6 * upper && Number(figure) >= lower * 0.99, `${figure} of ${lower} to ${upper}`);
  }
});
