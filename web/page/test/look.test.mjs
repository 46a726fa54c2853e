// How the page looks to one who sees it for the first time: headlines, labels, marks, names of any length, keys, paper; and that
// axe-core finds nothing in it, nor html-validate.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { test } from 'node:test';
import { alter, browser, flat, folder, inStart, land, open, run, skip, startArm } from './browser.mjs';

const need = createRequire(process.env.PLAYWRIGHT ?? import.meta.url);
const cell = { unit: 'm', objects: [
  { name: 'camel', box: [1, 1, 1] }, { name: 'mushroom', sphere: 0.5, pose: { xyz: [1.199, 0, 0] } }, { name: 'shelf', box: [1, 1, 0.1], pose: { xyz: [0, 0, 3] } },
] };
const write = (name, objects) => writeFileSync(join(folder, name), JSON.stringify(objects));
const at = (page, call) => page.evaluate(call);

test('the headline says in words what is proven of the nearest pair', { skip }, async () => {
  const ball = (x) => ({ objects: [{ name: 'a', sphere: 1 }, { name: 'b', sphere: 1, pose: { xyz: [x, 0, 0] } }] });
  for (const [scene, args, said] of [
    [cell, [], 'camel and mushroom are 0.199 m apart, proven, the nearest of all pairs.'],
    [ball(2.5), [], 'a and b are 0.5 apart, proven.'],
    [ball(1.75), [], 'a and b overlap by 0.25, proven.'],
    [ball(9), ['--margin', '0.5'], 'No pair is within 0.5: each is proven farther apart.'],
  ]) {
    write('headline.json', scene);
    run('check', 'headline.json', ...args, '--html', 'headline.html');
    const { page, errors } = await open('headline.html', flat);
    assert.equal(await page.textContent('#headline'), said);
    assert.deepEqual(errors, []);
    await page.close();
  }
  // The sentence comes from the bracket: another bracket, another sentence.
  write('headline.json', ball(2.5));
  run('check', 'headline.json', '--html', 'headline.html');
  for (const [change, said] of [
    [{ lower: 0.25, upper: 0.75 }, 'a and b are 0.25 to 0.75 apart, proven.'],
    [{ lower: 0.25, upper: null }, 'a and b are at least 0.25 apart, proven.'],
    [{ status: 'undecided', lower: -0.5, upper: 0.5 }, 'a and b are not proven apart or touching: the distance is from -0.5 to 0.5.'],
    [{ status: 'touching', lower: -1e-12, upper: 1e-12 }, 'a and b touch, proven.'],
    [{ status: 'overlapping', lower: null, upper: -0.125 }, 'a and b overlap by at least 0.125, proven.'],
  ]) {
    alter('headline.html', (data) => Object.assign(data.pairs[0].answer, change));
    const { page } = await open('altered.html', flat);
    assert.equal(await page.textContent('#headline'), said);
    await page.close();
  }
});

test('the digits of a bracket are written once, and its ends are within', { skip }, async () => {
  write('digits.json', cell);
  run('check', 'digits.json', '--html', 'digits.html');
  for (const [lower, upper, said] of [[0.19899999, 0.19900001, '0.199 ± 1.1e-8 m'], [1.5, 1.5, '1.5 m'], [0.125, 0.625, '0.38 ± 0.26 m'], [-3.7033e-4, -2.2587e-4, '-0.0003 ± 0.000075 m'], [1, 0.5, '1 to 0.5 m']]) {
    alter('digits.html', (data) => Object.assign(data.pairs[0].answer, { lower, upper }));
    const { page } = await open('altered.html', flat);
    await at(page, () => window.ovoidPage.choosePair(window.ovoidPage.model.pairs[0]));
    assert.equal(await page.textContent('#middle'), said);
    const [, middle, half] = said.match(/^(\S+) ± (\S+)/) ?? [];
    if (half) assert.ok(Number(middle) - Number(half) <= lower && Number(middle) + Number(half) >= upper, said);
    assert.deepEqual(await at(page, () => ['lower', 'upper'].map((id) => parseFloat(document.getElementById(id).textContent))), [lower, upper]);
    await page.close();
  }
});

