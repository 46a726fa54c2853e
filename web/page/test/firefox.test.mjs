// The page in Debian's Firefox: each kind of page says there what it says in Chromium, its proofs hold, its keys and its picture work.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { flat, folder, inStart, land, open, run, skip as skipChromium, startArm, startFirefox } from './browser.mjs';

const firefox = skipChromium || (await startFirefox()), skip = typeof firefox === 'string' ? firefox : false;
after(() => skip || firefox.close());

const kinds = {
  'fox-check': ['check', inStart('assembly.json')],
  'fox-run': ['run', inStart('assembly.json'), '--motion', inStart('motion.csv'), '--margin', '2', '--continuous', '-o', 'fox.csv'],
  'fox-states': ['robot', 'check', ...startArm, '--states', inStart('states.csv')],
  'fox-path': ['robot', 'path', ...startArm, '--states', inStart('straight.csv')],
};

/** What a page says: every text of it. */
const read = (page) => page.$$eval('h1, header p, #verdict, #pairs tr, #legend, #now, #labels .label', (nodes) => nodes.map((node) => node.textContent));

/** How much of the picture is drawn. */
const measurePicture = (page) => page.evaluate(() => {
  const { view } = window.ovoidPage, copy = document.createElement('canvas'), context = copy.getContext('2d');
  view.drawNow();
  Object.assign(copy, { width: 200, height: 150 });
  context.drawImage(view.canvas, 0, 0, 200, 150);
  return context.getImageData(0, 0, 200, 150).data.filter((x, i) => i % 4 === 3 && x > 0).length;
});

test('Firefox: each kind of page says what it says in Chromium, and draws as much', { skip }, async () => {
  for (const [name, args] of Object.entries(kinds)) {
    run(...args, '--html', `${name}.html`);
    const here = await open(`${name}.html`, firefox), there = await open(`${name}.html`, flat);
    await Promise.all([land(here.page), land(there.page)]);
    assert.deepEqual(await read(here.page), await read(there.page), name);
    const [drawn, wanted] = [await measurePicture(here.page), await measurePicture(there.page)];
    assert.ok(Math.abs(drawn / wanted - 1) < 0.05, `${name}: ${drawn} and ${wanted} pixels`);
    assert.deepEqual(here.errors, []);
    await here.page.close();
    await there.page.close();
  }
});

test('Firefox: all proofs hold; sliders, keys and a phone', { skip }, async () => {
  const { page, errors } = await open('fox-check.html', firefox);
  await page.click('#check-all');
  await page.waitForFunction(() => document.getElementById('checked').className);
  assert.equal(await page.textContent('#checked'), '9 of 9 proofs hold');
  await page.click('#pairs tr:nth-child(3)');
  await page.keyboard.press('p');
  assert.equal(await page.textContent('#proof'), 'The proof holds.');
  await page.keyboard.press('?');
  assert.ok(await page.isVisible('#keys'));
  await page.keyboard.press('Escape');
  await page.setViewportSize({ width: 390, height: 844 });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390));
  const robot = await open('fox-states.html', firefox);
  await robot.page.focus('#joints input[type="range"]');
  await robot.page.keyboard.press('ArrowRight');
  assert.equal(await robot.page.inputValue('input[aria-label="shoulder, rad"]'), '0.01');
  assert.deepEqual([...errors, ...robot.errors], []);
  await page.close();
  await robot.page.close();
});

test('Firefox: a body is dragged by its handles, and its pairs are asked anew', { skip }, async () => {
  writeFileSync(join(folder, 'fox-drag.json'), JSON.stringify({ unit: 'm', objects: [{ name: 'a', box: [1, 1, 1] }, { name: 'b', sphere: 0.5, pose: { xyz: [2, 0, 0] } }] }));
  run('check', 'fox-drag.json', '--html', 'fox-drag.html');
  const { page, errors } = await open('fox-drag.html', firefox);
  await page.evaluate(() => window.ovoidPage.chooseBody(window.ovoidPage.model.bodies[1]));
  await page.click('#move');
  await land(page);
  const [x, y] = await page.evaluate(() => {
    const { view } = window.ovoidPage, at = view.handle.position.clone().project(view.camera), box = view.canvas.getBoundingClientRect();
    return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y - 20, { steps: 4 });
  await page.mouse.up();
  const [isLive, lower, from] = await page.evaluate(() => [window.ovoidPage.model.pairs[0].isLive, window.ovoidPage.model.pairs[0].answer.lower, window.ovoidPage.model.pairs[0].given.lower]);
  assert.ok(isLive && lower !== from, `${lower} ${from}`);
  assert.deepEqual(errors, []);
  await page.close();
});