test('labels name the bodies where they fit; the nearest pair is marked; what is chosen keeps its colour', { skip }, async () => {
  write('look.json', cell);
  run('check', 'look.json', '--html', 'look.html');
  const readLabels = (page) => page.$$eval('#labels .label', (labels) => labels.map((label) => label.textContent).sort());
  for (const where of [browser, flat]) {
    const { page, errors } = await open('look.html', where);
    await land(page);
    assert.deepEqual(await readLabels(page), ['0.199 m', 'camel', 'mushroom', 'shelf']);
    const boxes = await page.$$eval('#labels .label', (labels) => labels.map((label) => label.getBoundingClientRect()).map(({ left, right, top, bottom }) => [left, right, top, bottom]));
    boxes.forEach(([l, r, t, b], i) => boxes.slice(i + 1).forEach(([l2, r2, t2, b2]) => assert.ok(r <= l2 || r2 <= l || b <= t2 || b2 <= t, 'no label covers another')));
    assert.equal(await page.$eval('tr.marked', (row) => row.firstChild.textContent), 'camel – mushroom');
    // The colour that the canvas has most of, before and after: the outline is added.
    const read = () => at(page, () => {
      const { view } = window.ovoidPage, copy = document.createElement('canvas'), context = copy.getContext('2d', { willReadFrequently: true }), seen = { chosen: 0, own: 0 };
      view.drawNow();
      Object.assign(copy, { width: view.canvas.width, height: view.canvas.height });
      context.drawImage(view.canvas, 0, 0);
      const { data } = context.getImageData(0, 0, copy.width, copy.height);
      for (let i = 0; i < data.length; i += 4) {
        const [r, g, b] = data.subarray(i, i + 3);
        if (r > 180 && g < 60 && b > 60 && b < 180) seen.chosen++;
        if (data[i + 3] && b > r + 20 && b > g) seen.own++;
      }
      return seen;
    });
    const before = await read();
    await at(page, () => window.ovoidPage.chooseBody(window.ovoidPage.model.bodies[0]));
    await land(page);
    const after = await read();
    assert.equal(before.chosen, 0);
    assert.ok(after.chosen > 200, `an outline of ${after.chosen} pixels`);
    assert.ok(before.own > 5000 && after.own > 0.9 * before.own, `${before.own} pixels of its colour, ${after.own} when it is chosen`);
    await page.keyboard.press('l');
    await land(page);
    assert.deepEqual(await readLabels(page), []);
    assert.deepEqual(errors, []);
    await page.close();
  }
});

test('names of any length are cut, and are no other sign than they look', { skip }, async () => {
  const name = `${'long '.repeat(60000)}end`;
  write('long.json', { objects: [{ name, box: [1, 1, 1] }, { name: 'left\u202eright\nbelow', box: [1, 1, 1], pose: { xyz: [3, 0, 0] } }] });
  run('check', 'long.json', '--html', 'long.html');
  const { page, errors } = await open('long.html', flat);
  const text = await page.textContent('body > main');
  assert.ok(text.length < 20000, `${text.length} signs are shown`);
  assert.match(await page.textContent('#pairs td'), /^long long .*….*end – left right below$/);
  assert.ok(await at(page, () => document.documentElement.scrollWidth <= innerWidth));
  await at(page, () => window.ovoidPage.chooseBody(window.ovoidPage.model.bodies[0]));
  await page.click('#whole-name summary');
  assert.equal(await page.inputValue('#whole-name textarea'), name);
  await at(page, () => window.ovoidPage.chooseBody(window.ovoidPage.model.bodies[1]));
  assert.deepEqual(errors, []);
  await page.close();
});

test('joints take numbers; keys do what the list of keys says', { skip }, async () => {
  run('robot', 'check', ...startArm, '--states', inStart('states.csv'), '--html', 'joints.html');
  const { page, errors } = await open('joints.html', flat);
  const field = page.locator('input[aria-label="shoulder, rad"]'), shoulder = () => at(page, () => window.ovoidPage.joints.q[0]);
  await field.fill('word');
  await page.keyboard.press('Enter');
  assert.equal(await field.inputValue(), '0', 'what is no number is not taken');
  for (const text of ['0,25', '0.5']) {
    await field.fill(text);
    await page.keyboard.press('Enter');
    assert.equal(await shoulder(), Number(text.replace(',', '.')));
  }
  for (const [input, key, by] of [['#joints input[type="range"]', 'ArrowRight', 0.01], ['#joints input[type="range"]', 'PageDown', -0.1], ['input.value', 'ArrowUp', 0.01]]) {
    const before = await shoulder();
    await page.focus(input);
    await page.keyboard.press(key);
    assert.ok(Math.abs((await shoulder()) - before - by) < 1e-12, `${input} ${key}`);
  }
  await field.fill('0.5');
  await page.keyboard.press('Enter');
  assert.match(await page.textContent('.joint'), /shoulder.*rad.*28\.6°.*-3.*3/);
  assert.equal(await page.inputValue('#joints input[type="range"]'), '0.5');
  // A key on a button is the button's: space does not play.
  await page.focus('#fit');
  await page.keyboard.press(' ');
  assert.ok(!(await at(page, () => window.ovoidPage.track.player.isPlaying)));
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press(' ');
  assert.ok(await at(page, () => window.ovoidPage.track.player.isPlaying));
  await page.keyboard.press(' ');
  await page.keyboard.press('?');
  assert.ok(await page.isVisible('#keys'));
  assert.deepEqual(errors, []);
  await page.close();
});

test('on paper and on a phone all is there', { skip }, async () => {
  write('paper.json', cell);
  run('check', 'paper.json', '--html', 'paper.html');
  const { page } = await open('paper.html', flat);
  // A dark page is black on white on paper; its picture is as large as there while it is drawn, and as before after that.
  await page.emulateMedia({ colorScheme: 'dark', media: 'print' });
  assert.equal(await at(page, () => getComputedStyle(document.getElementById('headline')).color), 'rgb(0, 0, 0)');
  await page.emulateMedia({ colorScheme: 'light', media: 'screen' });
  const width = await at(page, () => document.getElementById('stage').clientWidth), readPaper = () => at(page, () => ['stage', 'paper'].map((id) => document.getElementById(id).clientWidth || document.getElementById(id).width));
  const isDrawn = () => at(page, () => document.getElementById('paper').getContext('2d').getImageData(0, 0, 642, 415).data.some((x) => x > 0));
  await at(page, () => window.dispatchEvent(new Event('beforeprint')));
  assert.deepEqual(await readPaper(), [643, 643]);
  assert.ok(await isDrawn(), 'the picture on paper is empty');
  await at(page, () => window.dispatchEvent(new Event('afterprint')));
  assert.deepEqual(await readPaper(), [width, 1]);
  await page.emulateMedia({ media: 'print' });
  assert.deepEqual(await Promise.all(['#tools', '#layers', '#headline', '#pairs', '#canvas'].map((id) => page.isVisible(id))), [false, false, true, true, true]);
  assert.equal(await at(page, () => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
  await page.emulateMedia({ media: 'screen' });
  await page.setViewportSize({ width: 390, height: 844 });
  const tops = await at(page, () => ['headline', 'stage', 'list'].map((id) => document.getElementById(id).getBoundingClientRect().top));
  assert.ok(tops[0] < tops[1] && tops[1] < tops[2] && tops[1] < 200, `${tops}`);
  assert.ok(await at(page, () => document.documentElement.scrollWidth <= 390));
  await page.close();
});

test('axe finds nothing in any kind of page, light or dark; its HTML is valid', { skip }, async () => {
  const axe = readFileSync(need.resolve('axe-core/axe.min.js'), 'utf8'), { HtmlValidate } = need('html-validate');
  const validate = new HtmlValidate({ extends: ['html-validate:standard'], rules: { 'long-title': 'off', 'no-implicit-button-type': 'off', 'script-type': 'off', 'require-sri': 'off' } });
  write('axe.json', cell);
  run('check', 'axe.json', '--html', 'axe-check.html');
  run('run', inStart('assembly.json'), '--motion', inStart('motion.csv'), '--margin', '2', '--continuous', '--html', 'axe-run.html');
  run('robot', 'check', ...startArm, '--states', inStart('states.csv'), '--html', 'axe-states.html');
  run('robot', 'path', ...startArm, '--states', inStart('straight.csv'), '--html', 'axe-path.html');
  for (const file of ['axe-check.html', 'axe-run.html', 'axe-states.html', 'axe-path.html']) {
    const { page, errors } = await open(file, flat);
    for (const theme of ['light', 'dark']) {
      await at(page, `document.documentElement.dataset.theme = '${theme}'; window.ovoidPage.choosePair(window.ovoidPage.panel.matching()[0] ?? null)`);
      await page.evaluate(axe);
      const { violations } = await at(page, () => window.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'best-practice'] }));
      assert.deepEqual(violations.map(({ id, nodes }) => `${file} ${theme}: ${id}: ${nodes.map(({ html, failureSummary }) => `${html.slice(0, 120)} ${failureSummary}`).slice(0, 3).join('; ')}`), []);
    }
    // Without the data and the script, which are no HTML.
    const html = (await page.content()).replace(/<script[\s\S]*?<\/script>/g, '').replace(/<style[\s\S]*?<\/style>/g, '');
    const { results } = await validate.validateString(html);
    assert.deepEqual(results.flatMap(({ messages }) => messages.filter(({ severity }) => severity === 2).map(({ line, ruleId, message }) => `${file}: ${ruleId}: ${message}: ${html.split('\n')[line - 1]?.slice(0, 80)}`)), []);
    assert.deepEqual(errors, []);
    await page.close();
  }
});
